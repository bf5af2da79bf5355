#pragma once
/// The words of `triad bench error`: scenes and settings are options of `triad render`, read by its own
/// parser.
#include <string>
#include <vector>

#include "cli/render_options.h"

namespace triad {

/// Words as a shell reads them: quotes, single or double, keep blanks and go. (CLI11's own function for that
/// keeps the quotes since 2.4.)
std::vector<std::string> words(const std::string& text);

/// A scene or a setting: a name and what is added to `triad render`.
struct NamedOptions {
    std::string name;
    std::vector<std::string> arguments;
    /// The arguments as one line, quoted where a shell would need it.
    std::string text() const;
};

/// "FILE", "NAME: FILE OPTIONS" or "NAME: OPTIONS" (the built-in scene); the name of a file is its stem.
NamedOptions parse_scene(const std::string& text);

/// The arguments of all these scenes together: some name files that are read.
std::vector<std::string> arguments_of(const std::vector<std::string>& scenes);

/// "NAME: OPTIONS", or options alone, which are then the name too. Throws Error(usage) for an empty name.
NamedOptions parse_setting(const std::string& text);

/// "roulette=0.5,1": every setting with --roulette 0.5, and every one with --roulette 1. A single nameless
/// setting takes its name from the value. Throws Error(usage).
std::vector<NamedOptions> compare(const std::vector<NamedOptions>& settings, const std::string& text);

/// Options of `common`, then of the scene, then of the setting; the last one of a kind counts. Throws
/// Error(usage) that names the two for a slip, and for options that have no meaning here: those of budgets,
/// seeds and outputs.
RenderRequest render_options(const std::vector<std::string>& common, const NamedOptions& scene,
                             const NamedOptions& setting);

}  // namespace triad
