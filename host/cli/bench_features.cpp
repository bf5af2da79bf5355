#include "cli/bench_features.h"

#include <cstdio>
#include <memory>

#include "base/check_outputs.h"
#include "base/interrupt.h"
#include "bench/feature_bench.h"
#include "cli/option_kinds.h"
#include "report/report.h"
#include "trace/tune.h"

namespace triad {
namespace {

struct BenchFeaturesOptions {
    std::string device, json, kernels;
    unsigned threads = 0;
    FeatureBenchPlan plan;
};

std::string per_cent(const FeatureRun& run) {
    char text[64];
    std::snprintf(text, sizeof text, "%+5.1f %% (%+.1f to %+.1f)", 100 * (run.ratio.value - 1),
                  100 * (run.ratio.low - 1), 100 * (run.ratio.high - 1));
    return text;
}

void print_header(const DeviceInfo& device) {
    std::printf("%s, %s, driver %s\n", device.name.c_str(), device.platform.c_str(), device.driver.c_str());
    std::printf(
        "Rendering time against the feature left out; seconds to compile; rays per sample against it left "
        "out\n");
    std::printf("%-19s %-27s %7s  %-27s %6s\n", "feature", "compiled in, not used", "compile", "used",
                "rays");
}

void print(const FeatureCost& c) {
    std::printf("%-19s %-27s %7.2f  ", c.feature.c_str(), per_cent(c.unused).c_str(),
                c.unused.compile_seconds);
    if (c.used)
        std::printf("%-27s %6.2f", per_cent(*c.used).c_str(),
                    c.used->rays_per_sample / c.left_out.rays_per_sample);
    std::printf("%s\n", c.same_bits ? "" : "  OTHER BITS");
    std::fflush(stdout);
}

Json to_json(const FeatureRun& r) {
    return {
        {"compile_s", r.compile_seconds}, {"seconds", r.seconds},     {"rays_per_sample", r.rays_per_sample},
        {"ratio", r.ratio.value},         {"ratio_low", r.ratio.low}, {"ratio_high", r.ratio.high}};
}

Exit run(const BenchFeaturesOptions& o) {
    check_outputs({o.json}, {o.kernels});
    const EmptyCaches caches;
    const InterruptGuard guard;
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    ensure_tuned(device);
    const bool lines = o.json != "-";
    if (lines) print_header(device.info());
    Json rows = Json::array();
    bool same = true;
    measure_features(device, o.plan, [&](const FeatureCost& c) {
        if (lines) print(c);
        same &= c.same_bits;
        rows.push_back({{"feature", c.feature},
                        {"left_out", to_json(c.left_out)},
                        {"unused", to_json(c.unused)},
                        {"used", c.used ? to_json(*c.used) : Json()},
                        {"same_bits", c.same_bits}});
        return !guard.interrupted();
    });
    if (!o.json.empty()) write_report(o.json, "bench-features", &device.info(), rows);
    if (!same)
        throw Error(Exit::comparison, "A feature that is compiled in and not used changed the picture on " +
                                          device.info().name + ".");
    return guard.interrupted() ? Exit::incomplete : Exit::done;
}

}  // namespace

void add_bench_features(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<BenchFeaturesOptions>();
    CLI::App* command = bench.add_subcommand(
        "features", "What each compile-time feature costs: left out, compiled in but not used, and used");
    add_device(*command, o->device);
    add_threads(*command, o->threads);
    command->add_option("--size", o->plan.size, "Pixels across and down (default 128)")
        ->check(whole_number_within(8, 4096))
        ->type_name("N");
    command->add_option("--spp", o->plan.samples, "Samples per pixel and run (default 16)")
        ->check(whole_number_within(1, 1 << 30))
        ->type_name("N");
    command->add_option("--repetitions", o->plan.repetitions, "Runs of each program (default 7)")
        ->check(whole_number_within(1, 1000))
        ->type_name("N");
    add_json(*command, o->json);
    add_kernels(*command, o->kernels);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
