#pragma once
/// The thread that renders for a page: it owns scene and devices, takes the page's changes, and hands out
/// pictures.
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/render_request.h"
#include "viewer/exchange.h"
#include "viewer/orbit_camera.h"
#include "viewer/view_scene.h"
#include "viewer/view_state.h"

namespace triad {

class ViewLoop {
  public:
    /// The command line that renders a picture with these options instead of the request's; to be copied. How
    /// samples become pixels stays as it was asked for where `keeps_display`.
    using Command = std::function<std::string(const std::vector<std::string>& options, bool keeps_display)>;

    /// `request`: complete()d. The exchange must live as long.
    ViewLoop(RenderRequest request, Command command, Exchange& exchange);

    /// Loads and renders until the exchange is closed. Throws Error where the scene or a device fails.
    void run();

  private:
    using Clock = std::chrono::steady_clock;

    /// Grows over many calls of its renderer.
    struct Growing {
        std::unique_ptr<Renderer> renderer;
        ViewCourse course;
        bool complete = false;
        std::optional<Film> film;  ///< as it was last handed out while nothing was rendered
    };

    RenderRequest request_;  ///< with what was changed
    const RenderRequest first_;
    const Command command_;
    Exchange& exchange_;
    std::unique_ptr<ViewScene> scene_;
    ViewFacts facts_;
    OrbitCamera camera_;
    std::shared_ptr<const Panel> panel_;
    std::optional<std::string> variant_;  ///< to be loaded
    std::array<unsigned, 4> region_{};
    Growing whole_, part_;
    std::optional<Film> preview_;  ///< the latest, where nothing better was rendered
    unsigned first_divisor_ = 4;   ///< of the first picture after a move: coarse enough to be there at once
    unsigned divisor_ = 4;         ///< of the next preview; 1: none is needed
    double pace_ = 0;              ///< samples per second; 0: not known
    double show_seconds_ = 0;      ///< that showing a picture which is no preview took
    bool restyle_ = false, starting_ = true;
    Clock::time_point next_show_{}, began_{};

    // view_loop.cpp: what is rendered when
    void open();
    void reload();
    void restart();
    void preview();
    void grow();
    RenderGoal goal_of(Growing& picture);
    Growing& current() { return region_[2] > 0 ? part_ : whole_; }
    uvec2 size() const;
    RenderSettings settings_of(unsigned divisor) const;

    // view_changes.cpp: what the page asks for
    void take_changes(Urgency at_most = Urgency::picture);
    void apply(const ViewChange& change);
    void look(const ViewChange& change);
    void set_camera(int index);
    void move_to(const OrbitCamera& camera);
    void set_panel(const std::string& name, bool subpixels);
    void set_region(std::array<unsigned, 4> region);

    // view_show.cpp: what it is shown
    enum class Shown { preview, whole, region };
    void show(const Film& film, Shown what);
    Clock::time_point show_time(double cost) const;
    void show_around();
    void show_again();
    void serve(const Film& film);
    void serve_or_refuse();
    void note_kernels();
    void tell();
    bool keeps_display() const;
    std::vector<std::string> options() const;
};

}  // namespace triad
