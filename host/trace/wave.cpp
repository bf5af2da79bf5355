#include <algorithm>
#include <cstdlib>

#include "trace/path_driver.h"
#include "trace/program.h"

namespace triad {
namespace {

/// Planes of a slot at most: of PathState, Hit and PendingLight.
constexpr std::uint32_t path_words = 80, hit_words = 6, light_words = 20;

std::size_t from_env(const char* name, std::size_t value) {
    const char* text = std::getenv(name);
    return text ? std::size_t(std::atol(text)) : value;
}

/// Of the trees that paths search: programs unroll that.
std::uint32_t levels_of(const PackedScene& packed) {
    return std::max({1u, packed.light_shape.levels, packed.environment.rows.levels});
}

class Wave : public PathDriver {
  public:
    Wave(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()) {
        const std::size_t slots = from_env("WAVE_SLOTS", 256), plane = slots + 16;
        Options options = options_of(features);
        options["TRIAD_POOL"] = std::to_string(slots);
        options["TRIAD_PLANE"] = std::to_string(plane);
        options["TRIAD_CDF_LEVELS"] = std::to_string(levels_of(scene.packed()));
        trace_wave_ = device_.build(program_of(settings, "wave"), options).kernel("trace_wave");
        const std::size_t pools = std::max(1u, device_.info().compute_units);
        const auto planes = [&](std::size_t words) {
            const auto array = device_.allocate_array<std::uint32_t>(pools * plane * words);
            bytes_ += array.bytes();
            return array;
        };
        pools_.states = planes(1), pools_.pixels = planes(1), pools_.taken = planes(1);
        pools_.paths = planes(path_words), pools_.hits = planes(hit_words), pools_.pending = planes(light_words);
        pools_.next_pixel = device_.allocate_array<std::uint32_t>(1);
        pools_.pool_count = std::uint32_t(pools);
        pools_.path_words = path_words, pools_.hit_words = hit_words, pools_.light_words = light_words;
    }

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
#define TRIAD_COPY(type, name) pools_.name = work.name;
        TRACE_PATHS_LIST(TRIAD_COPY, TRIAD_COPY, TRIAD_COPY, TRIAD_COPY)
#undef TRIAD_COPY
        device_.fill_zero(pools_.next_pixel);
        device_.run(trace_wave_, Arguments(scene).add(arguments_of(pools_)), pools_.pool_count, 1);
    }

    std::uint64_t bytes() const override { return bytes_; }

  private:
    Device& device_;
    Kernel trace_wave_;
    dev::TraceWaveArguments pools_;
    std::uint64_t bytes_ = 0;
};

}  // namespace

std::unique_ptr<PathDriver> make_wave(const DeviceScene& scene, const RenderSettings& settings,
                                      const Features& features) {
    return std::make_unique<Wave>(scene, settings, features);
}

}  // namespace triad
