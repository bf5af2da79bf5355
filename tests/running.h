#pragma once
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
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
    int wait(rusage* usage = nullptr) {
        int status = 0;
        ::wait4(child_, &status, 0, usage);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;  // -1: ended by a signal
    }
    const std::string& said() const { return said_; }

  private:
    pid_t child_ = 0;
    FILE* errors_ = nullptr;
    std::string said_;
};
