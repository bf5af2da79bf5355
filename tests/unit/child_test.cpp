// Programs that run beside this one.
#include "base/child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "base/restart.h"
#include "unit/temporary_folder.h"

using namespace triad;

namespace {

Child shell(const std::string& script) { return {.arguments = {"sh", "-c", script}}; }

/// The number in a file that another process writes.
pid_t number_in(const std::filesystem::path& path) {
    for (int i = 0; i < 500; ++i) {
        std::ifstream file(path);
        std::string line;
        if (std::getline(file, line) && !file.eof()) return pid_t(std::stoi(line));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return 0;
}

bool ends_soon(pid_t process) {
    for (int i = 0; i < 500; ++i) {
        if (::kill(process, 0) != 0) return true;
        std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
        std::string text;
        std::getline(stat, text);
        if (text.find(") Z ") != std::string::npos)
            return true;  // whoever adopted it has not waited for it yet
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace

TEST(Child, says_how_it_ended) {
    EXPECT_EQ(run_child(shell("exit 3"))->exit, 3);
    EXPECT_EQ(run_child(shell("kill -TERM $$"))->signal, SIGTERM);
    EXPECT_FALSE(run_child({.arguments = {"no-such-program-here"}}));
    RunningChild none({.arguments = {"no-such-program-here"}});
    EXPECT_TRUE(none.has_ended());
    EXPECT_FALSE(none.wait());
}

TEST(Child, is_killed_with_all_that_it_started_after_its_seconds) {
    const TemporaryFolder folder;
    Child slow = shell("sleep 100 & echo $! > " + (folder / "pid").string() + "; wait");
    slow.seconds = 5;
    const std::optional<ChildEnd> end = run_child(slow);
    ASSERT_TRUE(end);
    EXPECT_TRUE(end->late);
    EXPECT_EQ(end->signal, SIGKILL);
    const pid_t process = number_in(folder / "pid");
    ASSERT_GT(process, 0);
    EXPECT_TRUE(ends_soon(process));
}

TEST(Child, runs_beside_and_is_killed_with_all_that_it_started_when_it_is_not_waited_for) {
    const TemporaryFolder folder;
    pid_t process = 0;
    {
        Child slow = shell("sleep 100 & echo $! > " + (folder / "pid").string() + "; wait");
        slow.own_group = true;
        RunningChild running(slow);
        process = number_in(folder / "pid");
        ASSERT_GT(process, 0);
        EXPECT_FALSE(running.has_ended());
    }
    EXPECT_TRUE(ends_soon(process));
    RunningChild quick(shell("exit 4"));
    EXPECT_EQ(quick.wait()->exit, 4);
    EXPECT_TRUE(quick.has_ended());
    EXPECT_EQ(quick.wait()->exit, 4) << "asked once more";
}

/// Run by the next test, as a program of its own that starts again.
TEST(Child, DISABLED_of_a_life_that_ends) {
    const char* pid_file = std::getenv("TRIAD_TEST_PID_FILE");
    if (!pid_file) GTEST_SKIP() << "the next test runs it";
    static std::string program = "/proc/self/exe",
                       filter = "--gtest_filter=Child.DISABLED_of_a_life_that_ends",
                       disabled = "--gtest_also_run_disabled_tests";
    static char* arguments[] = {program.data(), filter.data(), disabled.data(), nullptr};
    allow_restarts(arguments);
    if (!earlier_deaths().empty()) return;
    Child slow = shell("echo $$ > " + std::string(pid_file) + "; exec sleep 100");
    slow.own_group = true;
    const RunningChild running(slow);
    ASSERT_GT(number_in(pid_file), 0);
    const Peril peril("ends");
    ::raise(SIGSEGV);
}

TEST(Child, ends_with_the_life_that_started_it) {
    const TemporaryFolder folder;
    Child again{.arguments = {"/proc/self/exe", "--gtest_filter=Child.DISABLED_of_a_life_that_ends",
                              "--gtest_also_run_disabled_tests"},
                .environment = {{"TRIAD_TEST_PID_FILE", (folder / "pid").string()}},
                .seconds = 60};
    for (const char* name : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX", "GTEST_OUTPUT", "GTEST_REPEAT"})
        again.environment[name] = "";  // of the tests that this one is among
    const std::optional<ChildEnd> end = run_child(again);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit, 0) << "signal " << end->signal;
    const pid_t process = number_in(folder / "pid");
    ASSERT_GT(process, 0);
    EXPECT_TRUE(ends_soon(process));
}
