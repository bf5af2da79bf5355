#pragma once
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

/// The built program in the background, whose standard error is read as it comes.
class Running {
  public:
    /// As of run_triad.
    explicit Running(const std::string& arguments, const std::string& before = "") {
        int ends[2];
        EXPECT_EQ(::pipe(ends), 0);
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(ends[1], 2);
            ::close(ends[0]), ::close(ends[1]);
            ::execl("/bin/sh", "sh", "-c", (before + " exec '" TRIAD_PROGRAM "' " + arguments).c_str(),
                    nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        errors_ = ::fdopen(ends[0], "r");
    }
    ~Running() { std::fclose(errors_); }

    /// Reads lines up to the first that holds `text`; false when the program ends before that.
    bool says(const std::string& text) {
        char line[4096];
        while (std::fgets(line, sizeof line, errors_)) {
            said_ += line;
            if (std::string(line).find(text) != std::string::npos) return true;
        }
        return false;
    }
    void interrupt() { send(SIGINT); }
    void send(int signal) { ::kill(child_, signal); }
    int wait() {
        int status = 0;
        ::waitpid(child_, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;  // -1: ended by a signal
    }
    /// Waits as well, and finds the bytes that the program held at most. Not by wait4(), which begins with
    /// what this process held when it forked.
    int wait(std::int64_t& most_memory) {
        const std::string status = "/proc/" + std::to_string(child_) + "/status";
        siginfo_t ended{};
        while (::waitid(P_PID, id_t(child_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0) {
            std::ifstream file(status);
            for (std::string line; std::getline(file, line);)
                if (line.starts_with("VmHWM:")) most_memory = std::stoll(line.substr(6)) * 1024;
            ::usleep(1000);
        }
        return wait();
    }
    const std::string& said() const { return said_; }

  private:
    pid_t child_ = 0;
    FILE* errors_ = nullptr;
    std::string said_;
};
