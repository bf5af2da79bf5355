#pragma once
/// How far a long job is, on standard error: a bar on a terminal, one line each 10 s elsewhere, JSON lines on
/// request.
#include <chrono>
#include <optional>
#include <string>

namespace triad {

enum class ProgressStyle { none, bar, lines, json };

/// What a person gets: a bar when standard error is a terminal, else lines; none at log level 0.
ProgressStyle automatic_progress();
/// bar, lines, json, none; anything else is automatic.
ProgressStyle progress_style(const std::string& name);

/// How far a render is, or another job.
struct ProgressState {
    double done = 0;                        ///< of the whole, 0 to 1
    double seconds = 0;                     ///< since the work began
    double seconds_left = -1;               ///< until the end; negative: not known yet
    double spp = 0;                         ///< samples per pixel so far
    double relmse = -1;                     ///< current estimate; negative: not known yet
    std::optional<double> trend;            ///< relMSE falls as spp^trend
    double wanted_relmse = 0;               ///< 0: no error was asked for
    double seconds_to_error = -1;           ///< until it is reached; negative: not known yet
    std::optional<double> perceived_noise;  ///< on the panel that the picture is for; none: not known
    std::string doing;  ///< of a job that is no render: what is said instead of samples and error
};

/// "0.0021 ~ spp^-1.02", or less while less is known.
std::string relmse_text(double relmse, const std::optional<double>& trend);
/// "64", or "62.3" where it is no whole number.
std::string spp_text(double spp);
/// "1:02:03" or "2:03", rounded up.
std::string clock_time(double seconds);
/// One line of each style, without a line end. `columns` is the width of the terminal.
std::string bar_text(const ProgressState& state, unsigned columns);
std::string line_text(const ProgressState& state);
std::string json_text(const ProgressState& state);

class ProgressDisplay {
  public:
    explicit ProgressDisplay(ProgressStyle style) : style_(style) {}
    ~ProgressDisplay();  ///< clears the bar
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Cheap to call often: shows at most four bars a second, one JSON line a second, one line each 10 s.
    void update(const ProgressState& state);

  private:
    ProgressStyle style_;
    bool bar_shown_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace triad
