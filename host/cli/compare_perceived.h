#pragma once
/// triad compare --metric perceived: what a display shows of a picture against one of many samples per pixel.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/rgb_image.h"
#include "io/io.h"
#include "report/report.h"

namespace triad {

struct PerceivedOptions {
    std::string panel;
    std::optional<double> ppd, limit;
    std::vector<std::string> eyes, maps;  ///< maps: of the first eye
};

/// Declares --panel, --ppd, --eye and --max-perceived.
void declare_perceived(CLI::App& command, PerceivedOptions& options);

/// What a display shows: files of 8 and 16 bits are sRGB, others are taken as display-linear, without a tone
/// map. Empty where R, G or B is missing.
RgbImage display_of(const Picture& picture);

/// The one of the two files with more pixels is the reference, in whichever order. Prints a line for each
/// eye, writes the maps and returns the row of the JSON file; `failures` gets a sentence when the first eye's
/// error is above the limit.
Json compare_perceived(const std::string& a, const std::string& b, const PerceivedOptions& options,
                       bool print, std::string& failures);

}  // namespace triad
