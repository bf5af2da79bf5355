#pragma once
/// Error against time of a board, to references that were made elsewhere.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/rgb_image.h"
#include "bench/board.h"
#include "bench/board_bench.h"
#include "device/device.h"
#include "pack/settings.h"
#include "scene/scene.h"

namespace triad {

/// A picture that is as good as right.
struct KnownPicture {
    RgbImage mean;      ///< scene-linear
    double spp = 0;     ///< that it was made of, by another seed
    double relmse = 0;  ///< what is left of its noise
};

struct BoardScene {
    std::string name;
    Scene scene;
    RenderSettings settings;
    KnownPicture known;
};

struct BoardErrorPlan {
    std::uint64_t spp = 64;  ///< at least, in time; more while a run is short
    unsigned repetitions = 3;
};

/// How the pictures of a scene were found: what another way must find too, bit by bit.
using FilmDigests = std::vector<std::string>;

/// Rows of errors at 1, 2, 4 ... samples per pixel, and of efficiency at those of the plan, by the way that
/// the device goes: the error of the first repetition, the times of all. Repetitions have seeds of their own;
/// the first tells how far the time reaches. `go_on` is asked meanwhile. The row of efficiency is not right
/// where the mean picture is not the known one (tiles, 1e-6 for all together), or the films of the first
/// repetition are not those of `digests`, which the first way fills.
std::vector<BoardRow> measure_errors(Device& device, const BoardScene& scene, const BoardErrorPlan& plan,
                                     FilmDigests& digests, const std::function<bool()>& go_on);

}  // namespace triad
