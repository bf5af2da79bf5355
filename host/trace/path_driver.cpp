#include "trace/path_driver.h"

#include <algorithm>

#include "trace/program.h"
#include "trace/wave_driver.h"

namespace triad {
namespace {

constexpr const char *driver_choice = "path_driver", *batch_choice = "batch";

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
    std::size_t most_tiles() const override {
        return device_.info().type == "cpu" ? largest_launch_items / FILM_TILE_PIXELS
                                            : PathDriver::most_tiles();
    }

  private:
    Device& device_;
    Kernel trace_paths_;
};

}  // namespace

const char* name_of(PathDriverKind kind) {
    switch (kind) {
        case PathDriverKind::mega:
            return "mega";
        case PathDriverKind::wave:
            return "wave";
        case PathDriverKind::wave_stages:
            return "wave-stages";
    }
    return "";
}

std::optional<PathDriverKind> find_path_driver(const std::string& name) {
    for (const PathDriverKind kind : all_path_drivers)
        if (name == name_of(kind)) return kind;
    return std::nullopt;
}

PathDriverKind default_path_driver(const DeviceInfo& device) {
    return device.type == "gpu" ? PathDriverKind::wave_stages : PathDriverKind::mega;
}

void set_path_driver(Device& device, PathDriverKind kind) { device.choices()[driver_choice] = name_of(kind); }

PathDriverKind path_driver_of(const Device& device) {
    const auto found = device.choices().find(driver_choice);
    return found == device.choices().end() ? PathDriverKind::mega : *find_path_driver(found->second);
}

void set_batch(Device& device, std::uint32_t paths) {
    device.choices()[batch_choice] = std::to_string(paths);
}

std::uint32_t batch_of(const Device& device) {
    const auto found = device.choices().find(batch_choice);
    const auto chosen = found == device.choices().end() ? 0ul : std::stoul(found->second);
    return chosen > 0 ? std::uint32_t(chosen) : paths_per_unit * std::max(1u, device.info().compute_units);
}

std::unique_ptr<PathDriver> make_path_driver(const DeviceScene& scene, const RenderSettings& settings,
                                             const Features& features) {
    switch (path_driver_of(scene.device())) {
        case PathDriverKind::mega:
            break;
        case PathDriverKind::wave:
            return make_wave(scene, settings, features);
        case PathDriverKind::wave_stages:
            return make_wave_stages(scene, settings, features);
    }
    return std::make_unique<Mega>(scene, settings, features);
}

}  // namespace triad
