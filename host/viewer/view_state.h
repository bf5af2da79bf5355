#pragma once
/// What the page is told.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/view.h"

namespace triad {

/// How a picture's error fell.
struct ViewCourse {
    struct Point {
        double seconds, samples, relmse;
    };
    std::vector<Point> points;
    double seconds_before = 0;  ///< in earlier calls of its renderer
    double seconds = 0, samples = 0, relmse = -1;
    std::uint64_t rays = 0;

    void add(const Progress& progress);
};

struct KernelTime {
    std::uint64_t launches = 0;
    double seconds = 0;
};

struct ViewFacts {
    std::string scene, device, integrator;
    std::vector<std::string> cameras, variants, panels;
    std::string phase;    ///< "load", "build", "compile", "render", "paused", "done"
    std::string message;  ///< a sentence about the last change; empty: all went well
    // As chosen.
    int camera = -1;
    double scale = 1, exposure = 0;
    std::string variant, panel, tone_map, method;
    bool subpixels = true, paused = false, moved = false;
    std::array<unsigned, 4> region{};
    View view;
    double fov = 0;
    unsigned width = 0, height = 0;
    std::string command;  ///< that renders this picture; empty: none does
    // As it went.
    std::uint64_t frame = 0, region_frame = 0;  ///< numbers of the latest
    unsigned divisor = 1;                       ///< of the picture that is shown; 1: not coarse
    std::optional<double> move_seconds;         ///< from the last move to its first picture
    unsigned packings = 1;
    double wanted_samples = 0;
    ViewCourse course;
    std::map<std::string, KernelTime> kernels;  ///< since the last move
};

/// One line.
std::string json_of(const ViewFacts& facts);

}  // namespace triad
