#pragma once
/// What every call of the library may throw.
#include <stdexcept>
#include <string>

#define TRIAD_API __attribute__((visibility("default")))

/// The names of the library are triad::Scene, triad::render() and so on. They lie in triad::api because Triad
/// itself, which is made with TRIAD_INSIDE, has a triad::Scene of its own.
namespace triad {
namespace api {}
#ifndef TRIAD_INSIDE
using namespace api;
#endif
}  // namespace triad

namespace triad::api {

/// A sentence that says what went wrong, where, and what to do: the one that the command line prints. It
/// names options as the command line does (--spp).
class TRIAD_API Error : public std::runtime_error {
  public:
    Error(int exit_code, const std::string& sentence) : std::runtime_error(sentence), exit_code_(exit_code) {}

    /// What `triad` would end with: 1 wrong use, 2 a scene or a file, 3 something that the scene requires is
    /// not supported, 4 memory, 5 a device or its driver, 6 incomplete, 7 pictures that cannot be compared,
    /// 70 a defect of Triad.
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_;
};

}  // namespace triad::api
