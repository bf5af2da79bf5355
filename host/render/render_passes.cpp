/// The passes of a RenderLoop.
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "render/render_loop.h"

namespace triad {
namespace {

/// Launches between two reports, where one sample per pixel takes no longer: of short ones, and of long ones.
constexpr double launches_per_pass = 4, long_launches_per_pass = 2;
/// Of the photons of a sample that is cut: fewer would be too noisy even for few tiles.
constexpr double least_photon_share = 0.25;
/// Of a pass with photons, for each device: the last one ends soon after the others.
constexpr unsigned samples_to_share = 16;

}  // namespace

double RenderLoop::samples_of_pass() const {
    double longest = 0, of_calls = 0;
    for (std::size_t i = 0; i < s_.tracers.size(); ++i) {
        longest = std::max(longest, launcher_.call_seconds(i));
        of_calls += launcher_.samples_of_launch(i, launcher_.call_seconds(i));
    }
    return std::max(
        launcher_.pace() * std::max(launches_per_pass * launch_seconds, long_launches_per_pass * longest),
        long_launches_per_pass * of_calls);
}

/// One pass: up to `run` samples for every pixel that wants more. False when time was up before its end,
/// which leaves sets uneven, and never happens before every pixel has a sample.
bool RenderLoop::pass(const SetSamples& wanted, unsigned run) {
    const auto bins = unsigned(film().bins());  // each gets as many samples, wherever a render is cut
    run = std::max(run / bins, 1u) * bins;
    if (has_photons_per_sample() && is_shared())  // samples are what these share
        run = std::max(run, samples_to_share * unsigned(s_.tracers.size()) * bins);
    // A film that is to go on holds no samples with a part of their photons.
    const bool may_be_cut = least() > 0 && schedule_.may_end_within_sample(samples(), seconds()) &&
                            !(goal_.keep.write && has_photons_per_sample());
    const double taken = double(total_ - total_at_start_), per_sample = taken > 0 ? seconds() / taken : 0;
    if (!goal_.adaptive && per_sample > 0) {  // even passes: the last one ends at the time asked for
        const double fit = schedule_.time_left(seconds()) / (per_sample * double(film().pixels())) / bins;
        const double whole = may_be_cut ? std::floor(fit) : std::round(fit);
        run = bins * unsigned(std::clamp(whole, 1.0, double(run / bins)));
    }
    const TileWorks work = work_towards(wanted, run, may_be_cut);
    if (has_photons_per_sample()) return pass_with_photons(work, may_be_cut);
    const auto give_work = [&] {
        launcher_.on_every_tracer([&](std::size_t i) { s_.tracers[i]->set_work(work); });
    };
    std::size_t given = redone_;
    give_work();
    WorkShare share = launcher_.share_of(work);
    const auto time_is_up = [&] { return may_be_cut && schedule_.time_is_up(samples(), seconds()); };
    while (!share.is_done() && !time_is_up() && !is_abandoned()) {
        if (std::exchange(given, redone_) != redone_) give_work();
        bool has_launched = false;
        const double began = seconds();
        launcher_.run(share, work,
                      {.first_sample = goal_.samples.begin,
                       .launch_seconds =
                           [&](double most) {
                               return may_be_cut ? std::min(most, schedule_.time_left(seconds())) : most;
                           },
                       .stop =
                           [&] {
                               if (!is_shared()) report_when_due();
                               return is_abandoned() || (has_launched && (is_keeping_due() || time_is_up()));
                           },
                       .taken =
                           [&](std::size_t tracer, WorkPiece piece) {
                               count(work, piece), credit(work, tracer, piece);
                               for (std::size_t i = 0; i < piece.count && is_shared(); ++i)
                                   undelivered_[tracer].add(work[piece.first + i]);
                               has_launched = true;
                           }});
        launching_ += seconds() - began;
        redo_lost();
        keep_when_due();
    }
    return share.is_done();
}

/// Up to `run` samples of every set that wants more. With photons, which are a sample's of the whole picture,
/// only of sets that have the least, and up to what others have.
TileWorks RenderLoop::work_towards(const SetSamples& wanted, unsigned run, bool may_be_cut) const {
    std::uint32_t from = ~0u;
    if (has_photons_per_sample()) {
        from = least();
        for (const std::uint32_t n : have_)
            if (n > from) run = std::min(run, n - from);
    }
    TileWorks work;
    for (std::size_t i = 0; i < tiles_; ++i) {
        const std::size_t t = may_be_cut ? scattered(i) : i;
        dev::TileWork w{std::uint32_t(t), {have_[2 * t], have_[2 * t + 1]}, {}, {}};
        for (std::size_t set = 0; set < 2; ++set) {
            const std::uint32_t have = have_[2 * t + set], want = wanted[2 * t + set];
            if (want > have && have <= from) w.sample_count[set] = std::min(want - have, run);
        }
        if (w.sample_count[0] + w.sample_count[1] > 0) work.push_back(w);
    }
    return work;
}

/// The same for an even pass whose samples come with photons. Paths may want these, so that it must be
/// known beforehand how many tiles time leaves.
bool RenderLoop::pass_with_photons(TileWorks work, bool may_be_cut) {
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
    }
    for (dev::TileWork& w : work) w.sample_count[0] = w.sample_count[1] = 1;
    const auto give_work = [&] {
        launcher_.on_every_tracer([&](std::size_t i) {
            s_.tracers[i]->set_work(work);
            choose_tiles(i, work);
        });
    };
    std::size_t given = redone_;
    give_work();
    const auto shared = std::make_shared<const TileWorks>(work);
    const std::uint64_t first = goal_.samples.begin + work.front().first_sample[0];
    const WorkPiece whole{0, work.size()};
    for (std::uint32_t next = 0; next < run && !interrupted_;) {
        if (std::exchange(given, redone_) != redone_) give_work();
        bool has_begun = false;
        std::vector<std::size_t> takers;  // of the samples, in their order
        std::size_t lead = 0;             // takes a sample that is cut alone
        while (lead + 1 < s_.tracers.size() && !launcher_.is_alive(lead)) ++lead;
        const double began = seconds();
        // Every device takes whole samples: photons light a picture as a whole. A cut one is the first's.
        launcher_.on_every_tracer([&](std::size_t tracer) {
            for (;;) {
                std::uint32_t i;
                {
                    const std::lock_guard lock(launcher_.mutex());
                    if (!is_shared()) report_when_due();
                    if (next == run || (may_be_cut && tracer != lead) || interrupted_ || is_abandoned() ||
                        (has_begun && is_keeping_due()))
                        return;
                    i = next++, has_begun = true;
                    takers.push_back(tracer);
                    if (is_shared()) undelivered_[tracer].add_sample(shared, i);
                    count(work, whole);
                }
                trace_photons(tracer, first + i, share);
                launcher_.run_on(tracer, work, goal_.samples.begin + i, [&] {
                    const std::lock_guard lock(launcher_.mutex());
                    return is_abandoned();
                });
            }
        });
        for (const std::size_t tracer : takers) credit(work, tracer, whole);
        launching_ += seconds() - began;
        redo_lost();
        keep_when_due();
    }
    if (work.size() < tiles_) launcher_.on_every_tracer([this](std::size_t i) { choose_tiles(i, {}); });
    cut_ = work.size() < all;
    return !cut_;
}

