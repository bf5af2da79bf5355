#pragma once
/// Completions of shells, made of what CLI11 was told of the programs.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace triad {

using Programs = std::vector<const CLI::App*>;

std::string bash_completion(const Programs& programs);
std::string zsh_completion(const Programs& programs);
std::string fish_completion(const Programs& programs);

/// A name for a function of it: "_triad_bench_error".
std::string function_of(const CLI::App& command);

/// The description up to its first point, bracket or colon: a menu has no room for more.
std::string short_description(const std::string& description);

/// What stands there without a name: words that it may be, and whether it may be a file.
struct Standing {
    std::vector<std::string> words;
    std::string name;
    bool is_file = false;
};
Standing standing_of(const CLI::App& command);

}  // namespace triad
