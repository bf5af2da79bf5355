#include "base/child_process.h"

#include "base/child.h"

namespace triad {

std::optional<int> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                               const std::filesystem::path& errors) {
    const auto end = run_child({.arguments = arguments, .output = output, .errors = errors});
    if (!end) return std::nullopt;
    return end->signal ? 128 + end->signal : end->exit;
}

}  // namespace triad
