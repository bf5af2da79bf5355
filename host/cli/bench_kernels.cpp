#include "cli/bench_kernels.h"

#include <cstdio>
#include <memory>

#include "base/check_outputs.h"
#include "bench/kernel_bench.h"
#include "cli/option_kinds.h"
#include "report/report.h"

namespace triad {
namespace {

struct BenchKernelsOptions {
    std::string device, json, kernels, filter;
    unsigned threads = 1;
    std::vector<std::size_t> local_sizes = {1, 64};
    unsigned run = 256;
    KernelBenchPlan plan;
};

void print(const DeviceInfo& device, const KernelBenchPlan& plan, const std::vector<KernelSpeed>& rows) {
    std::printf("%s, %s, driver %s\n", device.name.c_str(), device.platform.c_str(), device.driver.c_str());
    std::printf("ns per item of %u, by work-group size (x items that a work-item takes)\n%-24s", plan.items,
                "kernel");
    for (const KernelBenchShape& shape : plan.shapes) {
        const std::string run = shape.run > 1 ? "x" + std::to_string(shape.run) : "";
        std::printf(" %8s", (std::to_string(shape.local_size) + run).c_str());
    }
    std::printf("\n");
    const std::size_t sizes = plan.shapes.size();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i % sizes == 0) std::printf("%-24s", rows[i].kernel.c_str());
        std::printf(" %8.2f%s", rows[i].ns_per_item.value, (i + 1) % sizes == 0 ? "\n" : "");
    }
}

Exit run(BenchKernelsOptions o) {
    check_outputs({o.json}, {o.kernels});
    o.plan.shapes.clear();
    for (const std::size_t local : o.local_sizes) o.plan.shapes.push_back({local, 1});
    if (o.run > 1) o.plan.shapes.push_back({1, o.run});
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    const std::vector<KernelSpeed> speeds = measure_kernels(device, o.plan, o.filter);
    if (speeds.empty())
        throw Error(Exit::usage, "No kernel of this bench has \"" + o.filter +
                                     "\" in its name; triad bench kernels without --filter lists them.");
    if (o.json != "-") print(device.info(), o.plan, speeds);
    Json rows = Json::array();
    for (const KernelSpeed& s : speeds)
        rows.push_back({{"kernel", s.kernel},
                        {"items", s.items},
                        {"local_size", s.shape.local_size},
                        {"run", s.shape.run},
                        {"ns_per_item", s.ns_per_item.value},
                        {"ns_per_item_low", s.ns_per_item.low},
                        {"ns_per_item_high", s.ns_per_item.high}});
    if (!o.json.empty()) write_report(o.json, "bench-kernels", &device.info(), rows);
    return Exit::done;
}

}  // namespace

void add_bench_kernels(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<BenchKernelsOptions>();
    CLI::App* command = bench.add_subcommand("kernels",
                                             "Nanoseconds of camera rays, random numbers, BSDFs, lights and "
                                             "textures, each in a kernel of its own");
    add_device(*command, o->device);
    add_threads(*command, o->threads, "1; 0: all");
    command->add_option("--items", o->plan.items, "Evaluations of a launch (default 65536)")
        ->check(whole_number_within(1024, 1 << 24))
        ->type_name("N");
    command->add_option("--rounds", o->plan.rounds, "In which the kernels take turns (default 9)")
        ->check(whole_number_within(1, 1000))
        ->type_name("N");
    command
        ->add_option(
            "--local", o->local_sizes,
            "Work-group sizes (default 1,64): where a driver vectorises across items, a large one is "
            "faster")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(whole_number_within(1, 4096))
        ->type_name("LIST");
    command
        ->add_option(
            "--run", o->run,
            "One more column: as many items one after the other in each work-item (default 256; 1: none)")
        ->check(whole_number_within(1, 65536))
        ->type_name("N");
    command->add_option("--filter", o->filter, "Only kernels with this in their names")->type_name("TEXT");
    add_json(*command, o->json);
    add_kernels(*command, o->kernels);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
