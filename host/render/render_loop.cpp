/// Renderer::render: launches until a goal is reached.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <numeric>

#include "render/adaptive.h"
#include "render/launcher.h"
#include "render/renderer_state.h"
#include "scene/film_sets.h"

namespace triad {
namespace {

/// Launches between two reports, where one sample per pixel takes no longer.
constexpr double launches_per_pass = 4;
/// Samples of a pixel in one launch at most.
constexpr double longest_run = 256;
/// Of the photons of a sample that is cut: fewer would be too noisy even for few tiles.
constexpr double least_photon_share = 0.25;

}  // namespace

/// One call of Renderer::render.
class RenderLoop {
  public:
    RenderLoop(Renderer::State& state, const RenderGoal& goal,
               const std::function<bool(const Progress&)>& report)
        : s_(state),
          goal_(even_with_photons(goal, state.photons())),
          report_(report),
          schedule_(goal_, unsigned(film().bins())),
          tiles_(tile_count(film().width, film().height)),
          pixels_(set_pixels(film().width, film().height)),
          launcher_(state.tracers, pixels_),
          have_(pixels_.size()),
          ranges_before_(film().ranges),
          samples_before_(double(film().sample_count())) {
        assert(ranges_before_.empty() || (!goal_.adaptive && goal.error == 0));
    }

    RenderResult run() {
        if (photons().is_classic()) make_classic_map();
        while (const auto end = schedule_.next_round(samples(), seconds())) {
            if (goal_.adaptive && goal_.set_errors && total_ == 0) {
                reach(SetSamples(have_.size(), std::uint32_t(film().bins())));
                gather();
                look();
            } else if (goal_.adaptive && total_ > 0) {
                look();
            }
            reach(wanted_at(*end));
            if (interrupted_ || cut_) break;
            if (schedule_.time_is_up(samples(), seconds())) continue;  // an estimate would take more of it
            if (goal_.adaptive || schedule_.needs_estimate()) estimate(true);
        }
        const double rendered = seconds(), processor = processor_seconds() - processor_start_;
        if (!trend_.empty() || goal_.error > 0 || goal_.perceived_noise) estimate(false);
        const SampleRange range{goal_.samples.begin, goal_.samples.begin + least()};
        s_.store.set_ranges(with_before(range));
        const Stop stop = interrupted_ ? Stop::interrupt : cut_ ? Stop::time : schedule_.stop_reason();
        return {range, stop, rendered, processor, trend_.slope(), perceived_noise_};
    }

  private:
    Renderer::State& s_;
    const RenderGoal goal_;
    const std::function<bool(const Progress&)>& report_;
    Schedule schedule_;
    Trend trend_;  ///< of every estimate; the schedule decides by those at the ends of rounds alone
    const std::size_t tiles_;
    const std::vector<std::uint32_t> pixels_;  ///< of each set
    Launcher launcher_;
    SetSamples have_;
    const std::vector<SampleRange> ranges_before_;
    const double samples_before_;
    SetErrors set_errors_;     ///< the latest
    std::uint64_t total_ = 0;  ///< samples over all pixels
    bool interrupted_ = false;
    /// Photons came with a sample of some tiles alone. Time may be left, where tiles took less than was
    /// foreseen; but photons of a further sample would be another one's in these tiles.
    bool cut_ = false;
    const RenderClock::time_point start_ = RenderClock::now();
    const double processor_start_ = processor_seconds();
    double next_estimate_ = 0.25;
    double relmse_ = -1;
    std::optional<double> perceived_noise_;
    double photon_seconds_ = 0;  ///< of all photons of a sample
    std::uint64_t rays_ = 0;

    /// Photons go to the whole picture: a sample of theirs is one of every pixel.
    static RenderGoal even_with_photons(RenderGoal goal, std::uint64_t photons) {
        goal.adaptive = goal.adaptive && photons == 0;
        return goal;
    }

    const Film& film() const { return s_.film(); }
    PhotonTracer& photons() { return s_.tracers.front()->photons(); }
    void gather() { s_.store.gather(s_.tracers); }

    double seconds() const { return seconds_since(start_); }
    static double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }
    double samples() const { return double(total_) / double(film().pixels()); }

    /// The least that any pixel has.
    std::uint32_t least() const {
        std::uint32_t n = ~0u;
        for (std::size_t i = 0; i < have_.size(); ++i)
            if (pixels_[i] > 0) n = std::min(n, have_[i]);
        return n;
    }

