#pragma once
/// What rays take of a tree: counted by the path tracer's own kernel, compiled so that it does.
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/types.h"
#include "trace/tracer.h"

namespace triad {

/// "camera", "bounce", "shadow": of WORK_*.
const char* ray_kind(unsigned kind);

/// Sums over rays of one kind; `deepest`: children that waited on any ray's stack at most.
struct RayCounts {
    std::uint64_t rays = 0, nodes = 0, blocks = 0, triangles = 0, deepest_sum = 0;
    std::uint32_t deepest = 0;
};

/// Of the edges of all paths that are the so-manieth of theirs.
struct EdgeCounts {
    std::uint64_t rays = 0, hits = 0, shadow_rays = 0;
};

struct WorkCounts {
    unsigned width = 0, height = 0, samples = 0;  ///< of the crop; per pixel
    std::array<RayCounts, WORK_KINDS> rays;
    std::array<EdgeCounts, WORK_EDGES> edges;  ///< from the camera's on; the last has all later ones
    std::vector<std::uint32_t> visits;  ///< nodes and leaves, of every pixel's samples together, row by row

    RayCounts all() const;
    std::uint64_t vertices() const;  ///< ends of edges that hit something
};

/// Samples of each pixel whose work is counted where nothing but their mean is used.
constexpr unsigned counted_samples = 4;

/// Of the first samples of every pixel. Rays are those of trace(): the same numbers, the same bits. Photons
/// have none.
WorkCounts count_work(Tracer& tracer, unsigned samples);

/// Seconds on the device of so many samples of every tile, each in a launch of its own. The device must have
/// a profiling queue. The samples are added to the tracer's part of the film. Empty where the whole picture
/// would take longer than `most_seconds`: a GPU has one tile hardly earlier than a thousand.
std::vector<double> time_tiles(Tracer& tracer, std::size_t tiles, unsigned samples, double most_seconds);

}  // namespace triad
