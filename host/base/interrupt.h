#pragma once
/// Ctrl-C and SIGTERM: the first asks to stop after the pass at hand, the second ends the process at once.

namespace triad {

/// Catches the two signals while it lives.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// A signal came.
    bool interrupted() const;
};

}  // namespace triad
