#include "viewer/view_scene.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/spans.h"
#include "render/photon_pilot.h"
#include "session/prepare.h"
#include "trace/node_format.h"

namespace triad {
namespace {

Scene loaded(const RenderRequest& request) {
    const Span span("load the scene", "load");
    return load_scene(request);
}

}  // namespace

ViewScene::ViewScene(const RenderRequest& request) : devices_(open_devices(request)) {
    for (const Device& device : devices_)
        device_words_ += (device_words_.empty() ? "" : ", ") + device.info().name;
    load(request);
}

void ViewScene::load(const RenderRequest& request) {
    Scene scene = loaded(request);
    const RenderSettings settings = settings_of(request, scene);
    const std::shared_ptr<const PackedScene> packed = packed_;
    const DeviceScenes on_devices = on_devices_;
    pack(scene, settings, {});
    try {
        const Span span("choose photons", "build");
        settings_ = with_photon_pilot(on_devices_, settings);
    } catch (...) {  // the scene before stays whole
        packed_ = packed, on_devices_ = on_devices;
        throw;
    }
    scene_ = std::move(scene);
}

void ViewScene::pack(const Scene& scene, const RenderSettings& settings,
                     const std::shared_ptr<const PackedScene>& before) {
    const Span span("build trees and upload", "build");
    BvhFormats formats;
    for (const Device& device : devices_) formats.insert(format_of(device));
    auto packed = pack_for(scene, settings, before, formats);
    DeviceScenes on_devices;
    for (Device& device : devices_) on_devices.push_back(std::make_shared<DeviceScene>(device, packed));
    packed_ = std::move(packed);
    on_devices_ = std::move(on_devices);
}

std::unique_ptr<Renderer> ViewScene::renderer(const RenderSettings& settings) {
    if (!holds_for(*packed_, settings)) {
        // For the integrator of all pictures, whatever this one's is.
        RenderSettings all = settings;
        all.integrator = settings_.integrator;
        pack(scene_, all, packed_);
        detail("Trees were built again for another eye");
    }
    return std::make_unique<Renderer>(on_devices_, settings, features_of(*packed_, settings_));
}

}  // namespace triad
