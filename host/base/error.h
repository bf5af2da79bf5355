#pragma once
/// Errors: our fault is an assert, the world's fault is an exception, normal absence is std::optional.
#include <stdexcept>
#include <string>

namespace triad {

/// What the process ends with; the numbers are part of the command-line contract.
enum class Exit {
    done = 0,
    usage = 1,
    scene = 2,        ///< a scene or file is missing, malformed or cannot be written
    unsupported = 3,  ///< a feature that the scene requires is not supported
    memory = 4,
    device = 5,
    incomplete = 6,
    comparison = 7,
    interrupted = 75,  ///< stopped by a signal, with what was done saved
};

/// A sentence that says what went wrong, where, and what to do; main prints it and exits with `exit`.
class Error : public std::runtime_error {
  public:
    Error(Exit exit, const std::string& sentence) : std::runtime_error(sentence), exit_(exit) {}
    Exit exit() const { return exit_; }

  private:
    Exit exit_;
};

}  // namespace triad
