#pragma once
/// From the options of `triad render` to what a renderer needs: scene, settings, device.
#include <cstddef>
#include <vector>

#include "device/device.h"
#include "pack/settings.h"
#include "scene/scene.h"
#include "session/render_request.h"

namespace triad {

/// A scene as its file gives it, or the built-in one.
struct LoadedScene {
    Scene scene;
    GltfReport report;
};

/// Warnings are logged. Throws Error(scene), Error(unsupported), Error(usage) when an output would replace a
/// file of the scene.
LoadedScene read_scene(const RenderRequest& options);

/// What else is asked for: glass, light (the environment of the command line, or a plain sky where nothing
/// gives light), lines as wide as the picture wants them. Throws Error.
void prepare_scene(const RenderRequest& options, Scene& scene);

/// Both.
Scene load_scene(const RenderRequest& options);

/// "MATERIAL=NAME": every material of that name becomes that glass. Throws Error(usage).
void apply_glass(Scene& scene, const std::string& text);

/// What decides the picture, the view chosen. Throws Error(usage) for a pixel outside it.
RenderSettings settings_of(const RenderRequest& options, const Scene& scene);

/// The device of --device and --threads, tuned, and checked unless it was before. Throws Error(device) when
/// it computes wrong answers and --force is not given.
Device open_device(const RenderRequest& options);

/// Those of --device SEL[/N][,SEL[/N]...] or all, at least one. Of several, one that cannot be opened or
/// computes wrong answers is left out with a warning.
/// `check_is_due`: a single whole device that is new here is not checked, and this says so, where its check
/// can run beside the picture (RenderSession::prove()).
std::vector<Device> open_devices(const RenderRequest& options, bool* check_is_due = nullptr);

/// Places of usable devices by the hardware that they are drivers of.
std::vector<std::vector<std::size_t>> hardware_of(const std::vector<DeviceInfo>& devices);

}  // namespace triad
