#include "base/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string_view>
#include <thread>

extern char** environ;

namespace triad {
namespace {

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

std::optional<pid_t> start(const Child& child) {
    const std::vector<std::string> environment = environment_with(child.environment);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, 1, child.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::posix_spawn_file_actions_addopen(&files, 2, child.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    // A group of its own can be killed whole, but a terminal's Ctrl-C does not reach it.
    if (child.seconds > 0) ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, child.arguments.front().c_str(), &files, &attributes,
                                     pointers(child.arguments).data(), pointers(environment).data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return error ? std::nullopt : std::optional(process);
}

}  // namespace

std::optional<ChildEnd> run_child(const Child& child) {
    using Clock = std::chrono::steady_clock;
    const std::optional<pid_t> process = start(child);
    if (!process) return std::nullopt;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(child.seconds));
    ChildEnd result;
    int status = 0;
    for (auto pause = std::chrono::milliseconds(1);;) {
        const pid_t done = ::waitpid(*process, &status, child.seconds > 0 ? WNOHANG : 0);
        if (done == *process) break;
        if (done < 0 && errno != EINTR) return std::nullopt;
        if (done == 0 && !result.late && Clock::now() >= end) {
            result.late = true;
            ::kill(-*process, SIGKILL);
        }
        if (done == 0) std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::milliseconds(20));
    }
    if (WIFEXITED(status)) result.exit = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

}  // namespace triad
