// triad-bench-rays: rays per second of Triad on one device, beside Embree, and beside tinybvh's OpenCL
// kernels on the same device, on the same rays of the same scenes.
//   triad-bench-rays [--scene NAME] [--device SEL] [--threads N] [--local N] [--format NAME] [--size N]
//   [--rounds N] [--tinybvh DIR] [--json FILE]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <thread>

#include "base/parallel_for.h"
#include "bench/ray_sets.h"
#include "bench/tree_tracer.h"
#include "clock.h"
#include "embree_tracer.h"
#include "tinybvh_tracer.h"
#include "trace/node_format.h"

using namespace triad;
using namespace triad::bench;

namespace {

struct Options {
    std::vector<std::string> scenes{"cornell", "room", "landscape"};
    std::string device, json, tinybvh;
    unsigned threads = 1, size = 768, rounds = 7;
    std::size_t local = 0;
    std::optional<BvhFormat> format;
};

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        if (i + 1 >= argc) throw Error(Exit::usage, name + " needs a value.");
        const std::string value = argv[i + 1];
        const auto number = [&] {
            try {
                return unsigned(std::stoul(value));
            } catch (const std::exception&) {
                throw Error(Exit::usage, name + " needs a number, not '" + value + "'.");
            }
        };
        if (name == "--scene")
            options.scenes = {value};
        else if (name == "--device")
            options.device = value;
        else if (name == "--threads")
            options.threads = number();
        else if (name == "--local")
            options.local = number();
        else if (name == "--size")
            options.size = std::max(8u, number() / 8 * 8);
        else if (name == "--rounds")
            options.rounds = std::max(1u, number());
        else if (name == "--format" && find_bvh_format(value))
            options.format = find_bvh_format(value);
        else if (name == "--kernels")
            kernel_source::set_folder(value);
        else if (name == "--clock")
            use_cpu_clock = value == "cpu";
        else if (name == "--tinybvh")
            options.tinybvh = value;
        else if (name == "--json")
            options.json = value;
        else
            throw Error(
                Exit::usage,
                "There is no option " + name +
                    "; there are --scene, --device, --threads, --local, --format (bvh8, bvh4), --size, "
                    "--rounds, --clock, --kernels, --tinybvh (the folder of its traverse.cl) and --json.");
    }
    return options;
}

/// Differences that are no matter of an edge or of two surfaces at one distance.
std::size_t count_differences(const std::vector<dev::Hit>& a, const std::vector<dev::Hit>& b, float reach) {
    std::size_t differences = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool miss_a = a[i].primitive == TRIAD_NONE, miss_b = b[i].primitive == TRIAD_NONE;
        if (miss_a != miss_b || (!miss_a && std::fabs(a[i].t - b[i].t) > 1e-4f * (std::fabs(b[i].t) + reach)))
            ++differences;
    }
    return differences;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Both Embrees, when there is Embree; tinybvh's layouts by their names, when its kernels are given.
struct Peers {
    std::unique_ptr<EmbreeTracer> plain, robust;
    std::vector<std::pair<std::string, std::unique_ptr<TinybvhTracer>>> tinybvh;
};

template <class Pass>
double seconds_of(const Pass& pass) {
    const double start = now();
    pass();
    return now() - start;
}

/// Of distances: its kernels use products that round otherwise.
std::size_t count_differences(const std::vector<float>& theirs, const std::vector<dev::Hit>& ours,
                              float reach) {
    std::size_t differences = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool miss = ours[i].primitive == TRIAD_NONE, miss_too = !(theirs[i] < 1e29f);
        differences +=
            miss != miss_too || (!miss && std::fabs(ours[i].t - theirs[i]) > 1e-3f * (ours[i].t + reach));
    }
    return differences;
}

/// Tracers in turns: what each does in a round, with how many seconds it took.
using Race = std::vector<std::pair<std::string, std::function<double()>>>;

std::map<std::string, std::vector<double>> run_race(const Race& race, unsigned rounds) {
    std::map<std::string, std::vector<double>> seconds;
    for (unsigned round = 0; round < rounds; ++round)
        for (const auto& [name, pass] : race) seconds[name].push_back(pass());
    return seconds;
}

