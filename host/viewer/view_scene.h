#pragma once
/// A scene on its devices, for pictures from any eye.
#include <string>
#include <vector>

#include "io/io.h"
#include "render/renderer.h"
#include "session/render_request.h"

namespace triad {

class ViewScene {
  public:
    /// Loads the scene, opens the devices, builds and uploads. Throws Error as a render does.
    explicit ViewScene(const RenderRequest& request);

    /// The scene as another request wants it (another variant of its materials), on the same devices. As
    /// before where it throws.
    void load(const RenderRequest& request);

    const Scene& scene() const { return scene_; }
    const std::string& device_words() const { return device_words_; }
    Device& device() { return devices_.front(); }
    std::vector<Device>& devices() { return devices_; }
    /// Of the picture as it was asked for. What a pilot found of photons is in it, so that no other picture
    /// waits for one.
    const RenderSettings& settings() const { return settings_; }

    /// A picture with these settings, which differ from settings() in what no packing depends on, or in the
    /// eye: trees are built again only where they do not hold for it (holds_for). All pictures of a scene are
    /// rendered by the same programs, but that bins need others.
    std::unique_ptr<Renderer> renderer(const RenderSettings& settings);

    /// How many times trees were built for an eye, of this scene.
    unsigned packings() const { return packed_->packings; }

  private:
    std::vector<Device> devices_;
    std::string device_words_;
    Scene scene_;
    RenderSettings settings_;
    std::shared_ptr<const PackedScene> packed_;
    DeviceScenes on_devices_;

    void pack(const Scene& scene, const RenderSettings& settings,
              const std::shared_ptr<const PackedScene>& before);
};

}  // namespace triad
