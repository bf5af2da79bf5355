#include "base/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/log.h"

namespace triad {
namespace {

std::string format(const char* pattern, auto... values) {
    char text[256];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

unsigned terminal_columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string relmse_text(double relmse) { return relmse < 0 ? "?" : format("%.2g", relmse); }

}  // namespace

ProgressStyle automatic_progress() {
    if (log_level() == 0) return ProgressStyle::none;
    return ::isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

double seconds_left(const ProgressState& state) {
    return state.done > 0 ? state.seconds * (1 - state.done) / state.done : -1;
}

std::string clock_time(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    const auto h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
    return h > 0 ? format("%lld:%02lld:%02lld", h, m, s) : format("%lld:%02lld", m, s);
}

std::string bar_text(const ProgressState& state, unsigned columns) {
    const double left = seconds_left(state);
    const std::string numbers =
        format(" %3.0f %%  %s left  %llu spp  relMSE ", std::floor(100 * state.done),
               left < 0 ? "?" : clock_time(left).c_str(), static_cast<unsigned long long>(state.spp)) +
        relmse_text(state.relmse);
    // Two brackets, and the last column stays free: some terminals wrap when it is written.
    const int room = std::clamp(static_cast<int>(columns) - static_cast<int>(numbers.size()) - 3, 0, 50);
    if (room < 4) return numbers.substr(1, columns > 1 ? columns - 1 : 1);
    const int full = static_cast<int>(room * std::clamp(state.done, 0.0, 1.0));
    return "[" + std::string(full, '#') + std::string(room - full, '.') + "]" + numbers;
}

std::string line_text(const ProgressState& state) {
    const double left = seconds_left(state);
    return format("%.0f %% after %s, %s left, %llu spp, relMSE ", std::floor(100 * state.done),
                  clock_time(state.seconds).c_str(), left < 0 ? "?" : clock_time(left).c_str(),
                  static_cast<unsigned long long>(state.spp)) +
           relmse_text(state.relmse);
}

std::string json_text(const ProgressState& state) {
    const double left = seconds_left(state);
    return format(
        "{\"progress\": %.6g, \"seconds\": %.3f, \"seconds_left\": %s, \"spp\": %llu, \"relmse\": %s}",
        state.done, state.seconds, left < 0 ? "null" : format("%.3f", left).c_str(),
        static_cast<unsigned long long>(state.spp),
        state.relmse < 0 ? "null" : format("%.6g", state.relmse).c_str());
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