    /// What each set is to hold at the end of a round. The first samples are taken evenly: there is nothing
    /// to decide by. Adaptive sampling for the relMSE gives both halves of every bin the same.
    SetSamples wanted_at(double end) const {
        if (!set_errors_.empty())
            return distribute(film().width, film().height, set_errors_, have_, end,
                              unsigned((goal_.set_errors ? 1 : 2) * film().bins()));
        return SetSamples(have_.size(), std::uint32_t(std::llround(end)));
    }

    /// Renders pass by pass until every set holds what is wanted, or it is time to stop.
    void reach(const SetSamples& wanted) {
        while (!interrupted_ && !cut_ && !schedule_.time_is_up(samples(), seconds())) {
            std::uint64_t waiting = 0;
            for (std::size_t i = 0; i < have_.size(); ++i) waiting += (wanted[i] > have_[i]) * pixels_[i];
            if (waiting == 0) return;
            const double fit = launcher_.pace() * launches_per_pass * launch_seconds / double(waiting);
            if (!pass(wanted, unsigned(std::clamp(fit, 1.0, longest_run)))) return;
            if (goal_.follow && seconds() >= next_estimate_) estimate(false);
            interrupted_ = !report_(progress());
        }
    }

    /// One pass: up to `run` samples for every pixel that wants more. False when time was up before its end,
    /// which leaves sets uneven, and never happens before every pixel has a sample.
    bool pass(const SetSamples& wanted, unsigned run) {
        const auto bins = unsigned(film().bins());  // each gets as many samples, wherever a render is cut
        run = std::max(run / bins, 1u) * bins;
        const bool may_be_cut = least() > 0 && schedule_.may_end_within_sample(samples(), seconds());
        const double per_sample = total_ > 0 ? seconds() / double(total_) : 0;
        if (!goal_.adaptive && per_sample > 0) {  // even passes: the last one ends at the time asked for
            const double fit = schedule_.time_left(seconds()) / (per_sample * double(film().pixels())) / bins;
            const double whole = may_be_cut ? std::floor(fit) : std::round(fit);
            run = bins * unsigned(std::clamp(whole, 1.0, double(run / bins)));
        }
        std::vector<dev::TileWork> work;
        for (std::size_t i = 0; i < tiles_; ++i) {
            const std::size_t t = may_be_cut ? scattered(i) : i;
            dev::TileWork w{std::uint32_t(t), {have_[2 * t], have_[2 * t + 1]}, {}, {}};
            for (std::size_t set = 0; set < 2; ++set)
                w.sample_count[set] = std::min(wanted[2 * t + set] - have_[2 * t + set], run);
            if (w.sample_count[0] + w.sample_count[1] > 0) work.push_back(w);
        }
        if (photons().count() > 0 && !photons().is_classic()) return pass_with_photons(work, may_be_cut);
        for (auto& tracer : s_.tracers) tracer->set_work(work);
        std::size_t done = 0;
        while (done < work.size() && !(may_be_cut && schedule_.time_is_up(samples(), seconds())))
            done += launch(work, done, 0, may_be_cut);
        return done == work.size();
    }

    /// The same for an even pass whose samples come with photons. Paths may want these, so that it must be
    /// known beforehand how many tiles time leaves.
    bool pass_with_photons(std::vector<dev::TileWork> work, bool may_be_cut) {
        const std::size_t all = work.size();
        const std::uint32_t run = work.front().sample_count[0];
        double share = goal_.photon_share;
        if (may_be_cut) {
            std::uint64_t items = 0;
            for (const dev::TileWork& w : work) items += launcher_.samples_of(w);
            const double paths = double(items) / launcher_.pace(), photon_time = run * photon_seconds_,
                         left = schedule_.time_left(seconds());
            if (const auto bins = std::uint32_t(film().bins()); run > bins && left < paths + photon_time) {
                for (dev::TileWork& w : work) w.sample_count[0] = w.sample_count[1] = bins;
                return pass_with_photons(std::move(work), may_be_cut);  // fewer samples rather than tiles
            }
            // as many photons in proportion as tiles, but enough of them
            double tiles = std::min(left / (paths + photon_time), 1.0);
            share = std::max(tiles, least_photon_share);
            if (tiles < share) tiles = std::clamp((left - share * photon_time) / paths, 0.0, 1.0);
            work.resize(std::max<std::size_t>(std::size_t(tiles * double(all)), 1));
            std::vector<std::uint32_t> chosen(tiles_, 0);
            for (const dev::TileWork& w : work) chosen[w.tile] = 1;
            photons().set_tiles(chosen);
        }
        for (dev::TileWork& w : work) w.sample_count[0] = w.sample_count[1] = 1;
        for (auto& tracer : s_.tracers) tracer->set_work(work);
        for (std::uint32_t i = 0; i < run; ++i) {
            trace_photons(goal_.samples.begin + work.front().first_sample[0] + i, share);
            for (std::size_t done = 0; done < work.size();) done += launch(work, done, i, may_be_cut);
        }
        if (may_be_cut) photons().set_tiles(std::vector<std::uint32_t>(tiles_, 1));
        cut_ = work.size() < all;
        return !cut_;
    }

