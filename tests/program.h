#pragma once
/// The built program, run as a user runs it.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

struct Outcome {
    int exit = -1;       ///< -1: ended by a signal
    std::string output;  ///< both streams
};

/// `arguments` as a shell reads them; `before` is shell text in front of the command: a variable, a limit.
inline Outcome run_program(const std::string& program, const std::string& arguments,
                           const std::string& before = "") {
    Outcome outcome;
    FILE* pipe = ::popen((before + " '" + program + "' " + arguments + " 2>&1").c_str(), "r");
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        outcome.output.append(buffer.data(), n);
    const int status = ::pclose(pipe);
    outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

inline Outcome run_triad(const std::string& arguments, const std::string& before = "") {
    return run_program(TRIAD_PROGRAM, arguments, before);
}

/// What a file holds that it wrote.
inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
