/// Films that a RenderLoop keeps while it renders, and goes on from.
#include "base/log.h"
#include "base/text.h"
#include "render/render_loop.h"

namespace triad {
namespace {

/// Of the time that rendering takes: for writing the film meanwhile.
constexpr double share_of_writes = 0.01;

}  // namespace

void RenderLoop::go_on_from(const FilmProgress& progress) {
    round_ = progress.rays;
    if (!progress.kernels.empty() && progress.kernels != kernels_) kernels_ = "several";
    if (!goal_.adaptive && goal_.error == 0) return;  // all sets get all that is asked for
    for (const auto& [samples, relmse] : progress.estimates) {
        estimates_.emplace_back(samples, relmse);
        schedule_.add_estimate(samples, relmse);
        trend_.add(samples_before_ + samples, relmse);
    }
    if (goal_.set_errors) {
        if (progress.set_errors.empty()) return;  // still at the first samples, by which it is asked first
        goal_.set_errors->go_on_from(progress.set_errors);
        has_looked_ = true;
    }
    if (progress.wanted.size() == have_.size()) wanted_ = progress.wanted;
}

FilmProgress RenderLoop::film_progress() const {
    FilmProgress progress;
    progress.words = goal_.keep.words;
    progress.kernels = kernels_;
    progress.samples = goal_.samples;
    progress.wanted = wanted_;
    progress.estimates = estimates_;
    progress.rays = round_;
    if (goal_.set_errors && has_looked_) progress.set_errors = goal_.set_errors->kept();
    return progress;
}

/// Between two launches.
void RenderLoop::keep_when_due() {
    if (abandoned_ || !is_keeping_due()) return;
    const double began = seconds();
    name_ranges();
    name_shares();
    gather();
    s_.store.set_progress(film_progress());
    goal_.keep.write(film());
    s_.store.set_progress({});
    s_.store.set_ranges(ranges_before_);
    const double took = seconds() - began;
    double interval = goal_.keep.seconds;
    if (!goal_.keep.exactly && !goal_.keep.wanted && took > share_of_writes * interval) {
        interval = took / share_of_writes;
        if (!told_of_slow_writes_)
            inform(format("Writing the film takes %.1f s: from now on it is written every %.0f s.", took,
                          interval));
        told_of_slow_writes_ = true;
    }
    next_kept_ = seconds() + interval;
}

}  // namespace triad
