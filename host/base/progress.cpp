#include "base/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/log.h"
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

ProgressDisplay::~ProgressDisplay() {
    if (bar_shown_) std::fputs("\r\033[K", stderr);
}

void ProgressDisplay::update(const ProgressState& state) {
    if (style_ == ProgressStyle::none) return;
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    const auto pause = style_ == ProgressStyle::bar    ? 250ms
                       : style_ == ProgressStyle::json ? 1000ms
                                                       : 10000ms;
    if (next_ == std::chrono::steady_clock::time_point{} && style_ == ProgressStyle::lines) {
        next_ = now + pause;  // a job of a few seconds needs no line
        return;
    }
    if (now < next_) return;
    next_ = now + pause;
    switch (style_) {
        case ProgressStyle::bar:
            std::fprintf(stderr, "\r%s\033[K", bar_text(state, terminal_columns()).c_str());
            std::fflush(stderr);
            bar_shown_ = true;
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

}  // namespace triad
