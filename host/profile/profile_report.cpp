#include "profile/profile_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "page/aligned.h"

namespace triad {
namespace {

using Lines = std::vector<std::vector<std::string>>;

Json number(double v) { return std::isfinite(v) && v > 0 ? Json(v) : Json(); }

std::string number_text(double v, const char* pattern) { return v > 0 ? format(pattern, v) : "-"; }

double per_run(const Profile& p, std::size_t n) { return double(n) / p.runs; }

/// Of a run: whole where all runs have as many.
Json count(const Profile& p, std::size_t n) {
    return n % p.runs == 0 ? Json(n / p.runs) : Json(per_run(p, n));
}

std::string rays_table(const WorkCounts& c) {
    Lines lines{{"rays", "per sample", "nodes", "leaves", "triangles", "stack", "deepest"}};
    const double samples = double(c.width) * c.height * c.samples;
    const auto add = [&](const std::string& name, const RayCounts& r) {
        const double n = double(std::max<std::uint64_t>(1, r.rays));
        lines.push_back({name, format("%.3f", double(r.rays) / samples), format("%.2f", double(r.nodes) / n),
                         format("%.2f", double(r.blocks) / n), format("%.2f", double(r.triangles) / n),
                         format("%.2f", double(r.deepest_sum) / n), std::to_string(r.deepest)});
    };
    for (unsigned kind = 0; kind < WORK_KINDS; ++kind) add(ray_kind(kind), c.rays[kind]);
    add("all", c.all());
    return aligned(lines, 1);
}

std::string edges_table(const WorkCounts& c) {
    Lines lines{{"edge", "rays per sample", "that hit", "shadow rays"}};
    for (const EdgeLine& e : edge_lines(c))
        lines.push_back(
            {e.name, format("%.4f", e.rays), format("%.4f", e.hits), format("%.4f", e.shadow_rays)});
    return aligned(lines, 1);
}

std::string peaks_table(const DevicePeaks& peaks) {
    Lines lines{{"of data in", "read GB/s", "copy GB/s", "M gathers/s"}};
    for (const MemoryPeak& m : peaks.memory)
        lines.push_back({bytes_text(m.bytes), format("%.1f", 1e-9 * m.read), format("%.1f", 1e-9 * m.copy),
                         format("%.1f", 1e-6 * m.gathers)});
    return aligned(lines, 1);
}

std::string work_text(const Profile& p) {
    return "\n" + rays_table(p.counts) + "\n" + edges_table(p.counts) +
           "Visits and edges are counted by an instrumented program on other samples; bytes, operations (of "
           "boxes and triangles alone) and dependent reads follow by formula.\n" +
           format("\nThe roof, measured here: %.1f GFLOP/s\n", 1e-9 * p.peaks.flops) + peaks_table(p.peaks);
}

std::string one_device(const Profile& p) {
    const Estimate seconds = median_estimate(p.seconds_of_runs);
    std::string text =
        format("%s, %s, driver %s; %s, nodes %s\n", p.device.name.c_str(), p.device.platform.c_str(),
               p.device.driver.c_str(), p.path_driver.c_str(), p.format.c_str());
    text += format("%u runs of %.0f samples: %.3f s (%.3f to %.3f); numbers are those of one run\n\n", p.runs,
                   p.samples, seconds.value, seconds.low, seconds.high);
    text += kernels_table(p);
    text += format(
        "\nThe queue is at work for %.3f s and waits %.3f s between commands, %.3f s of it for the host.\n",
        p.busy, p.waiting, p.host_between);
    if (p.counts.samples > 0) text += work_text(p);
    std::uint64_t all = 0;
    std::string memory;
    for (const auto& [name, bytes] : p.memory) {
        all += bytes;
        memory += (memory.empty() ? "" : ", ") + name + " " + bytes_text(bytes);
    }
    text += "\nOn the device: " + bytes_text(all) + " (" + memory + ")\n";
    std::string compiled;
    double seconds_compiled = 0;
    for (const Compilation& c : p.compilations) {
        seconds_compiled += c.seconds;
        compiled += (compiled.empty() ? "" : ", ") + c.program + format(" %.2f", c.seconds);
    }
    return text + format("Compiled or loaded in %.2f s (", seconds_compiled) + compiled + ")\n";
}

std::string side_by_side(const std::vector<Profile>& profiles) {
    std::vector<std::string> kernels;
    for (const Profile& p : profiles)
        for (const KernelRow& r : p.rows)
            if (std::find(kernels.begin(), kernels.end(), r.kernel) == kernels.end())
                kernels.push_back(r.kernel);
    Lines lines{{"ms of a run"}};
    for (const Profile& p : profiles) lines[0].push_back(p.device.name.substr(0, 24) + ", " + p.path_driver);
    for (const std::string& kernel : kernels) {
        lines.push_back({kernel});
        for (const Profile& p : profiles) {
            const auto row = std::ranges::find(p.rows, kernel, &KernelRow::kernel);
            lines.back().push_back(row == p.rows.end() ? "-" : format("%.1f", row->ms.value));
        }
    }
    lines.push_back({"the whole run"});
    for (const Profile& p : profiles) lines.back().push_back(format("%.1f", 1e3 * median(p.seconds_of_runs)));
    return aligned(lines, 1);
}

}  // namespace

std::string kernels_table(const Profile& p) {
    Lines lines{{"kernel", "launches", "items", "median ms", "p95 ms", "ms", "share", "M items/s", "GB/s",
                 "GFLOP/s", "units/item", "of the roof", "which is"}};
    for (const KernelRow& r : p.rows)
        lines.push_back(
            {r.kernel, format("%.0f", per_run(p, r.launches)), number_text(per_run(p, r.items), "%.0f"),
             format("%.3f", r.ms_median), format("%.3f", r.ms_p95), format("%.1f", r.ms.value),
             format("%.1f %%", 100 * r.share), number_text(1e-6 * r.items_per_s, "%.2f"),
             number_text(1e-9 * r.bytes_per_s(), "%.2f"), number_text(1e-9 * r.flops_per_s(), "%.2f"),
             number_text(r.units_per_item(p.runs), "%.3g"),
             r.floor ? format("%.0f %%", 100 * *r.roofline_share()) : "-", r.floor ? r.floor->by : "-"});
    return aligned(lines, 1);
}

std::vector<EdgeLine> edge_lines(const WorkCounts& c) {
    const double samples = double(c.width) * c.height * c.samples;
    std::vector<EdgeLine> lines;
    for (std::size_t i = 0; i < c.edges.size(); ++i) {
        const EdgeCounts& e = c.edges[i];
        if (e.rays == 0) break;
        lines.push_back(
            {i + 1 == c.edges.size() ? std::to_string(i + 1) + " and later" : std::to_string(i + 1),
             double(e.rays) / samples, double(e.hits) / samples, double(e.shadow_rays) / samples});
    }
    return lines;
}

std::string table_of(const std::vector<Profile>& profiles) {
    std::string text;
    for (const Profile& p : profiles) text += (text.empty() ? "" : "\n\n") + one_device(p);
    if (profiles.size() > 1) text += "\n\n" + side_by_side(profiles);
    return text;
}

Json rows_of(const std::vector<Profile>& profiles) {
    Json rows = Json::array();
    for (const Profile& p : profiles)
        for (const KernelRow& r : p.rows) {
            Json row{{"kernel", r.kernel},
                     {"device", p.device.name},
                     {"driver", p.device.driver},
                     {"program", r.program},
                     {"launches", count(p, r.launches)},
                     {"items", count(p, r.items)},
                     {"ms_median", r.ms_median},
                     {"ms_p95", r.ms_p95},
                     {"ms_of_runs", r.ms_of_runs},
                     {"share", r.share},
                     {"items_per_s", number(r.items_per_s)},
                     {"gbytes_per_s", number(1e-9 * r.bytes_per_s())},
                     {"gflops", number(1e-9 * r.flops_per_s())},
                     {"roofline_share", r.floor ? number(*r.roofline_share()) : Json()},
                     {"roofline_by", r.floor ? Json(r.floor->by) : Json()}};
            if (r.cost)
                row.update({{"unit", r.cost->unit},
                            {"units", r.cost->units},
                            {"units_per_item", number(r.units_per_item(p.runs))},
                            {"bytes_per_unit", r.cost->bytes / r.cost->units},
                            {"flops_per_unit", r.cost->flops / r.cost->units},
                            {"gathers_per_unit", r.cost->gathers / r.cost->units},
                            {"cost_from",
                             "visits counted by an instrumented program, bytes and operations by "
                             "formula; of shading only bytes"}});
            row.update({{"private_bytes", r.facts.private_bytes},
                        {"local_bytes", r.facts.local_bytes},
                        {"max_local", r.facts.max_local},
                        {"preferred_multiple", r.facts.preferred_multiple}});
            rows.push_back(std::move(row));
        }
    return rows;
}

Json devices_of(const std::vector<Profile>& profiles) {
    Json devices = Json::array();
    for (const Profile& p : profiles) {
        Json rays = Json::object(), memory = Json::object(), compiled = Json::array(), peaks = Json::array(),
             edges = Json::array();
        for (unsigned kind = 0; kind < WORK_KINDS; ++kind) {
            const RayCounts& r = p.counts.rays[kind];
            const double n = double(std::max<std::uint64_t>(1, r.rays));
            rays[ray_kind(kind)] = {{"rays", r.rays},
                                    {"nodes_per_ray", double(r.nodes) / n},
                                    {"leaves_per_ray", double(r.blocks) / n},
                                    {"triangles_per_ray", double(r.triangles) / n},
                                    {"stack_per_ray", double(r.deepest_sum) / n},
                                    {"deepest", r.deepest}};
        }
        for (const EdgeLine& e : edge_lines(p.counts))
            edges.push_back({{"edge", e.name},
                             {"rays_per_sample", e.rays},
                             {"hits_per_sample", e.hits},
                             {"shadow_rays_per_sample", e.shadow_rays}});
        for (const auto& [name, bytes] : p.memory) memory[name] = bytes;
        for (const Compilation& c : p.compilations)
            compiled.push_back({{"program", c.program}, {"seconds", c.seconds}});
        for (const MemoryPeak& m : p.peaks.memory)
            peaks.push_back({{"bytes", m.bytes},
                             {"read_gbytes_per_s", 1e-9 * m.read},
                             {"copy_gbytes_per_s", 1e-9 * m.copy},
                             {"gathers_per_s", m.gathers}});
        devices.push_back(
            {{"device", to_json(p.device)},
             {"format", p.format},
             {"path_driver", p.path_driver},
             {"runs", p.runs},
             {"samples", p.samples},
             {"seconds_of_runs", p.seconds_of_runs},
             {"queue", {{"busy_s", p.busy}, {"waiting_s", p.waiting}, {"host_s", p.host_between}}},
             {"counted_samples_per_pixel", p.counts.samples},
             {"vertices", p.counts.vertices()},
             {"rays", rays},
             {"edges", edges},
             {"peaks", {{"gflops", 1e-9 * p.peaks.flops}, {"memory", peaks}}},
             {"memory_bytes", memory},
             {"compilations", compiled}});
    }
    return devices;
}

}  // namespace triad