/// How many rays Embree answers otherwise. Throws where that is more than its own: robust Embree is
/// conservative at edges, some tens in a million.
std::size_t differences_to_embree(const RayScene& scene, const std::string& kind, TreeTracer& tracer,
                                  const std::vector<dev::Hit>& hits,
                                  const std::vector<std::uint32_t>& occluded) {
    std::size_t differences = 0;
    if (kind == "shadow") {
        const auto ours = tracer.occluded();
        for (std::size_t i = 0; i < ours.size(); ++i) differences += ours[i] != occluded[i];
    } else {
        differences = count_differences(tracer.hits(), hits, scene.reach);
    }
    if (double(differences) > 1e-4 * double(hits.size()))
        throw Error(Exit::comparison, "Triad and Embree disagree on " + std::to_string(differences) + " of " +
                                          std::to_string(hits.size()) + " " + kind + " rays of " +
                                          scene.name + ": no speed is reported for wrong answers.");
    return differences;
}

void print(const nlohmann::json& row, const Peers& peers) {
    const auto number = [&](const std::string& name) { return row[name].get<double>(); };
    std::printf("%-10s %-8s %8.2f", row["scene"].get<std::string>().c_str(),
                row["kind"].get<std::string>().c_str(), number("triad_mrays"));
    if (peers.plain)
        std::printf(" %8.2f %8.2f %8.3f %8.3f %6zu", number("embree_mrays"), number("embree_robust_mrays"),
                    number("ratio"), number("ratio_robust"), row["differences"].get<std::size_t>());
    for (const auto& [name, peer] : peers.tinybvh)
        if (row.contains(name + "_mrays"))
            std::printf("  %s %.2f, ratio %.3f, %zu differ", name.c_str(), number(name + "_mrays"),
                        number("ratio_" + name), row[name + "_differences"].get<std::size_t>());
    std::printf("\n");
    std::fflush(stdout);
}

nlohmann::json measure(const RayScene& scene, const std::string& kind, const std::vector<dev::Ray>& rays,
                       TreeTracer& tracer, const Peers& peers, unsigned rounds) {
    const bool occlusion = kind == "shadow";
    nlohmann::json row{{"scene", scene.name},
                       {"triangles", scene.mesh.triangles.size()},
                       {"kind", kind},
                       {"rays", rays.size()}};
    tracer.set_rays(rays);
    const auto trace = [&] {
        if (kind == "packets")
            tracer.trace_packets();
        else
            tracer.trace(occlusion);
    };
    trace();
    Race race{{"triad", [&] { return seconds_of(trace); }}};
    std::vector<dev::Hit> hits(rays.size());
    std::vector<std::uint32_t> occluded(rays.size());
    const auto embree = [&](const EmbreeTracer& peer) {
        return occlusion ? peer.occluded(rays, occluded) : peer.closest(rays, hits);
    };
    if (peers.plain) {
        embree(*peers.robust);
        row["differences"] = differences_to_embree(scene, kind, tracer, hits, occluded);
        race.emplace_back("embree", [&] { return embree(*peers.plain); });
        race.emplace_back("embree_robust", [&] { return embree(*peers.robust); });
    }
    if (!occlusion)
        for (const auto& [name, peer] : peers.tinybvh) {
            peer->set_rays(rays), peer->trace();
            row[name + "_differences"] = count_differences(peer->distances(), tracer.hits(), scene.reach);
            race.emplace_back(name, [&rival = *peer] { return seconds_of([&] { rival.trace(); }); });
        }
    for (const auto& [name, seconds] : run_race(race, rounds)) {
        const double mega = double(rays.size()) * 1e-6;
        row[name + "_mrays"] = mega / *std::min_element(seconds.begin(), seconds.end());
        row[name + "_mrays_median"] = mega / median(seconds);
    }
    for (const auto& [name, pass] : race) {
        const std::string ratio = name == "embree"          ? "ratio"
                                  : name == "embree_robust" ? "ratio_robust"
                                                            : "ratio_" + name;
        if (name != "triad")
            row[ratio] = row["triad_mrays"].get<double>() / row[name + "_mrays"].get<double>();
    }
    print(row, peers);
    return row;
}

