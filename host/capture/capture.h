#pragma once
/// Captures: the work of one device for one pass of a render, with all that it needs, as a file that
/// triad-replay takes to other devices (docs/capture.md).
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "device/recording.h"

namespace triad {

/// Of the film that the pass ends with: an array as it lies on the device.
struct CapturedArray {
    enum class What {
        sums,       ///< FILM_CHANNELS 64-bit numbers for each bin
        half_sums,  ///< three for each pixel
        samples,    ///< one 32-bit number for each pixel
        counters,   ///< COUNTERS pairs of them
    };
    What what = What::sums;
    std::size_t memory = 0;  ///< place among the recording's memories; all of it
    std::uint64_t first_pixel = 0, pixels = 0;
    Recording::Content content;
};
constexpr const char* captured_array_names[] = {"sums", "half_sums", "samples", "counters"};

/// Where a capture comes from.
struct CaptureOrigin {
    std::string version;  ///< of Triad
    std::string command;  ///< as typed
    std::string device, driver, platform, platform_version, type;
    std::uint64_t local = 0;  ///< work-group size of launches that name none
};

struct Capture {
    CaptureOrigin origin;
    std::uint64_t width = 0, height = 0, bins = 0;  ///< of the film's crop; bins of a pixel
    Recording work;
    std::vector<CapturedArray> film;
    std::string counted;  ///< what rays took of the trees, JSON (profile/work_json.h); empty: not counted
};

/// Throws Error(scene) where it cannot be written.
void write_capture(const std::filesystem::path& path, const Capture& capture);

/// Throws Error(scene) that says what is wrong with the file, Error(memory) where its buffers do not fit.
/// What comes back is consistent: every place exists, every range lies within its memory, every array has
/// the size of the film.
Capture read_capture(const std::filesystem::path& path);

}  // namespace triad
