#pragma once
/// What triad-replay was asked for, and the doing of it.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "base/error.h"
#include "replay/verify.h"

namespace triad {

struct ReplayRequest {
    std::string capture, device, json, folder, against, kernels, extract, kernel;
    unsigned threads = 0;
    unsigned repeat = 5;
    std::optional<std::size_t> launch;  ///< of `kernel`, from 1; none: the longest
    VerifyRule rule = VerifyRule::automatic;
    bool tune = false, check = false;
};

/// Declares what the program is and its options. `request` must outlive the parsing.
void declare(CLI::App& app, ReplayRequest& request);

/// Prints, and writes what is asked for. Throws Error.
Exit replay(const ReplayRequest& request);

}  // namespace triad
