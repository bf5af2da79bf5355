#pragma once
/// One device's work on one picture: from lists of work to a part of the film.
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "trace/device_scene.h"
#include "trace/film_part.h"
#include "trace/launch_times.h"
#include "trace/path_driver.h"
#include "trace/photon_tracer.h"

namespace triad {

class Tracer {
  public:
    /// Compiles the kernels, with a first, discarded launch, as some drivers compile at launches. `shape`: of
    /// the film, its arrays are not read.
    Tracer(std::shared_ptr<const DeviceScene> scene, const RenderSettings& settings, const Features& features,
           const Film& shape);

    /// Begins again, with another seed: the part of the film is empty.
    void restart(std::uint32_t seed);

    /// The tiles that trace() is to take samples of.
    void set_work(std::span<const dev::TileWork> work);
    /// Enqueues samples of work[first, first + count), which are counted from first_sample.
    void trace(std::size_t first, std::size_t count, std::uint64_t first_sample);
    void finish();

    Device& device() const { return device_; }
    const DeviceScene& scene() const { return *scene_; }
    const RenderSettings& settings() const { return settings_; }
    const Features& features() const { return features_; }
    const dev::Frame& frame() const { return frame_; }
    const Arguments& arguments() const { return arguments_; }  ///< of the scene
    FilmPart& part() { return part_; }
    PhotonTracer& photons() { return photons_; }
    std::uint64_t bytes() const;
    /// The same, by what it is for.
    MemoryUse memory() const;
    std::size_t most_tiles() const { return driver_->most_tiles(); }  ///< of one call of trace()
    unsigned launches() const { return driver_->launches(); }         ///< as long as so many it may take

    /// The part of the film is read: it begins again.
    void empty();

    /// Samples that it traces in a second, by what was measured last; 0: nothing was.
    double pace = 0;
    LaunchTimes launch_times;
    /// What its device threw, where several work on a picture: it is asked for nothing more.
    std::exception_ptr failure;
    std::string why_lost() const;  ///< a sentence; empty: it did not fail

  private:
    std::shared_ptr<const DeviceScene> scene_;
    Device& device_;
    RenderSettings settings_;
    Features features_;
    dev::Frame frame_;
    DeviceArray<dev::Frame> frame_buffer_;
    PhotonTracer photons_;
    Arguments arguments_;
    FilmPart part_;
    DeviceArray<dev::TileWork> work_;
    std::vector<dev::TileWork> tiles_;  ///< what work_ holds
    std::unique_ptr<PathDriver> driver_;
};

}  // namespace triad
