#include "bench/board_bench.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "bench/display_bench.h"
#include "bench/kernel_bench.h"
#include "bench/kernel_bench_cases.h"
#include "bench/profile_run.h"
#include "display/reconstruction.h"
#include "scene/builtin_scene.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/node_format.h"

namespace triad {
namespace {

/// Of the picture whose paths are measured.
constexpr unsigned width = 320, height = 180;
/// Of a run: long enough that its launches are those of renders.
constexpr double run_seconds = 0.3;
constexpr std::uint64_t most_samples_of_run = 4096;
constexpr unsigned path_runs = 3, display_rounds = 3, function_rounds = 3;
constexpr std::uint32_t paths_seed = 1;

BoardRow rate(BoardPart part, const std::string& name, double value, const std::string& unit) {
    return {.part = part, .name = name, .value = {value, value, value}, .unit = unit};
}

/// The least power of two whose samples take a run's time.
std::uint64_t samples_of_run(Renderer& renderer) {
    std::uint64_t samples = 1;
    for (; samples < most_samples_of_run; samples *= 2) {
        renderer.restart(paths_seed);
        const RenderResult result = renderer.render_until({.samples = {0, samples}, .follow = false},
                                                          [](const Progress&) { return true; });
        if (result.seconds >= 0.5 * run_seconds) break;
    }
    return samples;
}

std::string work_words(const KernelRow& row) {
    if (!row.floor) return "";
    return format("%.3g GB/s, ", 1e-9 * row.bytes_per_s()) +
           (row.flops_per_s() > 0 ? format("%.3g GFLOP/s, ", 1e-9 * row.flops_per_s()) : "") +
           format("%.0f %% of the roof, which is ", 100 * *row.roofline_share()) + row.floor->by;
}

}  // namespace

std::vector<PathWay> path_ways(const Device& device) {
    std::vector<PathWay> ways{{format_of(device), path_driver_of(device)}};
    for (const PathDriverKind driver : all_path_drivers)
        for (const BvhFormat nodes : all_bvh_formats) {
            if (driver == PathDriverKind::wave && device.info().type != "cpu") continue;
            if (nodes != ways[0].format || driver != ways[0].driver) ways.push_back({nodes, driver});
        }
    return ways;
}

void set_way(Device& device, const PathWay& way) {
    set_format(device, way.format);
    set_path_driver(device, way.driver);
}

std::vector<BoardRow> rows_of(const DevicePeaks& peaks) {
    std::vector<BoardRow> rows{rate(BoardPart::peak, "multiply-adds", 1e-9 * peaks.flops, "GFLOP/s")};
    for (const MemoryPeak& m : peaks.memory) {
        const std::string where = " " + bytes_text(m.bytes);
        rows.push_back(rate(BoardPart::peak, "read" + where, 1e-9 * m.read, "GB/s"));
        rows.push_back(rate(BoardPart::peak, "copy" + where, 1e-9 * m.copy, "GB/s"));
        rows.push_back(rate(BoardPart::peak, "dependent reads" + where, 1e-6 * m.gathers, "M/s"));
    }
    return rows;
}

std::vector<BoardRow> measure_paths(Device& device, const PathWay& way, const DevicePeaks& peaks,
                                    std::map<BvhFormat, WorkCounts>& counts) {
    set_way(device, way);
    Scene scene = builtin_scene();
    validate(scene);
    RenderSettings settings;  // of paths alone: how many photons a pilot chooses depends on the device
    settings.width = width, settings.height = height;
    settings.view = view_of(scene.cameras.front(), double(width) / height);
    Renderer renderer(device, scene, settings);
    const std::uint64_t samples = samples_of_run(renderer);
    Profile p = profile_runs(renderer, {.samples = {0, samples}, .follow = false}, paths_seed, path_runs,
                             [](unsigned, unsigned) { return true; });
    if (!counts.contains(way.format)) {
        renderer.restart(paths_seed);
        counts.emplace(way.format, renderer.count_work(counted_samples));
    }
    add_costs(p, counts.at(way.format), peaks);
    const auto of_this_way = [&](BoardRow row) {
        row.format = name_of(way.format), row.path_driver = name_of(way.driver);
        return row;
    };
    std::vector<double> speeds;
    for (const double seconds : p.seconds_of_runs) speeds.push_back(1e-6 * p.samples / seconds);
    std::vector<BoardRow> rows{of_this_way({.part = BoardPart::paths,
                                            .name = "built-in",
                                            .value = median_estimate(speeds),
                                            .unit = "M samples/s"})};
    const double mega = 1e-6 * p.samples;
    for (const KernelRow& r : p.rows) {
        if (r.kind != CommandKind::kernel) continue;
        rows.push_back(of_this_way({.part = BoardPart::stage,
                                    .name = r.kernel,
                                    .value = {r.ms.value / mega, r.ms.low / mega, r.ms.high / mega},
                                    .unit = "ms/M samples",
                                    .note = work_words(r)}));
    }
    return rows;
}

std::vector<BoardRow> measure_display(Device& device) {
    const Film film = noise_film();
    DisplaySettings plain;
    plain.taps = filter_taps({}, 3, 3);
    DisplaySettings noisy = plain;
    noisy.order = ToneOrder::noise_aware;
    DisplaySettings panel = plain;
    const Panel stripes = *builtin_panel("rgb");
    panel.taps = kept_taps(stripes, 45);
    panel.refine = design_refine(stripes, 45);
    std::vector<BoardRow> rows;
    for (const auto& [name, settings] :
         {std::pair("box", &plain), {"box, by noise", &noisy}, {"panel rgb", &panel}})
        for (const auto& [kernel, ms] : time_display(device, film, *settings, display_rounds))
            rows.push_back({.part = BoardPart::display,
                            .name = std::string(name) + ", " + kernel,
                            .value = ms,
                            .unit = "ms/M pixels"});
    return rows;
}

std::vector<BoardRow> measure_functions(Device& device, const std::function<bool()>& go_on) {
    KernelBenchPlan plan;
    plan.rounds = function_rounds;
    plan.shapes = {{64, 1}, {1, 256}};
    std::vector<BoardRow> rows;
    for (const KernelBenchCase& c : kernel_bench_cases()) {
        if (!go_on()) break;
        for (const KernelSpeed& speed : measure_kernels(device, plan, c.name)) {
            if (speed.kernel != c.name) continue;
            const std::string shape = speed.shape.run > 1
                                          ? "runs of " + std::to_string(speed.shape.run)
                                          : "groups of " + std::to_string(speed.shape.local_size);
            rows.push_back({.part = BoardPart::function,
                            .name = c.name + ", " + shape,
                            .value = speed.ns_per_item,
                            .unit = "ns"});
        }
    }
    return rows;
}

}  // namespace triad
