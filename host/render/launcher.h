#pragma once
/// Launches of a list of work, on every tracer at once, that are neither long nor short.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "render/film_store.h"
#include "render/work_share.h"

namespace triad {

/// Of a launch: watchdogs, cancelling and progress want short ones, overhead long ones.
constexpr double launch_seconds = 0.05;

class Launcher {
  public:
    /// `set_pixels`: of each set of the film. Both must live as long.
    /// `in_haste`: someone waits between launches, so that none takes several at once.
    Launcher(Tracers& tracers, const std::vector<std::uint32_t>& set_pixels, bool in_haste)
        : tracers_(tracers),
          set_pixels_(set_pixels),
          in_haste_(in_haste),
          busy_(tracers.size()),
          longest_(tracers.size()),
          samples_(tracers.size()) {}
    Launcher(const Launcher&) = delete;
    Launcher& operator=(const Launcher&) = delete;
    /// Devices are given the time that a first launch may take: what they do next may be one.
    ~Launcher();

    /// Where several tracers work in threads of their own, the thread that waits for them calls this some
    /// times a second, with mutex() locked.
    void set_meanwhile(std::function<void()> work) { meanwhile_ = std::move(work); }

    /// Samples that all tracers trace in a second; 0: nothing was measured yet.
    double pace() const;
    /// That a launch of a tracer has which is to take so many seconds; 0: nothing was measured yet.
    double samples_of_launch(std::size_t tracer, double seconds) const;
    /// Seconds that a call of a tracer is to take: of a launch, or of as many as it makes at once.
    double call_seconds(std::size_t tracer) const;
    /// Samples that a tile's work adds up to.
    std::uint64_t samples_of(const dev::TileWork& work) const;
    /// Of this work, by the paces so far.
    WorkShare share_of(const std::vector<dev::TileWork>& work) const;

    /// What the callers are asked and told, one at a time.
    struct Orders {
        std::uint64_t first_sample = 0;                     ///< from which those of the work are counted
        std::function<double(double most)> launch_seconds;  ///< of the next launch, `most` at most
        std::function<bool()> stop;                         ///< before each: leave the rest
        std::function<void(std::size_t tracer, WorkPiece)> taken;
    };
    /// Launches on every tracer, each in a thread of its own where there are several, until the work, which
    /// the tracers were given, is done or orders.stop() says so; measures their paces. What a tracer has
    /// taken it has done, or it has failed.
    void run(WorkShare& share, const std::vector<dev::TileWork>& work, const Orders& orders);

    /// One launch of one tracer after the other until a whole list is done, as run() does it, or `stop`,
    /// asked before each, says so.
    void run_on(std::size_t tracer, const std::vector<dev::TileWork>& work, std::uint64_t first_sample,
                const std::function<bool()>& stop);

    /// Calls work(tracer) for every tracer that has not failed, each in a thread of its own where there are
    /// several. One that throws an Error has failed, and is used no more; throws it when none is left.
    void on_every_tracer(const std::function<void(std::size_t)>& work);
    /// The same of one, in this thread; does nothing where it has failed.
    void attempt(std::size_t tracer, const std::function<void(std::size_t)>& work);
    bool is_alive(std::size_t tracer) const { return !tracers_[tracer]->failure; }
    /// Throws what the last one threw when none is left.
    void require_one() const;

    /// Of other work of a tracer.
    void add_busy(std::size_t tracer, double seconds) {
        busy_[tracer] += seconds;
        longest_[tracer] = std::max(longest_[tracer], seconds);
    }
    /// From here on this tracer's device is given up when it hangs: soon where there are others.
    void be_patient(std::size_t tracer);
    /// The same for work that programs may be compiled for.
    void be_most_patient(std::size_t tracer);
    /// Seconds that a tracer worked, and samples that it took, so far.
    double busy_seconds(std::size_t tracer) const { return busy_[tracer]; }
    std::uint64_t samples(std::size_t tracer) const { return samples_[tracer]; }
    std::mutex& mutex() { return mutex_; }  ///< of what the threads of run() and on_every_tracer() share

  private:
    Tracers& tracers_;
    const std::vector<std::uint32_t>& set_pixels_;
    const bool in_haste_;
    std::vector<double> busy_, longest_;  ///< longest_: of a launch
    std::vector<std::uint64_t> samples_;
    std::mutex mutex_;
    std::function<void()> meanwhile_;
    std::exception_ptr last_failure_;

    void launch(std::size_t tracer, WorkPiece piece, const std::vector<dev::TileWork>& work,
                std::uint64_t first_sample);
};

}  // namespace triad
