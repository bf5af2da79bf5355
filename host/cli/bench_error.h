#pragma once
/// triad bench error: scenes x settings x budgets x repetitions against a reference (docs/bench.md).
#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace triad {

struct BenchErrorOptions {
    std::vector<std::string> scenes;    ///< as parse_scene() reads them; none: the built-in scene
    std::vector<std::string> settings;  ///< as parse_setting() reads them; none: "default"
    std::vector<std::string> compare;   ///< as compare() reads them
    std::string common;                 ///< options of triad render for every run
    std::string size = "256x256";
    std::uint64_t spp = 64;
    double time = 0;
    unsigned repetitions = 5;
    std::uint32_t seed = 1;
    std::uint64_t reference_spp = 0;  ///< 0: enough for --spp
    bool own_references = false;
    std::string against;
    bool fail_if_worse = false;
    std::string folder, csv, json, kernels;
    std::string progress = "auto";
    std::string title = "Error against time";  ///< of the report
    std::map<std::string, double>
        baselines;  ///< by scene; with them settings are scored (bench/error_score.h)
};

/// Declares what every error bench understands: settings, repetitions, outputs. `options` must outlive the
/// parsing.
void declare(CLI::App& command, BenchErrorOptions& options);

/// Runs, prints the table and writes what was asked for. Throws Error(comparison) after all that when a
/// picture is wrong.
Exit run_bench_error(const BenchErrorOptions& options);

/// `triad bench error`.
void add_bench_error(CLI::App& bench, Exit& exit);

}  // namespace triad
