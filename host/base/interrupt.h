#pragma once
/// Signals that ask a program to end: the first asks to stop after the pass at hand, the second ends the
/// process at once.
#include <csignal>
#include <vector>

namespace triad {

/// Catches Ctrl-C, SIGTERM, SIGHUP (a terminal that closes), SIGQUIT and SIGXCPU (a limit on processor time)
/// while it lives; those that were ignored before (nohup) stay so.
class InterruptGuard {
  public:
    /// `words`: what the first signal prints, a literal.
    explicit InterruptGuard(
        const char* words = "\ntriad: stopping after this pass and saving; once more to quit at once\n");
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// A signal came.
    bool interrupted() const;

  private:
    struct Caught {
        int signal;
        struct sigaction before;
    };
    std::vector<Caught> caught_;
};

}  // namespace triad
