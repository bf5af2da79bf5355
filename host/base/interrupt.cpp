#include "base/interrupt.h"

#include <unistd.h>

#include <csignal>

namespace triad {
namespace {

volatile std::sig_atomic_t signals = 0;

extern "C" void on_signal(int number) {
    if (signals) ::_exit(128 + number);  // what a shell expects of a process that a signal ended
    signals = 1;
    const char text[] = "\ntriad: stopping after this pass and saving; once more to quit at once\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof text - 1);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    signals = 0;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const { return signals != 0; }

}  // namespace triad
