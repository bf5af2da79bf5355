#pragma once
/// One picture of one scene on one device: packs, specialises, launches, and hands out the film.
#include <functional>
#include <memory>
#include <optional>

#include "device/device.h"
#include "render/features.h"
#include "render/settings.h"
#include "scene/film.h"
#include "scene/scene.h"

namespace triad {

/// State after a pass. Samples are per pixel.
struct Progress {
    std::uint64_t samples_done = 0, samples_wanted = 0;
    double seconds = 0;  ///< since render() began
    double relmse = -1;  ///< estimated; negative: not known yet
    std::uint64_t rays = 0;
};

class Renderer {
  public:
    /// Builds the trees, uploads the scene and compiles the kernels (a first, discarded launch compiles on
    /// drivers that do so at launch). Throws Error(scene) "nothing to render ..." when the scene has no
    /// triangles.
    /// `features` replaces what features_of() finds: tests prove that leaving things out changes no bit.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
             const std::optional<Features>& features = {});
    ~Renderer();

    /// Adds these samples to the film, pass by pass; report is called after every pass and returns false to
    /// stop there. Returns the range that was rendered.
    SampleRange render(SampleRange range, const std::function<bool(const Progress&)>& report);

    /// The film so far, read from the device. Equal work gives equal bytes.
    Film film();

    /// Deterministic features of what the camera sees, averaged over the given samples of the same paths:
    /// planes of floats per pixel: albedo (3), shading normal (3, world), position (3, world), depth (1,
    /// along the view).
    struct FeaturePlanes {
        std::vector<float> albedo, normal, position, depth;
    };
    FeaturePlanes feature_planes(unsigned samples);

    const Features& features() const;
    double build_seconds() const;    ///< trees and packing
    double compile_seconds() const;  ///< kernels, with the warm-up launch
    std::uint64_t device_bytes() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace triad
