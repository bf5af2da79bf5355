/// What a RenderLoop does when a device fails: what it took and had not delivered goes to the others.
#include <algorithm>
#include <exception>
#include <mutex>
#include <string>

#include "base/log.h"
#include "base/spans.h"
#include "render/render_loop.h"

namespace triad {

/// Reads the parts into the film's arrays. Of several devices, parts are emptied: what was read is delivered,
/// whatever happens to the device; and where one fails at that, the others do its work again and deliver too.
void RenderLoop::gather() {
    const Span span("read the film");
    if (!is_shared()) {
        s_.store.gather(s_.tracers);
        return;
    }
    do {
        for (std::size_t i = 0; i < s_.tracers.size(); ++i) {
            launcher_.attempt(i, [this](std::size_t tracer) {
                s_.store.deliver(*s_.tracers[tracer], undelivered_[tracer].samples(have_.size()));
                undelivered_[tracer].clear();
                s_.tracers[tracer]->empty();
            });
        }
        launcher_.require_one();
    } while (redo_lost());
    next_delivery_ = seconds() + seconds_between_deliveries;
}

/// Of devices that failed since this was last called. False: none did.
bool RenderLoop::redo_lost() {
    if (!is_shared()) return false;
    for (bool any = false;; any = true) {
        for (std::size_t i = 0; i < s_.tracers.size(); ++i) {
            if (launcher_.is_alive(i) || is_dealt_with_[i]) continue;
            is_dealt_with_[i] = true;
            for (LostWork& lost : undelivered_[i].take()) lost_.push_back(std::move(lost));
            const std::string& name = s_.tracers[i]->device().info().name;
            warn(name + " failed and is left out; the other devices do again what it had not delivered. " +
                 s_.tracers[i]->why_lost());
        }
        launcher_.require_one();
        if (lost_.empty()) return any;
        const LostWork lost = lost_.back();  // there it stays until it is done
        if (lost.photon_sample)
            redo_with_photons(lost.work, *lost.photon_sample);
        else
            redo(lost.work);
        ++redone_;
        lost_.pop_back();
    }
}

/// What needs a device besides launches, the first that has not failed: where it fails at this, the next does
/// it.
void RenderLoop::with_a_device(const std::function<void()>& work) {
    for (;;) {
        try {
            for (std::size_t i = 0; i < s_.tracers.size(); ++i) launcher_.be_most_patient(i);
            return work();
        } catch (const DeviceError&) {
            if (!is_shared()) throw;
            s_.first_alive().failure = std::current_exception();
            redo_lost();  // of what is read nothing is lost; throws when none is left
        }
    }
}

void RenderLoop::redo(const TileWorks& work) {
    launcher_.on_every_tracer([&](std::size_t i) { s_.tracers[i]->set_work(work); });
    WorkShare share = launcher_.share_of(work);
    while (!share.is_done()) {
        launcher_.run(share, work,
                      {.first_sample = goal_.samples.begin,
                       .launch_seconds = [](double most) { return most; },
                       .stop = [] { return false; },
                       .taken = [&](std::size_t i, WorkPiece piece) { recredit(work, i, piece, {}); }});
        launcher_.require_one();
    }
}

void RenderLoop::redo_with_photons(const TileWorks& work, std::uint32_t sample) {
    const auto shared = std::make_shared<const TileWorks>(work);
    bool is_done = false;
    for (std::size_t i = 0; i < s_.tracers.size() && !is_done; ++i) {
        if (!launcher_.is_alive(i)) continue;
        launcher_.attempt(i, [&](std::size_t tracer) {
            s_.tracers[tracer]->set_work(work);
            choose_tiles(tracer, work);
            undelivered_[tracer].add_sample(shared, sample);
            is_done = true;  // or lost again, with what this device takes along
            recredit(work, tracer, {0, work.size()}, sample);
            trace_photons(tracer, goal_.samples.begin + work.front().first_sample[0] + sample,
                          goal_.photon_share);
            launcher_.run_on(tracer, work, goal_.samples.begin + sample, [] { return false; });
            choose_tiles(tracer, {});
        });
    }
    launcher_.require_one();
}

/// These samples are another tracer's now.
void RenderLoop::recredit(const TileWorks& work, std::size_t tracer, WorkPiece piece,
                          std::optional<std::uint32_t> sample) {
    const std::uint32_t device = s_.store.place_of(s_.tracers[tracer]->device().info());
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) {
        if (!sample) undelivered_[tracer].add(work[i]);
        if (s_.shares.sets() == 0) continue;
        for (std::size_t set = 0; set < 2; ++set)
            s_.shares.set(2 * work[i].tile + set,
                          std::uint32_t(samples_before_) + work[i].first_sample[set] + sample.value_or(0),
                          work[i].sample_count[set], device);
    }
}

/// When no device is left: the film is what was delivered, without tiles that lack samples in the middle of
/// those that they have, and is kept if the goal says so.
void RenderLoop::keep_what_was_delivered() {
    if (!is_shared() || film().sums.empty() || !goal_.keep.write) return;
    const SetSamples delivered = samples_of_sets(film());
    std::vector<bool> has_hole(tiles_);
    for (Undelivered& rest : undelivered_)
        for (LostWork& lost : rest.take()) lost_.push_back(std::move(lost));
    const auto before = std::uint32_t(samples_before_);
    for (const LostWork& lost : lost_)
        for (const dev::TileWork& w : lost.work)
            for (std::size_t set = 0; set < 2; ++set)
                if (w.sample_count[set] > 0 && before + w.first_sample[set] + lost.photon_sample.value_or(0) <
                                                   delivered[2 * w.tile + set])
                    has_hole[w.tile] = true;
    s_.store.drop_tiles(has_hole);
    for (std::size_t i = 0; i < have_.size(); ++i) have_[i] = has_hole[i / 2] ? 0 : delivered[i] - before;
    if (s_.shares.sets() > 0)
        for (std::size_t i = 0; i < have_.size(); ++i) s_.shares.cut(i, has_hole[i / 2] ? 0 : delivered[i]);
    name_ranges();
    name_shares();
    s_.store.set_progress(film_progress());
    goal_.keep.write(film());
}

}  // namespace triad