/// Photons count in the tiles of this work alone; empty: in all.
void RenderLoop::choose_tiles(std::size_t tracer, const TileWorks& work) {
    if (work.size() == tiles_) return;
    std::vector<std::uint32_t> chosen(tiles_, work.empty() ? 1 : 0);
    for (const dev::TileWork& w : work) chosen[w.tile] = 1;
    s_.tracers[tracer]->photons().set_tiles(chosen);
}

void RenderLoop::trace_photons(std::size_t i, std::uint64_t sample, double share) {
    const double began = seconds();
    Tracer& tracer = *s_.tracers[i];
    PhotonTracer& photons = tracer.photons();
    photons.trace(sample, std::uint64_t(std::ceil(share * double(photons.count()))), tracer.part());
    tracer.finish();
    const double took = seconds() - began;
    const std::lock_guard lock(launcher_.mutex());
    launcher_.add_busy(i, took);
    s_.photon_seconds += took;
    photon_seconds_ = took / share;
    schedule_.set_least_step(least_photon_share * photon_seconds_ * double(film().bins()));
}

/// Unless it was made before.
void RenderLoop::make_classic_map() {
    const double began = seconds();
    launcher_.on_every_tracer(
        [this](std::size_t i) { s_.tracers[i]->photons().make_classic_map(s_.tracers[i]->part()); });
    s_.photon_seconds += seconds() - began;
}

/// The tiles in an order whose every beginning is spread over the picture: a pass that is cut favours no
/// part of it. Steps of the golden ratio, made coprime to the number of tiles.
std::size_t RenderLoop::scattered(std::size_t i) const {
    std::size_t step = std::max<std::size_t>(1, std::size_t(double(tiles_) * 0.6180339887498949));
    while (std::gcd(step, tiles_) != 1) ++step;
    return i * step % tiles_;
}

bool RenderLoop::is_abandoned() {
    if (!abandoned_ && goal_.abandon && goal_.abandon()) abandoned_ = interrupted_ = true;
    return abandoned_;
}

/// Samples that were taken.
void RenderLoop::count(const TileWorks& work, WorkPiece piece) {
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) {
        total_ += launcher_.samples_of(work[i]);
        for (std::size_t set = 0; set < 2; ++set) have_[2 * work[i].tile + set] += work[i].sample_count[set];
    }
}

/// The next samples of their sets, by this tracer.
void RenderLoop::credit(const TileWorks& work, std::size_t tracer, WorkPiece piece) {
    if (s_.shares.sets() == 0) return;
    const std::uint32_t device = s_.store.place_of(s_.tracers[tracer]->device().info());
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i)
        for (std::size_t set = 0; set < 2; ++set)
            s_.shares.add(2 * work[i].tile + set, device, work[i].sample_count[set]);
}

}  // namespace triad
