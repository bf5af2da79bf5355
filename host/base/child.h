#pragma once
/// Another program, run and waited for, or beside this one.
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace triad {

struct Child {
    std::vector<std::string> arguments;              ///< the first is the program, found along PATH
    std::map<std::string, std::string> environment;  ///< what differs from this process; empty: not set
    std::filesystem::path output = "/dev/null", errors = "/dev/null";
    double seconds = 0;      ///< after so many it is killed, with all that it started; 0: no limit
    bool own_group = false;  ///< a terminal's Ctrl-C does not reach it; so with a limit, too
};

struct ChildEnd {
    int exit = 0;       ///< its exit status
    int signal = 0;     ///< that ended it; 0: none
    bool late = false;  ///< it was killed because its time was over
};

/// One that runs, without a shell and without input. It is killed when this goes; in a group of its own with
/// all that it started.
class RunningChild {
  public:
    explicit RunningChild(const Child& child);
    ~RunningChild();
    RunningChild(const RunningChild&) = delete;
    RunningChild& operator=(const RunningChild&) = delete;

    /// Whether it has ended, or there is no such program. Does not wait.
    bool has_ended();
    /// How it ended; nothing when there is no such program.
    std::optional<ChildEnd> wait();

  private:
    std::optional<pid_t> process_;  ///< that has not ended
    std::optional<ChildEnd> end_;
    bool has_group_ = false;
    std::chrono::steady_clock::time_point latest_;

    pid_t target() const;  ///< that kill() is told of: the group, where it has one
    void kill_group();
};

/// Ends those that run, for a signal handler before the process begins a new life, which knows of none. From
/// then on none is seen to have ended, until forget_kill().
void kill_running_children();
void forget_kill();  ///< there is no new life

/// Runs it and waits. Nothing when there is no such program.
std::optional<ChildEnd> run_child(const Child& child);

/// A program that ends when the one that started it does has this in its Child.environment, and calls
/// end_with_parent(), which does nothing in others.
std::map<std::string, std::string> bound_to_this_process();
void end_with_parent();

}  // namespace triad
