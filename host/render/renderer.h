#pragma once
/// One picture of one scene on one device: packs, specialises, launches, and hands out the film.
#include <functional>
#include <memory>
#include <optional>

#include "device/device.h"
#include "render/features.h"
#include "render/record.h"
#include "render/schedule.h"
#include "render/settings.h"
#include "scene/film.h"
#include "scene/scene.h"

namespace triad {

/// State after a pass.
struct Progress {
    double samples = 0;  ///< per pixel; their mean where they differ
    double seconds = 0;  ///< since render() began
    double seconds_left =
        -1;  ///< until the first goal is reached, at the pace and trend so far; negative: not known yet
    double seconds_to_error = -1;  ///< until the error asked for is; negative: none was, or not known yet
    double done = 0;               ///< of the whole, 0 to 1
    double relmse = -1;            ///< the latest estimate; negative: not known yet
    std::optional<double> trend;   ///< slope of log relMSE against log samples; none: not known yet
    std::uint64_t rays = 0;        ///< at the latest estimate
    std::optional<double> perceived_noise;  ///< RenderGoal::perceived_noise, at the latest estimate
};

struct RenderResult {
    SampleRange range;  ///< what every pixel was given; adaptive: Film::samples says what beyond that
    Stop stop = Stop::samples;
    double seconds = 0;                     ///< that rendering took
    std::optional<double> trend;            ///< as in Progress, of the whole render
    std::optional<double> perceived_noise;  ///< of the whole render, where it was wanted
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

    /// Adds samples to the film, pass by pass, until a goal is reached; report is called after every pass and
    /// returns false to stop there. A goal of error, and adaptive sampling, want an empty film.
    RenderResult render_until(const RenderGoal& goal, const std::function<bool(const Progress&)>& report);
    /// Adds these samples to every pixel. Returns the range that was rendered.
    SampleRange render(SampleRange range, const std::function<bool(const Progress&)>& report);

    /// Begins the film again, with another seed: the same bits as a new renderer's, without the work of
    /// making one.
    void restart(std::uint32_t seed);

    /// The film so far, read from the device. Equal work gives equal bytes.
    Film film();

    /// Deterministic features of what the camera sees, averaged over the given samples of the same paths:
    /// planes of floats per pixel: albedo (3), shading normal (3, world), position (3, world), depth (1,
    /// along the view).
    struct FeaturePlanes {
        std::vector<float> albedo, normal, position, depth;
    };
    FeaturePlanes feature_planes(unsigned samples);

    /// Receives the paths of samples [range) of one pixel of the crop, vertex by vertex. The bits are those
    /// that render() adds to the film.
    void record_pixel(unsigned x, unsigned y, SampleRange range,
                      const std::function<void(const RecordedPath&)>& receive);
    /// What light can come from, for RecordedVertex: every material, then every punctual light, then the
    /// environment.
    const std::vector<std::string>& light_sources() const;

    const Features& features() const;
    const std::string& integrator() const;  ///< which one was chosen, and why
    /// With every sample of the picture, or in all for the classic map; 0: none.
    std::uint64_t photons() const;
    double photon_seconds() const;   ///< that photons and their maps have taken
    double build_seconds() const;    ///< trees and packing
    double compile_seconds() const;  ///< kernels, with the warm-up launch
    std::uint64_t device_bytes() const;

  private:
    friend class RenderLoop;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace triad
