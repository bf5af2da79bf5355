#include "base/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace triad {
namespace {

constexpr int asks_to_end[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};

/// Those that were ignored when the program began: drivers' compilers catch signals for themselves.
const std::vector<int> ignored = [] {
    std::vector<int> found;
    for (const int signal : asks_to_end) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN)
            found.push_back(signal);
    }
    return found;
}();

volatile std::sig_atomic_t signals = 0;
const char* volatile said_at_first = "";

extern "C" void on_signal(int number) {
    // A closing terminal may send its signal more than once, and an exceeded limit sends one every second.
    if (signals && number != SIGHUP && number != SIGXCPU)
        ::_exit(128 + number);  // what a shell expects of a process that a signal ended
    if (signals) return;
    signals = 1;
    const char* const text = said_at_first;
    const int error = errno;
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
    errno = error;
}

}  // namespace

InterruptGuard::InterruptGuard(const char* words) {
    signals = 0;
    said_at_first = words;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    for (const int signal : asks_to_end) {
        const bool stays = std::count(ignored.begin(), ignored.end(), signal) > 0;
        Caught caught{signal, {}};
        ::sigaction(signal, stays ? &ignore : &action, &caught.before);
        caught_.push_back(caught);
    }
}

InterruptGuard::~InterruptGuard() {
    for (const Caught& caught : caught_) ::sigaction(caught.signal, &caught.before, nullptr);
}

bool InterruptGuard::interrupted() const { return signals != 0; }

}  // namespace triad
