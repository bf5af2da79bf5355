#include "base/shell_limits.h"

#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>

#include "base/error.h"

namespace triad {
namespace {

/// What threads have on a machine without limits, and the least that drivers run kernels on.
constexpr std::size_t usual_stack = 8 << 20, least_stack = 256 << 10;

/// Fits in a fixed text, since it may be asked for before there is a heap.
struct Text {
    char characters[200] = "";
    std::size_t size = 0;

    void add(const char* pattern, auto... values) {
        const int written =
            std::snprintf(characters + size, sizeof characters - size, pattern, values...);  // bounded
        size = std::min(size + std::size_t(std::max(written, 0)), sizeof characters - 1);
    }
};

Text limits_in_force() {
    struct Limit {
        decltype(RLIMIT_AS) what;
        char letter;
        rlim_t unit, ordinary;  ///< beyond which nobody runs into it
    };
    Text text;
    for (const Limit& each : {Limit{RLIMIT_AS, 'v', 1024, rlim_t(1) << 36}, Limit{RLIMIT_NPROC, 'u', 1, 1000},
                              Limit{RLIMIT_STACK, 's', 1024, 1 << 20}}) {
        rlimit limit{};
        if (::getrlimit(each.what, &limit) != 0 || limit.rlim_cur >= each.ordinary) continue;
        text.add(text.size ? " -%c %llu" : "ulimit -%c %llu", each.letter,
                 static_cast<unsigned long long>(limit.rlim_cur / each.unit));
    }
    return text;
}

[[noreturn]] void end(const char* why) {
    Text text;
    text.add("triad: %s (%s). Raise the limit.\n", why, limits_in_force().characters);
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.characters, text.size);
    ::_exit(static_cast<int>(Exit::memory));
}

void end_at_start() { end("Triad's libraries cannot start within what the shell allows"); }

bool is_memory_limited() {
    rlimit memory{};
    return ::getrlimit(RLIMIT_AS, &memory) == 0 && memory.rlim_cur != RLIM_INFINITY;
}

std::terminate_handler ordinary_end = nullptr;
struct sigaction ordinary_fault {};

/// Initialisers cannot report what they lack.
void watch() {
    ordinary_end = std::set_terminate(end_at_start);
    if (!is_memory_limited()) return;
    // OpenImageIO's table of names is allocated by one, and used unchecked.
    struct sigaction action {};
    action.sa_handler = [](int) { end_at_start(); };
    ::sigaction(SIGSEGV, &action, &ordinary_fault);
}

void watch_no_more() {
    std::set_terminate(ordinary_end);
    if (is_memory_limited()) ::sigaction(SIGSEGV, &ordinary_fault, nullptr);
}

}  // namespace

std::string shell_limits() { return limits_in_force().characters; }

void heed_shell_limits() {
    watch();
    rlimit stack{};
    if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= usual_stack) return;
    // The main thread's grows up to what is allowed when it grows; those of others are set when they start.
    stack.rlim_cur = std::min<rlim_t>(stack.rlim_max, usual_stack);
    ::setrlimit(RLIMIT_STACK, &stack);
    if (stack.rlim_cur < least_stack) end("Triad and its drivers need stacks of 256 KB");
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, usual_stack);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
}

void libraries_have_started() { watch_no_more(); }

LibrariesStart::LibrariesStart() {
    if (is_memory_limited()) watch();
}
LibrariesStart::~LibrariesStart() {
    if (is_memory_limited()) watch_no_more();
}

}  // namespace triad
