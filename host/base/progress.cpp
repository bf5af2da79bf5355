#include "base/progress.h"

#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/log.h"
#include "base/spans.h"
#include "base/text.h"

namespace triad {
namespace {

unsigned terminal_columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string left_text(double seconds) { return seconds < 0 ? "?" : clock_time(seconds); }

/// What is said of samples and error, and when the one that was asked for will be reached.
std::string picture_text(const ProgressState& state, const char* between) {
    if (!state.doing.empty()) return state.doing;
    std::string text =
        spp_text(state.spp) + " spp" + between + "relMSE " + relmse_text(state.relmse, state.trend);
    if (state.perceived_noise) text += format(", perceived noise %.2g", *state.perceived_noise);
    if (state.wanted_relmse > 0)
        text += format(", %.2g in ", state.wanted_relmse) + left_text(state.seconds_to_error);
    return text;
}

/// A thread takes address space, of which a process with a limit has none to spare for this.
bool has_room_for_a_clock() {
    rlimit space{};
    return ::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur == RLIM_INFINITY;
}

std::string json_number(double value, const char* pattern) {
    return value < 0 ? "null" : format(pattern, value);
}

}  // namespace

ProgressStyle automatic_progress() {
    if (log_level() == 0) return ProgressStyle::none;
    return ::isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

ProgressStyle progress_style(const std::string& name) {
    if (name == "bar") return ProgressStyle::bar;
    if (name == "lines") return ProgressStyle::lines;
    if (name == "json") return ProgressStyle::json;
    if (name == "none") return ProgressStyle::none;
    return automatic_progress();
}

std::string relmse_text(double relmse, const std::optional<double>& trend) {
    if (relmse < 0) return "?";
    return format("%.2g", relmse) + (trend ? format(" ~ spp^%.2f", *trend) : "");
}

std::string spp_text(double spp) { return format(spp == std::floor(spp) ? "%.0f" : "%.1f", spp); }

std::string clock_time(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    const auto h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
    return h > 0 ? format("%lld:%02lld:%02lld", h, m, s) : format("%lld:%02lld", m, s);
}

std::string bar_text(const ProgressState& state, unsigned columns) {
    const std::string numbers =
        format(" %3.0f %%  %s left  ", std::floor(100 * state.done), left_text(state.seconds_left).c_str()) +
        picture_text(state, "  ");
    // Two brackets, and the last column stays free: some terminals wrap when it is written.
    const int room = std::clamp(static_cast<int>(columns) - static_cast<int>(numbers.size()) - 3, 0, 50);
    if (room < 4) return numbers.substr(1, columns > 1 ? columns - 1 : 1);
    const int full = static_cast<int>(room * std::clamp(state.done, 0.0, 1.0));
    return "[" + std::string(full, '#') + std::string(room - full, '.') + "]" + numbers;
}

std::string line_text(const ProgressState& state) {
    return format("%.0f %% after %s, %s left, ", std::floor(100 * state.done),
                  clock_time(state.seconds).c_str(), left_text(state.seconds_left).c_str()) +
           picture_text(state, ", ");
}

std::string json_text(const ProgressState& state) {
    const std::string begin =
        format("{\"progress\": %.6g, \"seconds\": %.3f, \"seconds_left\": ", state.done, state.seconds) +
        json_number(state.seconds_left, "%.3f");
    if (!state.doing.empty()) return begin + ", \"doing\": \"" + state.doing + "\"}";
    return begin + format(", \"spp\": %.9g, \"relmse\": ", state.spp) + json_number(state.relmse, "%.6g") +
           ", \"trend\": " + (state.trend ? format("%.4g", *state.trend) : "null") +
           ", \"seconds_to_error\": " + json_number(state.seconds_to_error, "%.3f") +
           ", \"perceived_noise\": " +
           (state.perceived_noise ? format("%.4g", *state.perceived_noise) : "null") + "}";
}

const char* phase_words(const char* phase) {
    static constexpr struct {
        const char *phase, *words;
    } all[] = {{"load", "loading the scene"}, {"device", "opening the device"},
               {"build", "building trees"},   {"compile", "compiling kernels"},
               {"render", "rendering"},       {"write", "writing"}};
    for (const auto& each : all)
        if (std::strcmp(each.phase, phase) == 0) return each.words;
    return phase;
}

std::string phase_json(const char* phase, double seconds) {
    return format("{\"phase\": \"%s\", \"seconds\": %.3f}", phase, seconds);
}

ProgressDisplay::ProgressDisplay(ProgressStyle style) : style_(style) {
    if (style_ != ProgressStyle::bar) return;
    before_each_line([this] {
        const std::lock_guard lock(mutex_);
        clear_bar();
    });
}

ProgressDisplay::~ProgressDisplay() {
    watch_phases(nullptr);
    if (style_ == ProgressStyle::bar) before_each_line(nullptr);
    if (clock_.joinable()) clock_.request_stop(), clock_.join();
    clear_bar();
}

void ProgressDisplay::update(const ProgressState& state) {
    if (style_ == ProgressStyle::none) return;
    using namespace std::chrono_literals;
    const std::lock_guard lock(mutex_);
    phase_ = nullptr;
    const auto now = Clock::now();
    const auto pause = style_ == ProgressStyle::bar    ? 250ms
                       : style_ == ProgressStyle::json ? 1000ms
                                                       : 10000ms;
    if (next_ == Clock::time_point{} && style_ == ProgressStyle::lines) {
        next_ = now + pause;  // a job of a few seconds needs no line
        return;
    }
    if (now < next_) return;
    next_ = now + pause;
    switch (style_) {
        case ProgressStyle::bar:
            draw_bar(bar_text(state, terminal_columns()));
            break;
        case ProgressStyle::lines:
            std::fprintf(stderr, "%s\n", line_text(state).c_str());
            break;
        case ProgressStyle::json:
            std::fprintf(stderr, "%s\n", json_text(state).c_str());
            break;
        case ProgressStyle::none:
            break;
    }
}

void ProgressDisplay::show_phases() {
    if (style_ == ProgressStyle::none) return;
    watch_phases([this](const char* phase) { begin_phase(phase); });
    if (style_ == ProgressStyle::json || !has_room_for_a_clock()) return;
    try {
        clock_ = std::jthread([this](const std::stop_token& s) { run_clock(s); });
    } catch (const std::system_error&) {
        // a limit on threads: phases are not shown
    }
}

void ProgressDisplay::begin_phase(const char* phase) {
    const std::lock_guard lock(mutex_);
    if (style_ == ProgressStyle::json) {
        std::fprintf(stderr, "%s\n", phase_json(phase, seconds()).c_str());
        return;
    }
    phase_ = phase, phase_start_ = Clock::now();
}

void ProgressDisplay::run_clock(const std::stop_token& stop) {
    using namespace std::chrono_literals;
    const auto pause = style_ == ProgressStyle::bar ? 250ms : 10000ms;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); }) &&
           !stop.stop_requested())
        if (phase_ && Clock::now() - phase_start_ >= pause) show_phase();
}

void ProgressDisplay::show_phase() {
    const double so_far = std::chrono::duration<double>(Clock::now() - phase_start_).count();
    const std::string text = std::string(phase_words(phase_)) + ", " + clock_time(std::floor(so_far));
    if (style_ == ProgressStyle::bar) return draw_bar(text);
    std::fprintf(stderr, "%s so far\n", text.c_str());
}

void ProgressDisplay::end(int exit, const std::string& error) {
    const std::lock_guard lock(mutex_);
    phase_ = nullptr;
    clear_bar();
    if (style_ != ProgressStyle::json) return;
    std::string text = format("{\"phase\": \"end\", \"seconds\": %.3f, \"exit\": %d", seconds(), exit);
    if (!error.empty())
        text += ", \"error\": " +
                nlohmann::json(error).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::fprintf(stderr, "%s}\n", text.c_str());
}

void ProgressDisplay::draw_bar(const std::string& text) {
    std::fprintf(stderr, "\r%s\033[K", text.c_str());
    std::fflush(stderr);
    bar_shown_ = true;
}

void ProgressDisplay::clear_bar() {
    if (bar_shown_) std::fputs("\r\033[K", stderr);
    bar_shown_ = false;
}

double ProgressDisplay::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace triad
