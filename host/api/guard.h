#pragma once
/// The border of the library: what is thrown behind it leaves it as api::Error.
#include <exception>
#include <mutex>

#include "base/program.h"
#include "triad/error.h"

namespace triad::api {

/// Triad's log, settings of kernels and numbers of threads are those of the process: one call at a time.
std::recursive_mutex& calls();

/// Does the work of a call. Recursive: a report may call, too.
template <class Work>
auto guarded(const Work& work) {
    const std::lock_guard lock(calls());
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::exception&) {
        const Failure failure = failure_at_hand();
        throw Error(failure.exit, failure.sentence);
    }
}

/// A function of the user's, called from within: what it throws ends the work, and is thrown when nothing of
/// Triad's is in between.
class Callback {
  public:
    /// What `call` returns, or false where it throws.
    template <class Call>
    bool operator()(const Call& call) {
        try {
            return call();
        } catch (...) {
            thrown_ = std::current_exception();
            return false;
        }
    }
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

  private:
    std::exception_ptr thrown_;
};

}  // namespace triad::api
