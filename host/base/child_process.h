#pragma once
/// Programs of others, run and waited for.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace triad {

/// Runs `arguments[0]`, found along PATH, without a shell and without input, and waits; what it prints goes
/// to the two files. Its exit status (128 + signal when a signal ended it), or nothing when there is no such
/// program.
std::optional<int> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                               const std::filesystem::path& errors);

}  // namespace triad