    void trace_photons(std::uint64_t sample, double share) {
        const double began = seconds();
        Tracer& tracer = *s_.tracers.front();
        photons().trace(sample, std::uint64_t(std::ceil(share * double(photons().count()))), tracer.part());
        tracer.finish();
        const double took = seconds() - began;
        s_.photon_seconds += took;
        photon_seconds_ = took / share;
        schedule_.set_least_step(least_photon_share * photon_seconds_ * double(film().bins()));
    }

    /// Unless it was made before.
    void make_classic_map() {
        const double began = seconds();
        photons().make_classic_map(s_.tracers.front()->part());
        s_.photon_seconds += seconds() - began;
    }

    /// The tiles in an order whose every beginning is spread over the picture: a pass that is cut favours no
    /// part of it. Steps of the golden ratio, made coprime to the number of tiles.
    std::size_t scattered(std::size_t i) const {
        std::size_t step = std::max<std::size_t>(1, std::size_t(double(tiles_) * 0.6180339887498949));
        while (std::gcd(step, tiles_) != 1) ++step;
        return i * step % tiles_;
    }

    /// As much of work[first, ...) as takes launch_seconds, or the time left, on every tracer at once;
    /// `sample` samples on. Returns how many tiles that were.
    std::size_t launch(const std::vector<dev::TileWork>& work, std::size_t first, std::uint32_t sample,
                       bool may_be_cut) {
        const double time =
            may_be_cut ? std::min(launch_seconds, schedule_.time_left(seconds())) : launch_seconds;
        const Launcher::Launched done = launcher_.launch(work, first, goal_.samples.begin + sample, time);
        total_ += done.samples;
        for (std::size_t i = first; i < first + done.tiles; ++i)
            for (std::size_t set = 0; set < 2; ++set)
                have_[2 * work[i].tile + set] += work[i].sample_count[set];
        return done.tiles;
    }

    /// The film says what every pixel has, while estimates are made of it.
    void name_ranges() {
        s_.store.set_ranges(with_before({goal_.samples.begin, goal_.samples.begin + least()}));
    }

    std::vector<SampleRange> with_before(SampleRange range) const {
        std::vector<SampleRange> ranges = ranges_before_;
        if (range.end > range.begin) ranges.push_back(range);
        return ranges;
    }

    /// What the film that was last read says about where samples should go.
    void look() {
        name_ranges();
        set_errors_ = goal_.set_errors
                          ? goal_.set_errors(film(), have_)
                          : relmse_of_sets(film(), error_map(film(), Neighbours::own_set), have_);
        s_.store.set_ranges(ranges_before_);
    }

    /// Estimates the error; at the end of a round also for the decisions.
    void estimate(bool decides) {
        const double began = seconds();
        name_ranges();
        gather();
        rays_ = film().counters[COUNTER_RAYS];
        relmse_ = estimated_relmse(film());
        if (goal_.perceived_noise) perceived_noise_ = goal_.perceived_noise(film());
        if (relmse_ >= 0) {
            trend_.add(samples_before_ + samples(), relmse_);
            if (decides) schedule_.add_estimate(samples(), relmse_);
        }
        s_.store.set_ranges(ranges_before_);
        // Estimating reads the whole film: spend a small share of the time on it.
        next_estimate_ = seconds() + std::max(1.0, 20 * (seconds() - began));
    }

    Progress progress() const {
        Progress p;
        p.samples = samples();
        p.seconds = seconds();
        p.seconds_left = schedule_.seconds_left(p.samples, p.seconds, trend_);
        p.seconds_to_error = schedule_.seconds_to_error(p.samples, p.seconds, trend_);
        p.done = p.seconds_left < 0 ? 0.0 : p.seconds / (p.seconds + p.seconds_left);
        p.relmse = relmse_;
        p.trend = trend_.slope();
        p.rays = rays_;
        p.perceived_noise = perceived_noise_;
        return p;
    }
};

RenderResult Renderer::render_until(const RenderGoal& goal,
                                    const std::function<bool(const Progress&)>& report) {
    return RenderLoop(*state_, goal, report).run();
}

SampleRange Renderer::render(SampleRange range, const std::function<bool(const Progress&)>& report) {
    return render_until(RenderGoal{.samples = range}, report).range;
}

}  // namespace triad
