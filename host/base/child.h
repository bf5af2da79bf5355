#pragma once
/// Another program, run and waited for.
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
    double seconds = 0;  ///< after so many it is killed, with all that it started; 0: no limit
};

struct ChildEnd {
    int exit = 0;       ///< its exit status
    int signal = 0;     ///< that ended it; 0: none
    bool late = false;  ///< it was killed because its time was over
};

/// Runs it without a shell and without input, and waits. Nothing when there is no such program.
std::optional<ChildEnd> run_child(const Child& child);

}  // namespace triad
