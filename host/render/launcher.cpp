#include "render/launcher.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "base/spans.h"
#include "render/renderer_state.h"

namespace triad {
namespace {

/// A device that takes so many times as long as it ever did hangs.
constexpr double times_the_longest = 50;

/// But no sooner than after so many seconds, and at its first launch, which a driver may compile for, after
/// more.
struct Patience {
    double least, first;
};
constexpr Patience with_others{10, 120}, alone{60, 3600};  // an only one is given up with the render

const Patience& patience_of(const Tracers& tracers) { return tracers.size() > 1 ? with_others : alone; }

/// Between two calls of what is done while tracers work.
constexpr std::chrono::milliseconds meanwhile_interval{200};

}  // namespace

Launcher::~Launcher() {
    for (std::size_t i = 0; i < tracers_.size(); ++i) be_most_patient(i);
}

double Launcher::pace() const {
    double sum = 0;
    for (const auto& tracer : tracers_) sum += tracer->pace;
    return sum;
}

double Launcher::samples_of_launch(std::size_t i, double seconds) const {
    return tracers_[i]->launch_times.samples_in(seconds);
}

double Launcher::call_seconds(std::size_t i) const {
    return launch_seconds * (in_haste_ ? 1 : tracers_[i]->launches());
}

std::uint64_t Launcher::samples_of(const dev::TileWork& w) const {
    return std::uint64_t(w.sample_count[0]) * set_pixels_[2 * w.tile] +
           std::uint64_t(w.sample_count[1]) * set_pixels_[2 * w.tile + 1];
}

WorkShare Launcher::share_of(const std::vector<dev::TileWork>& work) const {
    std::vector<std::uint64_t> sizes;
    for (const dev::TileWork& w : work) sizes.push_back(samples_of(w));
    std::vector<double> paces;
    for (const auto& tracer : tracers_) paces.push_back(tracer->pace);
    return {std::move(sizes), std::move(paces)};
}

/// Waits for it, and measures the pace.
void Launcher::launch(std::size_t i, WorkPiece piece, const std::vector<dev::TileWork>& work,
                      std::uint64_t first_sample) {
    Tracer& tracer = *tracers_[i];
    std::uint64_t samples = 0;
    for (std::size_t k = 0; k < piece.count; ++k) samples += samples_of(work[piece.first + k]);
    be_patient(i);
    const Span span("launch");
    const auto start = RenderClock::now();
    tracer.trace(piece.first, piece.count, first_sample);
    tracer.finish();
    const double took = seconds_since(start), rate = double(samples) / std::max(took, 1e-6);
    const std::lock_guard lock(mutex_);
    tracer.launch_times.add(double(samples), took);
    // Small launches are dominated by overhead and must not make the next ones smaller still.
    tracer.pace = std::max(0.5 * (tracer.pace + rate), rate);
    busy_[i] += took, samples_[i] += samples;
    longest_[i] = std::max(longest_[i], took);
}

void Launcher::be_patient(std::size_t i) {
    const Patience& patience = patience_of(tracers_);
    const double measured = times_the_longest * longest_[i];
    tracers_[i]->device().set_patience(std::max(measured, longest_[i] > 0 ? patience.least : patience.first));
}

void Launcher::be_most_patient(std::size_t i) {
    tracers_[i]->device().set_patience(
        std::max(times_the_longest * longest_[i], patience_of(tracers_).first));
}

void Launcher::run(WorkShare& share, const std::vector<dev::TileWork>& work, const Orders& orders) {
    on_every_tracer([&](std::size_t i) {
        for (;;) {
            WorkPiece piece;
            {
                const std::lock_guard lock(mutex_);
                if (orders.stop()) return;
                share.set_pace(i, tracers_[i]->pace);
                piece = share.take(i, samples_of_launch(i, orders.launch_seconds(call_seconds(i))),
                                   tracers_[i]->most_tiles());
                if (piece.count == 0) return;
                orders.taken(i, piece);
            }
            launch(i, piece, work, orders.first_sample);
        }
    });
}

void Launcher::run_on(std::size_t i, const std::vector<dev::TileWork>& work, std::uint64_t first_sample,
                      const std::function<bool()>& stop) {
    std::vector<std::uint64_t> sizes;
    for (const dev::TileWork& w : work) sizes.push_back(samples_of(w));
    WorkShare share(std::move(sizes), {0});
    while (!share.is_done() && !stop()) {
        share.set_pace(0, tracers_[i]->pace);  // which this thread alone changes
        launch(i, share.take(0, samples_of_launch(i, call_seconds(i)), tracers_[i]->most_tiles()), work,
               first_sample);
    }
}

void Launcher::attempt(std::size_t i, const std::function<void(std::size_t)>& work) {
    if (!is_alive(i)) return;
    if (tracers_.size() == 1) return work(i);
    try {
        work(i);
    } catch (const Error&) {
        const std::lock_guard lock(mutex_);
        tracers_[i]->failure = last_failure_ = std::current_exception();
    }
}

void Launcher::require_one() const {
    for (std::size_t i = 0; i < tracers_.size(); ++i)
        if (is_alive(i)) return;
    std::rethrow_exception(last_failure_ ? last_failure_ : tracers_.back()->failure);
}

void Launcher::on_every_tracer(const std::function<void(std::size_t)>& work) {
    if (tracers_.size() == 1) return work(0);
    std::vector<std::size_t> alive;
    for (std::size_t i = 0; i < tracers_.size(); ++i)
        if (is_alive(i)) alive.push_back(i);
    std::exception_ptr defect;  // of the program, not of a device
    std::size_t at_work = alive.size();
    std::condition_variable ended;
    const auto on = [&](std::size_t i) {
        std::exception_ptr thrown;
        try {
            attempt(i, work);
        } catch (...) {
            thrown = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        if (thrown) defect = thrown;
        --at_work;
        ended.notify_one();
    };
    {
        std::vector<std::jthread> threads;
        std::size_t k = 0;
        try {
            for (; k < alive.size(); ++k) threads.emplace_back(on, alive[k]);
        } catch (
            const std::system_error&) {  // a limit of the shell: the rest in this one, one after the other
            for (; k < alive.size(); ++k) on(alive[k]);
        }
        std::unique_lock lock(mutex_);
        while (!ended.wait_for(lock, meanwhile_interval, [&] { return at_work == 0; }))
            if (meanwhile_) meanwhile_();
    }
    if (defect) std::rethrow_exception(defect);
    require_one();
}

}  // namespace triad
