#include "base/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace triad {
namespace {
std::atomic<unsigned> limit{0};
}

void set_host_threads(unsigned threads) { limit = threads; }

unsigned host_threads() { return limit ? limit.load() : std::max(1u, std::thread::hardware_concurrency()); }

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t chunks = (count + grain - 1) / grain;
    const std::size_t workers = std::min<std::size_t>(host_threads(), chunks);
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    auto work = [&] {
        for (std::size_t c; (c = next++) < chunks;) {
            try {
                body(c * grain, std::min(count, (c + 1) * grain));
            } catch (...) {
                std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
                next = chunks;
            }
        }
    };
    std::vector<std::jthread> threads;
    try {
        for (std::size_t i = 1; i < workers; ++i) threads.emplace_back(work);
    } catch (const std::system_error&) {  // a limit of the shell: fewer threads do all the same
    }
    work();
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace triad
