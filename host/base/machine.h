#pragma once
/// The machine that the program runs on.
#include <cstdint>
#include <string>

namespace triad {

struct Machine {
    std::string system, architecture, processor;  ///< "Linux 6.1.0", "x86_64", "AMD EPYC" or "unknown"
    unsigned cores = 0;
    std::uint64_t memory_bytes = 0;
};

Machine this_machine();

/// "AMD EPYC, 2 cores, 24.9 GB, Linux 6.1.0 (x86_64)".
std::string machine_words();

}  // namespace triad
