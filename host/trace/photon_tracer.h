#pragma once
/// The photons of a picture on one device: traced to the film, and into a map where paths gather them.
#include <vector>

#include "trace/device_scene.h"
#include "trace/film_part.h"
#include "trace/photon_map.h"

namespace triad {

class PhotonTracer {
  public:
    /// Allocates what the scene's arguments need of photons; nothing where paths bring all light.
    PhotonTracer(const DeviceScene& scene, const RenderSettings& settings, const dev::Frame& frame,
                 std::size_t tiles);

    /// Compiles the kernels, with a discarded launch. `arguments`: of SCENE_PARAMETERS.
    void compile(const Options& options, const Arguments& arguments, const FilmPart& part);
    /// The next picture's map is another.
    void restart() { has_classic_map_ = false; }

    /// With every sample of the picture, or in all for the classic map; 0: paths bring all light.
    std::uint64_t count() const { return count_; }
    /// There is one map, made once: make_classic_map().
    bool is_classic() const { return integrator() == Integrator::photon_map; }

    /// Which tiles of the crop the next photons count in: one number for each, 1 or 0.
    void set_tiles(const std::vector<std::uint32_t>& chosen);
    /// Traces the photons of a sample of the picture, `count` of them standing for all: to the film, and into
    /// the map where paths gather. Enqueues only.
    void trace(std::uint64_t sample, std::uint64_t count, const FilmPart& part);
    /// Makes the map of the classic method unless this seed has it.
    void make_classic_map(const FilmPart& part);

    const PhotonMap& map() const { return map_; }
    std::uint64_t bytes() const;

  private:
    Integrator integrator() const { return integrator_of(scene_.packed(), settings_); }

    const DeviceScene& scene_;
    Device& device_;
    RenderSettings settings_;
    dev::Frame frame_;
    std::uint64_t count_ = 0;
    bool has_classic_map_ = false;
    DeviceArray<dev::PhotonFrame> shared_;
    DeviceArray<std::uint32_t> lights_, tiles_;
    DeviceArray<dev::Caster> casters_;
    PhotonMap map_;  ///< none: nothing is gathered
    Arguments arguments_;
    Kernel trace_photons_;
};

}  // namespace triad
