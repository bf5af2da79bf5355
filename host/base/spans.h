#pragma once
/// What the host did and when, for who looks at a run. Nothing is kept unless it is asked for.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace triad {

struct HostSpan {
    std::string name;
    std::int64_t start = 0, end = 0;  ///< nanoseconds of the steady clock
    unsigned thread = 0;              ///< 0: of the first that had a span, 1: of the second, ...
};

/// Spans that begin from here on are kept.
void keep_spans();
/// Those that have ended, in the order in which they did.
std::vector<HostSpan> kept_spans();

/// Whoever shows how far the job is, is told of every phase of it when it begins; empty: nobody is.
void watch_phases(std::function<void(const char* phase)> watcher);

/// From here to the end of the block, under a name that must outlive it. `phase`: one of those that
/// `triad render` goes through (base/progress.h); none for what happens within one.
class Span {
  public:
    explicit Span(const char* name, const char* phase = nullptr);
    ~Span();
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

  private:
    const char* name_;
    std::int64_t start_;  ///< 0: not kept
};

}  // namespace triad
