#pragma once
/// A render from a request to files: what the command line, and any other program, goes through.
#include <functional>
#include <memory>

#include "device/device.h"
#include "render/renderer.h"
#include "session/metadata.h"
#include "session/render_request.h"

namespace triad {

/// What a render came to.
struct RenderOutcome {
    Film film;
    SampleNumbers numbers;  ///< of the film
    double relmse = -1;     ///< estimated; negative: not known
    RenderResult result;

    bool complete() const { return result.stop != Stop::interrupt; }
};

class RenderSession {
  public:
    /// Completes the request, sees that its files can be written, loads the scene, opens the device and makes
    /// all ready. Throws Error.
    explicit RenderSession(RenderRequest request);

    /// Renders until the request's goal is reached or `report`, called after every pass, returns false.
    RenderOutcome render(const std::function<bool(const Progress&)>& report);
    /// Writes the film and the pictures that the request names.
    void write(const RenderOutcome& outcome);

    /// What the pictures say of themselves.
    Metadata metadata_of(const RenderOutcome& outcome) const;

    const RenderRequest& request() const { return request_; }
    /// Of the request. What is measured or decided for its panel comes with it.
    const RenderGoal& goal() const { return goal_; }
    const Scene& scene() const { return scene_; }
    std::string scene_name() const;  ///< the file's, without folders; "built-in"
    const Device& device() const { return device_; }
    Renderer& renderer() { return *renderer_; }
    double load_seconds() const { return load_seconds_; }

  private:
    RenderRequest request_;
    double load_seconds_ = 0;
    Scene scene_;
    RenderSettings settings_;
    Device device_;
    std::unique_ptr<Renderer> renderer_;
    RenderGoal goal_;
};

}  // namespace triad
