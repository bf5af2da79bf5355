#pragma once
/// One picture of one scene on one or several devices: specialises, launches, and hands out the film.
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "device/device.h"
#include "pack/pack.h"
#include "render/schedule.h"
#include "scene/film.h"
#include "scene/scene.h"
#include "trace/feature_planes.h"
#include "trace/film_part.h"
#include "trace/recorder.h"
#include "trace/work_counter.h"

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

/// What a device did for a picture.
struct DeviceWork {
    const DeviceInfo* device = nullptr;
    std::uint64_t samples = 0;  ///< of all pixels together
    double busy_seconds = 0;    ///< of those in which devices were to work
    double idle = 0;            ///< share of these in which it had nothing to do
    std::string failure;        ///< a sentence; empty: it did not fail
};

struct RenderResult {
    SampleRange range;  ///< what every pixel was given; adaptive: Film::samples says what beyond that
    Stop stop = Stop::samples;
    double seconds = 0;                     ///< that rendering took
    double processor_seconds = 0;           ///< that the process took of all processors meanwhile
    std::optional<double> trend;            ///< as in Progress, of the whole render
    std::optional<double> perceived_noise;  ///< of the whole render, where it was wanted
    std::vector<DeviceWork> devices;
};

using DeviceScenes = std::vector<std::shared_ptr<const DeviceScene>>;

class Renderer {
  public:
    /// Packs the scene for one device: for a single picture. Throws Error(scene) "nothing to render ..." when
    /// the scene has no triangles. `features` are compiled in besides what features_of() finds: tests prove
    /// that what a scene does not use changes no bit, and scenes share a program.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
             const std::optional<Features>& features = {});
    /// The same for several devices, which must live as long: they share the picture by their speed.
    Renderer(const std::vector<Device*>& devices, const Scene& scene, const RenderSettings& settings,
             const std::optional<Features>& features = {});
    /// A picture of what is packed and on its devices already: builds no tree and uploads no scene again. All
    /// of `scenes` are of one PackedScene, for which holds_for(*scene, settings).
    Renderer(const DeviceScenes& scenes, const RenderSettings& settings,
             const std::optional<Features>& features = {});
    ~Renderer();

    /// Adds samples to the film, pass by pass, until a goal is reached; report is called after every pass and
    /// returns false to stop there.
    RenderResult render_until(const RenderGoal& goal, const std::function<bool(const Progress&)>& report);
    /// Adds these samples to every pixel. Returns the range that was rendered.
    SampleRange render(SampleRange range, const std::function<bool(const Progress&)>& report);

    /// Begins the film again, with another seed: the same bits as a new renderer's, without the work of
    /// making one.
    void restart(std::uint32_t seed);

    /// The film so far, read from the devices. Equal work gives equal bytes.
    Film film();
    /// The same without a copy of its arrays: the renderer is then only to be restarted, or resumed.
    Film take_film();
    /// Goes on from a film of this picture: what is rendered from now on is added to it, and a goal whose
    /// samples begin where a range of the film does wants what lies beyond. Where the film stopped before its
    /// goal, the same goal ends with the bytes of a render that never stopped. Throws Error(scene) when the
    /// film is of another picture.
    void resume(const Film& film);

    FeaturePlanes feature_planes(unsigned samples);
    /// record_paths() on the first device.
    void record_pixel(unsigned x, unsigned y, SampleRange range,
                      const std::function<void(const RecordedPath&)>& receive);

    /// What the rays of the first samples of every pixel take, on the first device.
    WorkCounts count_work(unsigned samples);
    /// Seconds that each tile of the crop takes on the first device, so many samples of it in a launch of
    /// their own, row by row; empty where they take longer than this together. The film is that of no picture
    /// afterwards: restart().
    std::vector<double> time_tiles(unsigned samples, double most_seconds);
    MemoryUse device_memory() const;  ///< of the first device

    /// The first that has not failed.
    Device& device() const;
    /// The film as it lies on that device.
    const FilmPart& film_part() const;
    const PackedScene& packed() const;
    const Features& features() const;
    /// Who brings the light, and why: a sentence.
    std::string integrator() const;
    /// With every sample of the picture, or in all for the classic map; 0: none.
    std::uint64_t photons() const;
    double pilot_seconds() const;    ///< that choosing photons took, with compiling for it
    double photon_seconds() const;   ///< that photons and their maps have taken
    double build_seconds() const;    ///< trees and packing; 0: they were there
    double compile_seconds() const;  ///< kernels, with the warm-up launch
    std::uint64_t device_bytes() const;

  private:
    friend class RenderLoop;
    struct State;
    std::unique_ptr<State> state_;

    void gather();
};

}  // namespace triad
