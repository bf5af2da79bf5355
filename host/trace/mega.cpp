#include "trace/path_driver.h"
#include "trace/program.h"

namespace triad {
namespace {

class Mega : public PathDriver {
  public:
    Mega(Device& device, const RenderSettings& settings, const Features& features)
        : device_(device),
          trace_paths_(
              device.build(program_of(settings, "mega"), options_of(features)).kernel("trace_paths")) {}

    void trace(const Arguments& scene, const dev::TracePathsArguments& work) override {
        device_.run(trace_paths_, Arguments(scene).add(arguments_of(work)),
                    work.work_count * std::size_t(FILM_TILE_PIXELS));
    }

  private:
    Device& device_;
    Kernel trace_paths_;
};

}  // namespace

std::unique_ptr<PathDriver> make_mega(Device& device, const RenderSettings& settings,
                                      const Features& features) {
    return std::make_unique<Mega>(device, settings, features);
}

}  // namespace triad