/// Seconds on all threads.
struct BuildTimes {
    double triad = INFINITY;
    std::optional<double> embree;
};

/// The least of several builds of both in turns: the first ones of a process wait for its memory.
BuildTimes time_builds(Device& device, const RayScene& scene, unsigned rounds) {
    BuildTimes least;
    for (unsigned i = 0; i < rounds; ++i) {
        least.triad = std::min(least.triad, TreeTracer(device, scene).build_seconds());
        if (EmbreeTracer::available())
            least.embree =
                std::min(least.embree.value_or(INFINITY), EmbreeTracer(scene, false).build_seconds());
    }
    return least;
}

int run(int argc, char** argv) {
    const Options options = parse(argc, argv);
    if (!options.tinybvh.empty() && !TinybvhTracer::available())
        throw Error(Exit::usage,
                    "This program was built without tinybvh: configure with -DTRIAD_TINYBVH=FOLDER.");
    Device device = Device::open({.selector = options.device, .threads = options.threads});
    if (options.local) device.set_preferred_local(options.local);
    set_format(device, options.format.value_or(default_format(device.info())));
    nlohmann::json report{{"schema", "triad.bench-rays/1"},
                          {"version", TRIAD_VERSION},
                          {"machine", {{"cores", std::thread::hardware_concurrency()}}},
                          {"device",
                           {{"name", device.info().name},
                            {"driver", device.info().driver},
                            {"threads", options.threads},
                            {"local", device.preferred_local()}}},
                          {"clock", use_cpu_clock ? "cpu" : "wall"},
                          {"rows", nlohmann::json::array()},
                          {"builds", nlohmann::json::array()}};
    std::printf("%s, %u thread(s); Mrays/s, best of %u\n%-10s %-8s %8s %8s %8s %8s %8s %6s\n",
                device.info().name.c_str(), options.threads, options.rounds, "scene", "rays", "triad",
                "embree", "robust", "ratio", "ratio-r", "differ");
    for (const std::string& name : options.scenes) {
        const RayScene scene = make_ray_scene(name);
        TreeTracer tracer(device, scene);
        Peers peers;
        if (EmbreeTracer::available()) {
            peers.plain = std::make_unique<EmbreeTracer>(scene, false);
            peers.robust = std::make_unique<EmbreeTracer>(scene, true);
        }
        if (!options.tinybvh.empty())
            for (const std::string& layout : TinybvhTracer::layouts())
                peers.tinybvh.emplace_back(
                    layout, std::make_unique<TinybvhTracer>(device, scene, layout, options.tinybvh));
        set_host_threads(options.threads);
        const auto add = [&](const char* kind, const std::vector<dev::Ray>& rays) {
            report["rows"].push_back(measure(scene, kind, rays, tracer, peers, options.rounds));
        };
        const auto primary = primary_rays(scene, options.size);
        add("primary", primary);
        if (tracer.walks_packets()) add("packets", primary);
        const auto seen = ends_of(scene, primary, tracer.hits());
        const auto diffuse = diffuse_rays(seen);
        add("diffuse", diffuse);
        add("shadow", shadow_rays(scene, ends_of(scene, diffuse, tracer.hits())));
        set_host_threads(0);
        const double triangles = double(scene.mesh.triangles.size());
        const BuildTimes builds = time_builds(device, scene, options.rounds);
        report["builds"].push_back(
            {{"scene", name},
             {"triad_seconds", builds.triad},
             {"embree_seconds", builds.embree ? nlohmann::json(*builds.embree) : nlohmann::json()},
             {"node_bytes_per_triangle", double(tracer.node_bytes()) / triangles},
             {"block_bytes_per_triangle", double(tracer.block_bytes()) / triangles}});
        std::printf("%-10s build %.3f s (Embree %.3f s), %.1f + %.1f bytes per triangle (nodes + blocks)\n",
                    name.c_str(), builds.triad, builds.embree.value_or(0),
                    double(tracer.node_bytes()) / triangles, double(tracer.block_bytes()) / triangles);
    }
    if (!options.json.empty()) std::ofstream(options.json) << report.dump(2) << "\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        std::cerr << "triad-bench-rays: " << error.what() << "\n";
        return int(error.exit());
    }
}
