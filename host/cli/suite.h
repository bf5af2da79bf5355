#pragma once
/// The default suite: ten documented scenes with fixed settings, and what they scored when it was published
/// (docs/bench.md).
#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/experiment.h"

namespace triad {

/// Samples per pixel of the last budget, and of the references.
constexpr unsigned suite_spp = 64;
constexpr unsigned suite_reference_spp = 1024;

/// The folder that holds suite/ and cornell/: beside the installed program (../share/triad/scenes), or the
/// source's of a program in its build folder. Throws Error(scene) that names the places when there is none.
std::filesystem::path scenes_folder();

/// `triad bench` without a further word.
void add_bench_suite(CLI::App& bench, Exit& exit);

/// The scenes with their options, files below `folder`.
std::vector<NamedOptions> suite_scenes(const std::filesystem::path& folder);

/// What 100 points are: 1 / (relMSE x seconds) of every scene, measured when the suite was published.
const std::map<std::string, double>& suite_baselines();

}  // namespace triad
