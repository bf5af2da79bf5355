#pragma once
/// How far a long job is, on standard error: a bar on a terminal, one line each 10 s elsewhere, JSON lines on
/// request.
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

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

/// "building trees" of "build", and so on; a phase that is not known is its own words.
const char* phase_words(const char* phase);
/// The line of JSON that says that a phase begins, without a line end.
std::string phase_json(const char* phase, double seconds);

class ProgressDisplay {
  public:
    explicit ProgressDisplay(ProgressStyle style);
    ~ProgressDisplay();  ///< clears the bar
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Cheap to call often: shows at most four bars a second, one JSON line a second, one line each 10 s.
    void update(const ProgressState& state);

    /// From now on phases are shown: on a terminal with a running clock, as a line after each 10 s of one, in
    /// JSON as each begins.
    void show_phases();

    /// The last JSON line: the exit code, and the sentence where it failed. The bar is cleared.
    void end(int exit, const std::string& error = "");

  private:
    using Clock = std::chrono::steady_clock;

    const ProgressStyle style_;
    const Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    bool bar_shown_ = false;
    Clock::time_point next_{};
    const char* phase_ = nullptr;  ///< that is shown, until an update says more
    Clock::time_point phase_start_{};
    std::condition_variable_any wake_;
    std::jthread clock_;  ///< last: it uses the others

    void begin_phase(const char* phase);
    void run_clock(const std::stop_token& stop);
    void show_phase();
    void draw_bar(const std::string& text);
    void clear_bar();
    double seconds() const;
};

}  // namespace triad
