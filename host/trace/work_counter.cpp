#include "trace/work_counter.h"

#include <algorithm>
#include <chrono>
#include <string>

#include "trace/program.h"

namespace triad {
namespace {

/// Tiles by whose time it is judged what all take.
constexpr std::size_t tried_tiles = 16;

void add(RayCounts& sum, const dev::RayWork& work) {
    sum.rays += work.rays, sum.nodes += work.nodes, sum.blocks += work.blocks;
    sum.triangles += work.triangles, sum.deepest_sum += work.deepest_sum;
    sum.deepest = std::max(sum.deepest, work.deepest);
}

}  // namespace

const char* ray_kind(unsigned kind) {
    constexpr const char* names[WORK_KINDS] = {"camera", "bounce", "shadow"};
    return names[kind];
}

RayCounts WorkCounts::all() const {
    RayCounts sum;
    for (const RayCounts& kind : rays) {
        sum.rays += kind.rays, sum.nodes += kind.nodes, sum.blocks += kind.blocks;
        sum.triangles += kind.triangles, sum.deepest_sum += kind.deepest_sum;
        sum.deepest = std::max(sum.deepest, kind.deepest);
    }
    return sum;
}

std::uint64_t WorkCounts::vertices() const {
    std::uint64_t sum = 0;
    for (const EdgeCounts& edge : edges) sum += edge.hits;
    return sum;
}

WorkCounts count_work(Tracer& tracer, unsigned samples) {
    Device& device = tracer.device();
    const Kernel kernel = device.build(program_of(tracer.settings(), "count"), options_of(tracer.features()))
                              .kernel("count_work");
    const dev::Frame& frame = tracer.frame();
    WorkCounts counts{.width = frame.crop[2],
                      .height = frame.crop[3],
                      .samples = samples,
                      .rays = {},
                      .edges = {},
                      .visits = {}};
    const std::size_t pixels = std::size_t(counts.width) * counts.height;
    dev::CountWorkArguments own{.work = device.allocate_array<dev::PixelWork>(pixels),
                                .edges = device.allocate_array<dev::EdgeWork>(WORK_EDGES),
                                .first_pixel = 0,
                                .pixel_count = 0,
                                .sample_count = samples};
    const std::size_t most = std::max<std::size_t>(64, largest_launch_items / samples / 64 * 64);
    device.fill_zero(own.edges);
    for (std::size_t first = 0; first < pixels; first += most) {
        own.first_pixel = std::uint32_t(first);
        own.pixel_count = std::uint32_t(std::min(most, pixels - first));
        device.run(kernel, Arguments(tracer.arguments()).add(arguments_of(own)), own.pixel_count);
        device.finish();
    }
    for (const dev::PixelWork& pixel : device.download<dev::PixelWork>(own.work)) {
        std::uint32_t visits = 0;
        for (unsigned kind = 0; kind < WORK_KINDS; ++kind) {
            add(counts.rays[kind], pixel.rays[kind]);
            visits += pixel.rays[kind].nodes + pixel.rays[kind].blocks;
        }
        counts.visits.push_back(visits);
    }
    const std::vector<dev::EdgeWork> edges = device.download<dev::EdgeWork>(own.edges);
    for (std::size_t i = 0; i < WORK_EDGES; ++i)
        counts.edges[i] = {edges[i].rays, edges[i].hits, edges[i].shadow_rays};
    return counts;
}

std::vector<double> time_tiles(Tracer& tracer, std::size_t tiles, unsigned samples, double most_seconds) {
    std::vector<dev::TileWork> work;
    for (std::size_t tile = 0; tile < tiles; ++tile)
        work.push_back({std::uint32_t(tile), {0, 0}, {samples, samples}, {}});
    tracer.set_work(work);
    std::vector<double> seconds;
    std::size_t ended = tracer.device().commands().size();
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        tracer.trace(tile, 1, 0);
        tracer.finish();
        const std::vector<DeviceCommand>& commands = tracer.device().commands();
        double took = 0;
        for (; ended < commands.size(); ++ended)
            took += 1e-9 * double(commands[ended].end - commands[ended].start);
        seconds.push_back(took);
        const double each = std::chrono::duration<double>(Clock::now() - began).count() / double(tile + 1);
        if (tile >= tried_tiles && each * double(tiles) > most_seconds) return {};
    }
    return seconds;
}

}  // namespace triad
