#pragma once
/// A program that outlives the libraries that it calls. While a Peril exists, a crash, an abort or an exit()
/// does not end the program but starts it again from its beginning, in the same process, and what the Peril
/// says is then among the earlier deaths. What it ran beside itself (RunningChild) ends with the old life.
/// Nothing is paid for this until it happens.
#include <string>
#include <vector>

namespace triad {

/// For the first lines of main(), before other threads. Without this call a Peril does nothing.
void allow_restarts(char** argv);
bool restarts_allowed();

/// For a program's own abort(), which libraries call, too: a new life if there is a Peril, else the end. The
/// signal alone is not enough: LLVM catches it after a Peril does, when it is loaded. What the C library
/// itself finds (a damaged heap, say) is signalled without this call.
[[noreturn]] void end_by_abort();

struct Death {
    std::string note;   ///< of the Peril
    std::string cause;  ///< a phrase: "signal 6 (Aborted)"
};
/// How earlier lives of this program ended, in their order.
const std::vector<Death>& earlier_deaths();

class Peril {
  public:
    /// Drivers catch SIGFPE of the kernels that they run, which is then no crash.
    enum class Of { calls, kernels };
    explicit Peril(const std::string& note, Of of = Of::calls);
    ~Peril();
    Peril(const Peril&) = delete;
    Peril& operator=(const Peril&) = delete;
    /// For what is as bad as a crash: starts again with this cause, or returns when that is not allowed.
    void die(const char* cause) const;

  private:
    struct Life* next_ = nullptr;
    Of of_;
};

}  // namespace triad
