#include "trace/path_driver.h"

#include <algorithm>

#include "trace/program.h"

namespace triad {
namespace {

constexpr const char* choice = "path_driver";

class Mega : public PathDriver {
  public:
    Mega(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()),
          trace_paths_(
              device_.build(program_of(settings, "mega"), options_of(features)).kernel("trace_paths")) {}

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
        device_.run(trace_paths_, Arguments(scene).add(arguments_of(work)),
                    work.work_count * std::size_t(FILM_TILE_PIXELS));
    }
    std::uint64_t bytes() const override { return 0; }

  private:
    Device& device_;
    Kernel trace_paths_;
};

/// Of the trees of lights that paths search: the kernel unrolls the search.
std::uint32_t levels_of(const PackedScene& packed) {
    return std::max({1u, packed.light_shape.levels, packed.environment.rows.levels});
}

class Wave : public PathDriver {
  public:
    Wave(const DeviceScene& scene, const RenderSettings& settings, const Features& features)
        : device_(scene.device()) {
        Options options = options_of(features);
        options["TRIAD_CDF_LEVELS"] = std::to_string(levels_of(scene.packed()));
        trace_wave_ = device_.build(program_of(settings, "wave"), options).kernel("trace_wave");
        pools_.pool_count = std::max(1u, device_.info().compute_units);
        pools_.states = planes(1), pools_.pixels = planes(1), pools_.taken = planes(1);
        pools_.paths = planes(POOL_PATH_PLANES), pools_.hits = planes(POOL_HIT_PLANES);
        pools_.pending = planes(POOL_LIGHT_PLANES);
        pools_.next_pixel = device_.allocate_array<std::uint32_t>(1);
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

    /// So many of every pool.
    DeviceArray<std::uint32_t> planes(std::size_t count) {
        const auto array = device_.allocate_array<std::uint32_t>(pools_.pool_count * count * POOL_PLANE);
        bytes_ += array.bytes();
        return array;
    }
};

}  // namespace

const char* name_of(PathDriverKind kind) { return kind == PathDriverKind::wave ? "wave" : "mega"; }

std::optional<PathDriverKind> find_path_driver(const std::string& name) {
    for (const PathDriverKind kind : {PathDriverKind::mega, PathDriverKind::wave})
        if (name == name_of(kind)) return kind;
    return std::nullopt;
}

void set_path_driver(Device& device, PathDriverKind kind) { device.choices()[choice] = name_of(kind); }

PathDriverKind path_driver_of(const Device& device) {
    const auto found = device.choices().find(choice);
    return found == device.choices().end() ? PathDriverKind::mega : *find_path_driver(found->second);
}

std::unique_ptr<PathDriver> make_path_driver(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features) {
    if (path_driver_of(scene.device()) == PathDriverKind::wave)
        return std::make_unique<Wave>(scene, settings, features);
    return std::make_unique<Mega>(scene, settings, features);
}

}  // namespace triad
