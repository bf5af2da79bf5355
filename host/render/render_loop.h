#pragma once
/// One call of Renderer::render_until: launches until a goal is reached. Rounds end where something is
/// decided; passes give every pixel that wants more its next samples; launches are what devices get at once.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/adaptive.h"
#include "render/launcher.h"
#include "render/renderer_state.h"
#include "render/undelivered.h"
#include "scene/film_sets.h"

namespace triad {

/// Of several devices: what one has taken is read at least so often.
constexpr double seconds_between_deliveries = 20;

class RenderLoop {
  public:
    /// Goes on from what the state's film holds of the goal's samples.
    RenderLoop(Renderer::State& state, const RenderGoal& goal,
               const std::function<bool(const Progress&)>& report);

    RenderResult run();

  private:
    Renderer::State& s_;
    const RenderGoal goal_;
    const std::function<bool(const Progress&)>& report_;
    Schedule schedule_;
    Trend trend_;  ///< of every estimate; the schedule decides by those at the ends of rounds alone
    std::vector<std::pair<double, double>> estimates_;  ///< these: samples per pixel, relMSE
    std::string kernels_;                               ///< FilmProgress::kernels
    const std::size_t tiles_;
    const std::vector<std::uint32_t> pixels_;  ///< of each set
    Launcher launcher_;
    std::vector<SampleRange> ranges_before_;  ///< of the film, without that of the goal
    double samples_before_ = 0;               ///< over all pixels, of these
    SetSamples have_;                         ///< of the goal's
    SetSamples wanted_;                       ///< at the end of the round at hand
    SetErrors set_errors_;                    ///< the latest
    std::uint64_t total_ = 0;                 ///< samples over all pixels: what have_ adds up to
    std::uint64_t total_at_start_ = 0;
    std::vector<Undelivered> undelivered_;  ///< by tracer
    std::vector<bool> is_dealt_with_;       ///< of tracers that failed: others have their work
    std::vector<LostWork> lost_;
    std::size_t redone_ = 0;  ///< of these: tracers have other work since
    double next_delivery_ = 0;
    bool has_looked_ = false;  ///< goal_.set_errors was asked
    bool interrupted_ = false;
    bool abandoned_ = false;  ///< interrupted_ too
    /// Photons came with a sample of some tiles alone. Time may be left, where tiles took less than was
    /// foreseen; but photons of a further sample would be another one's in these tiles.
    bool cut_ = false;
    const RenderClock::time_point start_ = RenderClock::now();
    double next_estimate_ = 0.25;
    double next_kept_ = 0;
    double next_report_ = 0;  ///< within a pass
    double launching_ = 0;    ///< seconds in which the devices were to work
    bool told_of_slow_writes_ = false;
    double relmse_ = -1;
    std::optional<double> perceived_noise_;
    double photon_seconds_ = 0;  ///< of all photons of a sample
    std::uint64_t rays_ = 0;
    RoundRays round_;

    // render_loop.cpp: rounds, and what is known of the picture
    void go_on();
    void work_through_rounds();
    bool plan_round();
    SetSamples wanted_at(double end);
    void count_rays();
    void reach(const SetSamples& wanted);
    double samples_of_pass() const;  ///< where one sample per pixel is not more
    void look();
    void estimate(bool decides);
    void name_ranges();
    void name_shares();
    std::vector<SampleRange> with_before(SampleRange range) const;
    void report();
    void report_when_due();
    void remember();
    std::vector<DeviceWork> devices() const;
    Progress progress() const;

    // render_kept.cpp: films that are kept meanwhile
    void go_on_from(const FilmProgress& progress);
    FilmProgress film_progress() const;
    bool is_keeping_due() const {
        if (!goal_.keep.write) return false;
        return goal_.keep.wanted ? goal_.keep.wanted() : seconds() >= next_kept_;
    }
    void keep_when_due();

    // render_passes.cpp: what the devices do
    bool is_abandoned();
    bool pass(const SetSamples& wanted, unsigned run);
    TileWorks work_towards(const SetSamples& wanted, unsigned run, bool may_be_cut) const;
    bool pass_with_photons(TileWorks work, bool may_be_cut);
    void trace_photons(std::size_t tracer, std::uint64_t sample, double share);
    void make_classic_map();
    void choose_tiles(std::size_t tracer, const TileWorks& work);
    std::size_t scattered(std::size_t i) const;
    void count(const TileWorks& work, WorkPiece piece);
    void credit(const TileWorks& work, std::size_t tracer, WorkPiece piece);

    // render_losses.cpp: what is delivered, and what devices took along that failed
    void gather();
    bool redo_lost();
    void with_a_device(const std::function<void()>& work);
    void redo(const TileWorks& work);
    void redo_with_photons(const TileWorks& work, std::uint32_t sample);
    void recredit(const TileWorks& work, std::size_t tracer, WorkPiece piece,
                  std::optional<std::uint32_t> sample);
    void keep_what_was_delivered();

    const Film& film() const { return s_.film(); }
    PhotonTracer& photons() const { return s_.tracers.front()->photons(); }
    /// Several devices work on the picture.
    bool is_shared() const { return s_.tracers.size() > 1; }
    /// Every sample comes with photons of its own.
    bool has_photons_per_sample() const { return photons().count() > 0 && !photons().is_classic(); }

    double seconds() const { return seconds_since(start_); }
    double samples() const { return double(total_) / double(film().pixels()); }
    /// The least that any pixel has.
    std::uint32_t least() const;
};

}  // namespace triad
