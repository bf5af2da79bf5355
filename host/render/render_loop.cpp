/// The rounds of a RenderLoop, and what it tells.
#include "render/render_loop.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>

#include "base/log.h"
#include "base/spans.h"

namespace triad {
namespace {

/// Samples of a pixel in one launch at most.
constexpr double longest_run = 256;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Photons go to the whole picture: a sample of theirs is one of every pixel.
RenderGoal even_with_photons(RenderGoal goal, std::uint64_t photons) {
    goal.adaptive = goal.adaptive && photons == 0;
    if (!goal.adaptive) goal.set_errors = nullptr;
    return goal;
}

}  // namespace

RenderLoop::RenderLoop(Renderer::State& state, const RenderGoal& goal,
                       const std::function<bool(const Progress&)>& report)
    : s_(state),
      goal_(even_with_photons(goal, state.photons())),
      report_(report),
      schedule_(goal_, unsigned(film().bins())),
      kernels_(kernel_source::hash()),
      tiles_(tile_count(film().width, film().height)),
      pixels_(set_pixels(film().width, film().height)),
      launcher_(state.tracers, pixels_, goal_.abandon != nullptr),
      have_(pixels_.size()),
      undelivered_(state.tracers.size(), Undelivered(tiles_)),
      is_dealt_with_(state.tracers.size()),
      next_delivery_(seconds_between_deliveries),
      next_kept_(goal.keep.seconds),
      next_report_(goal.report_seconds) {
    std::uint64_t before = 0;
    for (const SampleRange& range : film().ranges) {
        if (range.begin == goal_.samples.begin) continue;
        ranges_before_.push_back(range);
        before += range.end - range.begin;
    }
    samples_before_ = double(before);
    for (std::size_t i = 0; i < s_.have.size(); ++i) have_[i] = s_.have[i] - std::uint32_t(before);
    launcher_.set_meanwhile([this] { report_when_due(); });
    go_on();
}

/// From what the film holds.
void RenderLoop::go_on() {
    for (std::size_t i = 0; i < have_.size(); ++i) total_ += std::uint64_t(have_[i]) * pixels_[i];
    total_at_start_ = total_;
    if (film().devices.size() > 1 && s_.shares.sets() == 0) s_.shares = SampleShares(have_.size());
    schedule_.go_on_from(samples());
    round_.rays = film().counters[COUNTER_RAYS], round_.samples = total_;
    if (s_.progress && s_.progress->samples.begin == goal_.samples.begin) go_on_from(*s_.progress);
    s_.progress.reset();
    if (total_ > 0 && wanted_.empty() && schedule_.needs_estimate()) estimate(true);
}

RenderResult RenderLoop::run() {
    const Span span("render", "render");
    const double processor_start = processor_seconds();
    try {
        if (photons().is_classic()) make_classic_map();
        work_through_rounds();
    } catch (...) {
        try {
            keep_what_was_delivered();
        } catch (const std::exception& error) {
            warn(error.what());
        }
        throw;
    }
    const double rendered = seconds(), processor = processor_seconds() - processor_start;
    if (!abandoned_ && (!trend_.empty() || goal_.error > 0 || goal_.perceived_noise)) estimate(false);
    name_ranges();
    name_shares();
    remember();
    const Stop stop = interrupted_ ? Stop::interrupt : cut_ ? Stop::time : schedule_.stop_reason();
    if (stop == Stop::interrupt || stop == Stop::time) {
        s_.progress = film_progress();
        s_.progress->ended = stop == Stop::time;
    }
    s_.store.set_progress(s_.progress);
    const SampleRange range{goal_.samples.begin, goal_.samples.begin + least()};
    return {range, stop, rendered, processor, trend_.slope(), perceived_noise_, devices()};
}

void RenderLoop::work_through_rounds() {
    for (bool more = !wanted_.empty() || plan_round(); more; more = plan_round()) {
        reach(wanted_);
        if (interrupted_ || cut_) break;
        if (schedule_.time_is_up(samples(), seconds())) continue;  // an estimate would take more of it
        if (goal_.adaptive || schedule_.needs_estimate()) estimate(true);
    }
    // So that no failure of a device costs anything any more. Of samples with photons that were abandoned
    // some tiles are not there: that film is good for nothing.
    if (is_shared() && !(abandoned_ && has_photons_per_sample())) gather();
}

/// Sets wanted_; false: the goal is reached.
bool RenderLoop::plan_round() {
    const bool is_first = goal_.set_errors && !has_looked_;
    const auto end = schedule_.next_round(is_first ? 0 : samples(), seconds());
    if (!end) return false;
    if (is_first) {
        wanted_.assign(have_.size(), std::uint32_t(film().bins()));
        reach(wanted_);
        if (interrupted_) return false;
        gather();
        look();
    } else if (goal_.adaptive && total_ > 0) {
        if (film().sums.empty()) gather();
        look();
    }
    wanted_ = wanted_at(*end);
    return true;
}

/// What each set is to hold at the end of a round. The first samples are taken evenly: there is nothing
/// to decide by. Adaptive sampling for the relMSE gives both halves of every bin the same.
SetSamples RenderLoop::wanted_at(double end) {
    if (!set_errors_.empty()) {
        // Beside the camera's, which cost next to nothing where they meet nothing.
        const double noisy = round_.noisy - 1, everywhere = round_.everywhere - 1;
        double dearer = noisy > 0 && everywhere > 0 ? noisy / everywhere : 1.0;
        if (!goal_.where_worth_it) dearer = 0;
        Distribution next = distribute(film().width, film().height, set_errors_, have_, end,
                                       unsigned((goal_.set_errors ? 1 : 2) * film().bins()), dearer);
        round_.by_noise = next.by_noise;
        return std::move(next.samples);
    }
    return SetSamples(have_.size(), std::uint32_t(std::llround(end)));
}

/// Counts what the round took that has ended.
void RenderLoop::count_rays() {
    const std::uint64_t rays = film().counters[COUNTER_RAYS];
    if (total_ > round_.samples && rays > round_.rays)
        (round_.by_noise ? round_.noisy : round_.everywhere) =
            double(rays - round_.rays) / double(total_ - round_.samples);
    round_.rays = rays, round_.samples = total_;
}

/// Renders pass by pass until every set holds what is wanted, or it is time to stop.
void RenderLoop::reach(const SetSamples& wanted) {
    while (!interrupted_ && !cut_ && !schedule_.time_is_up(samples(), seconds())) {
        std::uint64_t waiting = 0;
        for (std::size_t i = 0; i < have_.size(); ++i) waiting += (wanted[i] > have_[i]) * pixels_[i];
        if (waiting == 0) return;
        const double fit = samples_of_pass() / double(waiting);
        if (!pass(wanted, unsigned(std::clamp(fit, 1.0, longest_run))) || abandoned_) return;
        if (goal_.follow && seconds() >= next_estimate_) estimate(false);
        if (is_shared() && seconds() >= next_delivery_) gather();
        report();
    }
}

void RenderLoop::report() {
    if (interrupted_) return;  // whoever said so is not asked again
    interrupted_ = !report_(progress());
    next_report_ = seconds() + goal_.report_seconds;
}

/// Within a pass, by the thread that render_until() was called by, with the launcher's mutex locked.
void RenderLoop::report_when_due() {
    if (seconds() >= next_report_ && (has_photons_per_sample() ? least() : total_) > 0) report();
}

std::uint32_t RenderLoop::least() const {
    std::uint32_t n = ~0u;
    for (std::size_t i = 0; i < have_.size(); ++i)
        if (pixels_[i] > 0) n = std::min(n, have_[i]);
    return n;
}

/// The film says what every pixel has, while estimates are made of it or it is kept.
void RenderLoop::name_ranges() {
    s_.store.set_ranges(with_before({goal_.samples.begin, goal_.samples.begin + least()}));
}

/// And which device took what of it.
void RenderLoop::name_shares() {
    if (s_.shares.sets() > 0) s_.store.set_shares(s_.shares.packed());
}

std::vector<SampleRange> RenderLoop::with_before(SampleRange range) const {
    std::vector<SampleRange> ranges = ranges_before_;
    if (range.end > range.begin) ranges.push_back(range);
    return ranges;
}

/// What the film that was last read says about where samples should go.
void RenderLoop::look() {
    name_ranges();
    if (goal_.set_errors)
        with_a_device([this] { set_errors_ = goal_.set_errors->of(film(), have_); });
    else
        set_errors_ = relmse_of_sets(film(), error_map(film(), Neighbours::own_set), have_);
    count_rays();
    has_looked_ = true;
    s_.store.set_ranges(ranges_before_);
}

/// Estimates the error; at the end of a round also for the decisions.
void RenderLoop::estimate(bool decides) {
    const Span span("estimate the error");
    const double began = seconds();
    name_ranges();
    gather();
    rays_ = film().counters[COUNTER_RAYS];
    relmse_ = estimated_relmse(film());
    if (goal_.perceived_noise) with_a_device([this] { perceived_noise_ = goal_.perceived_noise(film()); });
    if (relmse_ >= 0) {
        trend_.add(samples_before_ + samples(), relmse_);
        if (decides) {
            estimates_.emplace_back(samples(), relmse_);
            schedule_.add_estimate(samples(), relmse_);
        }
    }
    s_.store.set_ranges(ranges_before_);
    // Estimating reads the whole film: spend a small share of the time on it.
    next_estimate_ = seconds() + std::max(1.0, 20 * (seconds() - began));
}

/// A further render goes on from here.
void RenderLoop::remember() {
    s_.have = have_;
    for (std::uint32_t& n : s_.have) n += std::uint32_t(samples_before_);
}

std::vector<DeviceWork> RenderLoop::devices() const {
    std::vector<DeviceWork> work;
    for (std::size_t i = 0; i < s_.tracers.size(); ++i) {
        const double busy = launcher_.busy_seconds(i);
        work.push_back({&s_.tracers[i]->device().info(), launcher_.samples(i), busy,
                        launching_ > 0 ? std::max(0.0, 1 - busy / launching_) : 0,
                        s_.tracers[i]->why_lost()});
    }
    return work;
}

Progress RenderLoop::progress() const {
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

RenderResult Renderer::render_until(const RenderGoal& goal,
                                    const std::function<bool(const Progress&)>& report) {
    return RenderLoop(*state_, goal, report).run();
}

SampleRange Renderer::render(SampleRange range, const std::function<bool(const Progress&)>& report) {
    return render_until(RenderGoal{.samples = range}, report).range;
}

}  // namespace triad
