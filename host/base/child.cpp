#include "base/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>

extern char** environ;

namespace triad {
namespace {

constexpr const char* parent_variable = "TRIAD_PARENT";

/// What kill() is to be told of those that run; 0: a free place. Of more than these the rest is not killed
/// before a new life.
std::array<std::atomic<pid_t>, 32> running{};
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler reads them");

std::atomic<bool> killed_for_new_life = false;

void replace_running(pid_t before, pid_t after) {
    for (std::atomic<pid_t>& place : running)
        if (pid_t expected = before; place.compare_exchange_strong(expected, after)) return;
}

/// `environ` with these changes, as "NAME=VALUE".
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view text = *entry;
        if (!changes.contains(std::string(text.substr(0, text.find('='))))) all.emplace_back(text);
    }
    for (const auto& [name, value] : changes)
        if (!value.empty()) all.push_back(name + "=" + value);
    return all;
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (const std::string& text : texts) list.push_back(const_cast<char*>(text.c_str()));
    list.push_back(nullptr);
    return list;
}

/// A group of its own can be killed whole.
bool has_own_group(const Child& child) { return child.own_group || child.seconds > 0; }

std::optional<pid_t> start(const Child& child) {
    const std::vector<std::string> environment = environment_with(child.environment);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, 1, child.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::posix_spawn_file_actions_addopen(&files, 2, child.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    if (has_own_group(child)) ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, child.arguments.front().c_str(), &files, &attributes,
                                     pointers(child.arguments).data(), pointers(environment).data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return error ? std::nullopt : std::optional(process);
}

}  // namespace

RunningChild::RunningChild(const Child& child) : process_(start(child)), has_group_(has_own_group(child)) {
    using Clock = std::chrono::steady_clock;
    latest_ = child.seconds > 0 ? Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                     std::chrono::duration<double>(child.seconds))
                                : Clock::time_point::max();
    if (!process_) return;
    end_.emplace();
    replace_running(0, target());
}

RunningChild::~RunningChild() {
    if (has_ended()) return;
    kill_group();
    wait();
}

pid_t RunningChild::target() const { return has_group_ ? -*process_ : *process_; }
void RunningChild::kill_group() { ::kill(target(), SIGKILL); }

bool RunningChild::has_ended() {
    if (!process_) return true;
    siginfo_t ended{};
    const int seen = ::waitid(P_PID, id_t(*process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (killed_for_new_life) return false;
    if (seen == 0 ? ended.si_pid == 0 : errno == EINTR) {
        if (!end_->late && std::chrono::steady_clock::now() >= latest_) end_->late = true, kill_group();
        return false;
    }
    // Once it has been waited for, its number may be another process's: kill_running_children() forgets it
    // before.
    replace_running(target(), 0);
    int status = 0;
    const pid_t done = ::waitpid(*process_, &status, 0);
    process_.reset();
    if (done < 0) end_.reset();
    if (done > 0 && WIFEXITED(status)) end_->exit = WEXITSTATUS(status);
    if (done > 0 && WIFSIGNALED(status)) end_->signal = WTERMSIG(status);
    return true;
}

std::optional<ChildEnd> RunningChild::wait() {
    for (auto pause = std::chrono::milliseconds(1); !has_ended();
         pause = std::min(pause * 2, std::chrono::milliseconds(20)))
        std::this_thread::sleep_for(pause);
    return end_;
}

void kill_running_children() {
    killed_for_new_life = true;
    for (const std::atomic<pid_t>& place : running)
        if (const pid_t target = place.load()) ::kill(target, SIGKILL);
}

void forget_kill() { killed_for_new_life = false; }

std::optional<ChildEnd> run_child(const Child& child) { return RunningChild(child).wait(); }

std::map<std::string, std::string> bound_to_this_process() {
    return {{parent_variable, std::to_string(::getpid())}};
}

void end_with_parent() {
    const char* parent = std::getenv(parent_variable);
    if (!parent) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(::getppid()) != parent) std::_Exit(1);  // it has ended before
}

}  // namespace triad
