#pragma once
/// How many samples to take next, and when to stop: decisions only, without a clock, a film or a device.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/adaptive.h"
#include "scene/film.h"

namespace triad {

/// The film is handed out while it is rendered, so that what stops the program costs little.
struct KeptFilm {
    std::function<void(const Film&)> write;  ///< empty: it is not
    /// Between two; where writing would take more than one percent of the time, a hundred times what it takes
    /// unless `exactly`.
    double seconds = 60;
    bool exactly = false;
    std::vector<std::string> words;  ///< FilmProgress::words
    /// Asked before every launch, by any thread but one at a time: whether to hand out the film now; true
    /// until it was. Where it is given, nothing is handed out by `seconds`.
    std::function<bool()> wanted;
};

/// What a render is to reach. Whichever comes first ends it.
struct RenderGoal {
    SampleRange samples;          ///< at most these; adaptive: as many per pixel on average
    double error = 0;             ///< estimated relMSE of the picture; 0: not asked for
    double seconds = 0;           ///< of rendering; 0: not asked for
    bool adaptive = false;        ///< samples go where they lower the error most (render/adaptive.h)
    bool where_worth_it = false;  ///< adaptive: only where that promises enough, else everywhere
    /// The perceived error's share that more samples lower, of a film, for reports; empty: not wanted. None:
    /// not known yet.
    std::function<std::optional<double>(const Film&)> perceived_noise;
    bool follow = true;  ///< estimate the error now and then for reports, also where nothing is decided by it
    double report_seconds = 1;  ///< between two reports within a pass, where one takes long
    double photon_share = 1;    ///< of the photons of a sample: so many are traced, and stand for all
    /// What adaptive sampling lowers; empty: the relMSE. Shown the film with one sample in every bin, with
    /// two, and at the end of every round; each set holds so many.
    std::shared_ptr<SetErrorSource> set_errors;
    KeptFilm keep;
    /// Asked as KeptFilm::wanted is: true ends the render before the next launch, wherever its pass is. Where
    /// photons come with every sample, the film then lacks a part of one, and is good for nothing; else it
    /// may be gone on from. Empty: never.
    std::function<bool()> abandon;
};

enum class Stop { samples, error, time, interrupt };
std::string to_string(Stop stop);

/// The error's course: relMSE = a n^slope, fitted to the latest four octaves of samples by least squares on
/// logarithms.
class Trend {
  public:
    void add(double samples, double relmse);
    bool empty() const { return points_.empty(); }
    double samples() const { return points_.back().samples; }  ///< of the latest estimate
    double relmse() const { return points_.back().relmse; }
    /// None while it cannot be told from less than half an octave.
    std::optional<double> slope() const;
    /// Samples per pixel at which the error will be `relmse`; the slope is taken as -1 (independent samples)
    /// while it is not known, and kept to what renders do.
    double samples_for(double relmse) const;

  private:
    struct Point {
        double samples, relmse;
    };
    std::vector<Point> points_;
};

/// Cuts a render into rounds. A goal of error is decided by estimates at the ends of rounds alone, and these
/// depend on samples and estimates alone: the same picture stops at the same samples on every machine. A goal
/// of time cannot.
class Schedule {
  public:
    Schedule(const RenderGoal& goal, unsigned bins);

    /// Whether the error must be estimated before the next round().
    bool needs_estimate() const { return goal_.error > 0; }
    void add_estimate(double samples, double relmse) { trend_.add(samples, relmse); }
    /// So many samples per pixel were there before time began.
    void go_on_from(double samples) { first_samples_ = round_began_samples_ = samples; }

    /// Mean samples per pixel at which the round that begins now is to end; none: stop, for stop_reason().
    /// `samples` per pixel and `seconds` are those of the render so far.
    std::optional<double> next_round(double samples, double seconds);
    Stop stop_reason() const { return stop_; }

    /// Until the time that was asked for is over; infinite when none was.
    double time_left(double seconds) const;
    /// Whether the render may end within a sample, on part of the picture, for the time asked for: where
    /// sampling is adaptive, and where whole samples take so long that ending after one would miss that time.
    bool may_end_within_sample(double samples, double seconds) const;
    /// What the end of a sample takes at least, in seconds, however much of the picture it goes to.
    void set_least_step(double seconds) { least_step_ = seconds; }
    /// Time to stop: within a sample if that is allowed, or else after the whole sample that is closest to
    /// the time asked for.
    bool time_is_up(double samples, double seconds) const;

    /// Until the error asked for is reached, at the pace so far; negative: none was, or not known yet.
    /// `trend`: the latest there is.
    double seconds_to_error(double samples, double seconds, const Trend& trend) const;
    /// Until the first goal is reached, at the pace so far; negative: not known yet. `trend`: the latest
    /// there is.
    double seconds_left(double samples, double seconds, const Trend& trend) const;

  private:
    RenderGoal goal_;
    double limit_, bins_;  ///< samples per pixel at most; bins of a pixel: every one gets as many samples
    Trend trend_;
    Stop stop_ = Stop::samples;
    double least_step_ = 0;
    double first_samples_ = 0;
    double round_began_samples_ = 0, round_began_seconds_ = 0;

    /// Seconds for one more sample per pixel: the pace of this round, or else of all.
    double pace(double samples, double seconds) const;
    /// The pace of all; 0: not known.
    double mean_pace(double samples, double seconds) const;
};

}  // namespace triad
