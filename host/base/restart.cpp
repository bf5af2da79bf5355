#include "base/restart.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>

#include "base/child.h"

extern char** environ;

namespace triad {

/// What a next life starts with, complete before anything goes wrong: a signal handler cannot allocate.
struct Life {
    std::string deaths;  ///< "TRIAD_DEATHS=...", ends with room for the cause
    char* cause = nullptr;
    std::vector<std::string> others;
    std::vector<char*> environment;
};

namespace {

constexpr const char* variable = "TRIAD_DEATHS";
constexpr char field = '\x1f', record = '\x1e';
constexpr std::size_t cause_room = 80;
constexpr std::size_t most_deaths = 6;  // of whatever kind: a program that dies on and on must end

char** arguments = nullptr;
unsigned first_own_file = 3;
sigset_t first_mask;
std::vector<Death>& deaths() {
    static std::vector<Death> list;
    return list;
}

std::atomic<Life*> next_life = nullptr;  // of the newest Peril
std::atomic<bool> leaving = false;
std::mutex lives_mutex;
std::vector<Life*>& lives() {
    static auto* list = new std::vector<Life*>;  // never destroyed: exit() may come from a driver's thread
    return *list;
}

/// Only what POSIX allows in a signal handler. Returns when there is no next life or it cannot be had.
void start_again(const char* cause) {
    Life* next = next_life.load();
    if (!next) return;
    if (leaving.exchange(true))  // two threads die at once: the first takes both along
        for (;;) ::pause();
    std::size_t n = 0;
    for (; cause[n] && n + 1 < cause_room; ++n) next->cause[n] = cause[n];
    next->cause[n] = '\0';
    kill_running_children();
    ::pthread_sigmask(SIG_SETMASK, &first_mask, nullptr);
    ::syscall(SYS_close_range, first_own_file, ~0u, 4u /* CLOSE_RANGE_CLOEXEC */);  // a driver's own files
    ::execve("/proc/self/exe", arguments, next->environment.data());
    forget_kill();
    leaving = false;
}

extern "C" void die_of_signal(int signal) {
    char cause[] = "signal 00";
    cause[7] = static_cast<char>('0' + signal / 10 % 10);
    cause[8] = static_cast<char>('0' + signal % 10);
    start_again(cause);
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

/// Catches some signals while it is wanted by anyone.
struct Catch {
    std::vector<int> signals;
    int wanted = 0;
    std::array<struct sigaction, 32> before{};

    void want() {
        if (wanted++ > 0) return;
        struct sigaction action {};
        action.sa_handler = die_of_signal;
        action.sa_flags = SA_ONSTACK;
        for (const int each : signals) ::sigaction(each, &action, &before[static_cast<std::size_t>(each)]);
    }
    void leave() {
        if (--wanted > 0) return;
        for (const int each : signals) ::sigaction(each, &before[static_cast<std::size_t>(each)], nullptr);
    }
};
Catch& crashes() {
    static auto* one = new Catch{{SIGABRT, SIGSEGV, SIGBUS, SIGILL}};
    return *one;
}
Catch& divisions() {
    static auto* one = new Catch{{SIGFPE}};
    return *one;
}

/// The words for a cause: "signal 06" becomes "signal 6 (Aborted)".
std::string words(const std::string& cause) {
    if (!cause.starts_with("signal ")) return cause;
    const int number = std::atoi(cause.c_str() + 7);
    return "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
}

void read_deaths() {
    const char* text = std::getenv(variable);
    for (std::string_view rest = text ? text : ""; !rest.empty();) {
        const std::string one(rest.substr(0, rest.find(record)));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        const std::size_t split = one.find(field);
        if (split != std::string::npos)
            deaths().push_back({one.substr(0, split), words(one.substr(split + 1))});
    }
    ::unsetenv(variable);
}

std::unique_ptr<Life> life_after(const std::string& note) {
    auto life = std::make_unique<Life>();
    life->deaths = std::string(variable) + "=";
    for (const Death& death : deaths()) life->deaths += death.note + field + death.cause + record;
    life->deaths += note + field;
    const std::size_t cause = life->deaths.size();
    life->deaths.resize(cause + cause_room, '\0');
    life->cause = life->deaths.data() + cause;
    for (char** entry = environ; *entry; ++entry) life->others.emplace_back(*entry);
    for (std::string& entry : life->others) life->environment.push_back(entry.data());
    life->environment.push_back(life->deaths.data());
    life->environment.push_back(nullptr);
    return life;
}

}  // namespace

void allow_restarts(char** argv) {
    arguments = argv;
    read_deaths();
    ::sigemptyset(&first_mask);
    ::pthread_sigmask(SIG_SETMASK, nullptr, &first_mask);
    for (unsigned file = 3; file < 256; ++file)  // those that the caller handed down stay open
        if (::fcntl(static_cast<int>(file), F_GETFD) >= 0) first_own_file = file + 1;
    alignas(16) static char stack[1 << 16];  // for a stack that overflows
    const stack_t other{.ss_sp = stack, .ss_flags = 0, .ss_size = sizeof stack};
    ::sigaltstack(&other, nullptr);
    std::atexit([] { start_again("an exit of its own"); });
}

bool restarts_allowed() { return arguments != nullptr; }

void end_by_abort() {
    start_again("signal 06");
    ::raise(SIGABRT);
    ::signal(SIGABRT, SIG_DFL);
    ::raise(SIGABRT);
    ::_exit(128 + SIGABRT);
}

const std::vector<Death>& earlier_deaths() { return deaths(); }

Peril::Peril(const std::string& note, Of of) : of_(of) {
    if (!arguments || deaths().size() >= most_deaths) return;
    next_ = life_after(note).release();
    const std::lock_guard lock(lives_mutex);
    lives().push_back(next_);
    next_life = next_;
    crashes().want();
    if (of_ == Of::calls) divisions().want();
}

Peril::~Peril() {
    if (!next_) return;
    const std::lock_guard lock(lives_mutex);
    if (of_ == Of::calls) divisions().leave();
    crashes().leave();
    std::erase(lives(), next_);
    next_life = lives().empty() ? nullptr : lives().back();
    delete next_;
}

void Peril::die(const char* cause) const {
    if (next_) start_again(cause);
}

}  // namespace triad
