#pragma once
/// A render from a request to files: what the command line, and any other program, goes through.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file_lock.h"
#include "check/check_beside.h"
#include "device/device.h"
#include "render/renderer.h"
#include "session/metadata.h"
#include "session/prepare.h"
#include "session/render_request.h"

namespace triad {

/// What a render came to.
struct RenderOutcome {
    Film film;
    SampleNumbers numbers;   ///< of the film
    double relmse = -1;      ///< estimated; negative: not known
    std::uint64_t rays = 0;  ///< that this render traced: the film may have others of before
    RenderResult result;

    bool complete() const { return result.stop != Stop::interrupt; }
};

/// Devices that stay open from one render to the next, with all that was compiled for them. Empty: not yet.
using OpenDevices = std::shared_ptr<std::vector<Device>>;

class RenderSession {
  public:
    /// Completes the request, sees that its files can be written and no one else writes its film, loads the
    /// scene and the film to go on from, opens the device and makes all ready. `kept`: devices of an earlier
    /// request for the same ones; those that are opened are kept there, as soon as they have proved
    /// themselves. Throws Error.
    explicit RenderSession(RenderRequest request, OpenDevices* kept = nullptr);
    /// The same of a scene that was read before.
    RenderSession(RenderRequest request, LoadedScene loaded, OpenDevices* kept = nullptr);

    /// Waits for the check of a device that is new here; throws or warns as require_right() does. What
    /// renders and hands out pictures or films does so before.
    void prove();

    /// Renders until the request's goal is reached or `report`, called after every pass, returns false. The
    /// film that the request names is written meanwhile (docs/film.md).
    RenderOutcome render(const std::function<bool(const Progress&)>& report);
    /// Writes the pictures and the film that the request names, the film even where a picture fails.
    void write(const RenderOutcome& outcome);

    /// The planes of --aov, as EXR channels.
    std::vector<Channel> layers_of(const RenderOutcome& outcome);
    /// What the pictures say of themselves.
    Metadata metadata_of(const RenderOutcome& outcome) const;
    /// The part of it that their reconstruction does not change.
    Metadata facts_of(const RenderOutcome& outcome) const;

    const RenderRequest& request() const { return request_; }
    /// Of the request. What is measured or decided for its panel comes with it.
    const RenderGoal& goal() const { return goal_; }
    const Scene& scene() const { return loaded_.scene; }
    std::string scene_name() const;                             ///< the file's, without folders; "built-in"
    const Device& device() const { return devices_->front(); }  ///< the first of those that render
    Renderer& renderer() { return *renderer_; }
    /// Samples per pixel that the film held which the render went on from.
    double resumed_samples() const { return resumed_samples_; }
    double load_seconds() const { return load_seconds_; }

  private:
    RenderRequest request_;
    std::unique_ptr<FileLock> lock_;  ///< on the film that is written
    double load_seconds_ = 0, resumed_samples_ = 0;
    std::uint64_t resumed_rays_ = 0;
    LoadedScene loaded_;
    RenderSettings settings_;
    bool check_is_due_ = false;
    OpenDevices devices_;
    OpenDevices* kept_;                 ///< null: they are not
    std::optional<CheckBeside> check_;  ///< of a device without a verdict, until it has one
    std::unique_ptr<Renderer> renderer_;
    RenderGoal goal_;
    std::optional<std::vector<SampleRange>> missing_;  ///< of the goal's samples, where the film has holes

    RenderSession(RenderRequest request, std::optional<LoadedScene> loaded, OpenDevices* kept);
    std::optional<CheckBeside> first_check();
    std::unique_ptr<Renderer> made_renderer();
    template <class Work>
    auto unless_device_is_wrong(const Work& work);
    template <class Work>
    void film_first(const Film& film, const Work& work);
    bool is_proved();
    void resume();
    void keep(const Film& film);
    RenderResult fill_holes(const std::function<bool(const Progress&)>& report);
};

}  // namespace triad
