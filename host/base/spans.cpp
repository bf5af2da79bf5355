#include "base/spans.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

namespace triad {
namespace {

std::atomic<bool> keeping = false;
std::mutex spans_mutex;
std::vector<HostSpan> kept;
std::mutex watcher_mutex;
std::function<void(const char*)> watcher;

std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

unsigned this_thread_number() {
    static std::atomic<unsigned> threads = 0;
    thread_local const unsigned number = threads++;
    return number;
}

}  // namespace

void keep_spans() { keeping = true; }

std::vector<HostSpan> kept_spans() {
    const std::lock_guard lock(spans_mutex);
    return kept;
}

void watch_phases(std::function<void(const char*)> told) {
    const std::lock_guard lock(watcher_mutex);
    watcher = std::move(told);
}

Span::Span(const char* name, const char* phase) : name_(name), start_(keeping ? now() : 0) {
    if (!phase) return;
    const std::lock_guard lock(watcher_mutex);
    if (watcher) watcher(phase);
}

Span::~Span() {
    if (start_ == 0) return;
    const std::int64_t end = now();
    const unsigned thread = this_thread_number();
    const std::lock_guard lock(spans_mutex);
    kept.push_back({name_, start_, end, thread});
}

}  // namespace triad
