#include "session/capture_pass.h"

#include <utility>

#include "base/memory_limit.h"
#include "base/parallel_for.h"
#include "device/report.h"
#include "profile/work_json.h"
#include "render/renderer.h"
#include "session/prepare.h"

namespace triad {
namespace {

CaptureOrigin origin_of(const Device& device) {
    const DeviceInfo& info = device.info();
    return {TRIAD_VERSION, command_words(),           info.name, info.driver,
            info.platform, device.platform_version(), info.type, device.preferred_local()};
}

/// Ends the recording, whatever ends the render.
class WhileRecording {
  public:
    WhileRecording(Device& device, Recording& to) : device_(device) { device.record(&to); }
    ~WhileRecording() { device_.record(nullptr); }
    WhileRecording(const WhileRecording&) = delete;
    WhileRecording& operator=(const WhileRecording&) = delete;

    /// What the buffer holds now, as a part of the film.
    CapturedArray array(CapturedArray::What what, const Buffer& buffer, std::uint64_t first_pixel,
                        std::uint64_t pixels) const {
        AlignedVector<std::byte> content(buffer.bytes());
        device_.read(buffer, content.data(), content.size());
        return {what, device_.recorded(buffer).value(), first_pixel, pixels,
                std::make_shared<const AlignedVector<std::byte>>(std::move(content))};
    }

  private:
    Device& device_;
};

}  // namespace

Capture capture_pass(RenderRequest request) {
    complete(request);
    set_host_threads(request.threads);
    kernel_source::set_folder(request.kernels_path);
    const Scene scene = load_scene(request);
    const RenderSettings settings = settings_of(request, scene);
    Device device = open_device(request);
    Renderer renderer(device, scene, settings);
    RenderGoal goal = request.goal();
    goal.follow = false;
    const auto render = [&] { renderer.render_until(goal, [](const Progress&) { return true; }); };
    render();
    renderer.restart(settings.seed);
    device.finish();

    Capture capture;
    capture.origin = origin_of(device);
    const WhileRecording recording(device, capture.work);
    render();
    const FilmPart& part = renderer.film_part();
    std::uint64_t pixels = 0;
    for (const FilmPart::Band& band : part.bands()) {
        capture.film.push_back(
            recording.array(CapturedArray::What::sums, band.sums, band.first_pixel, band.pixels));
        capture.film.push_back(
            recording.array(CapturedArray::What::half_sums, band.half_sums, band.first_pixel, band.pixels));
        pixels += band.pixels;
    }
    capture.film.push_back(recording.array(CapturedArray::What::samples, part.samples(), 0, pixels));
    capture.film.push_back(recording.array(CapturedArray::What::counters, part.counters(), 0, pixels));
    capture.width = settings.crop[2] ? settings.crop[2] : settings.width;
    capture.height = pixels / capture.width;
    capture.bins = settings.bins_x * settings.bins_y;
    device.record(nullptr);
    capture.counted = text_of(renderer.count_work(counted_samples));
    return capture;
}

}  // namespace triad
