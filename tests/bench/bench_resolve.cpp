// What the way from bins to drives costs, stage by stage: tone maps, taps, refinement. Milliseconds per
// megapixel of the picture, 3 x 3 bins, on the device of the first argument (a --device selector), and how
// near the taps come to the time in which the device copies as many bytes as they must read and write.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench/display_bench.h"
#include "display/reconstruction.h"

using namespace triad;

namespace {

constexpr unsigned rounds = 5;

/// Bytes per second, read and written, of a kernel that copies as many floats as the planes of bins hold, in
/// runs of the shape's lanes.
double copy_speed(const std::string& selector, const Film& film) {
    Device device = Device::open({.selector = selector, .profile = true});
    const unsigned lanes = display_shape(device.info()).lanes;
    const std::string n = lanes == 1 ? "" : std::to_string(lanes);
    const Program program = device.build_source(
        "copy.cl", "kernel void copy(global const float" + n + "* a, global float" + n +
                       "* b, uint items) {\n"
                       "    const uint i = (uint)get_global_id(0);\n    if (i < items) b[i] = a[i];\n}\n");
    const std::size_t bytes = film.pixels() * film.bins() * 3 * sizeof(float);
    const std::size_t items = bytes / sizeof(float) / lanes;
    const Buffer from = device.allocate(bytes), to = device.allocate(bytes);
    device.fill_zero(from);
    std::vector<double> speeds;
    for (unsigned i = 0; i <= rounds; ++i) {
        device.run(program.kernel("copy"), Arguments().add(from).add(to).add(std::uint32_t(items)), items);
        device.finish();
        const DeviceCommand& copied = device.commands().back();
        if (i > 0) speeds.push_back(2.0 * double(bytes) / (1e-9 * double(copied.end - copied.start)));
    }
    std::sort(speeds.begin(), speeds.end());
    return speeds[speeds.size() / 2];
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string selector = argc > 1 ? argv[1] : "";
    const Film film = noise_film();
    std::printf("Milliseconds per megapixel, kernel by kernel\n");
    const double copies = copy_speed(selector, film);
    std::printf("%-44s %.1f GB/s\n", "copying", copies * 1e-9);
    const auto print = [&](const char* what, const DisplaySettings& settings) {
        std::printf("%-44s", what);
        Device device = Device::open({.selector = selector, .profile = true});
        for (const auto& [kernel, of] : time_display(device, film, settings, rounds)) {
            const double ms = of.value;
            std::printf(" %s %.2f", kernel.c_str(), ms);
            // three channels of nine bins in, one out; two passes: three columns of sums between them
            const double floats = settings.taps->outputs[0].across.empty() ? 27 + 3 : 27 + 2 * 9 + 3;
            if (kernel == "sum_taps")
                std::printf(" (%.0f %% of copying)", 100 * floats * 4e9 / (copies * ms));
        }
        std::printf("\n");
        std::fflush(stdout);
    };
    DisplaySettings box;
    box.taps = filter_taps({}, 3, 3);
    box.alpha = false;
    for (const auto& [name, map] : {std::pair("tone map none, box 3+3", ToneMap::none),
                                    {"tone map khronos, box 3+3", ToneMap::khronos},
                                    {"tone map aces, box 3+3", ToneMap::aces},
                                    {"tone map agx, box 3+3", ToneMap::agx}}) {
        box.tone_map = map;
        print(name, box);
    }
    box.tone_map = ToneMap::khronos, box.order = ToneOrder::noise_aware;
    print("khronos by the share of noise, box 3+3", box);
    box.order = ToneOrder::per_bin;
    const Panel rgb = *builtin_panel("rgb"), pentile = *builtin_panel("pentile");
    DisplaySettings settings = box;
    settings.tone_map = ToneMap::none;
    settings.taps = design_taps(rgb, 45, {.reach = 0.5, .separable = true});
    print("rgb, 9+9", settings);
    settings.taps = design_taps(rgb, 45);
    print("rgb, 15x15", settings);
    settings.refine = design_refine(rgb, 45);
    print("rgb, 15x15, refined 5", settings);
    settings.taps = design_taps(pentile, 45);
    settings.refine.reset();
    print("pentile", settings);
    settings.refine = design_refine(pentile, 45);
    print("pentile, refined 5", settings);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
