#pragma once
/// A limit on the memory that the process takes: what `new` gives out in large pieces, whoever asks for it
/// (counted_new.cpp, in programs alone), and what count_memory() tells of besides.
#include <cstdint>
#include <string>

namespace triad {

/// Of this machine, or of the control group that the process is in.
std::uint64_t available_memory();

/// From here on a large piece beyond so many bytes in all is a std::bad_alloc that says so; 0, at first: no
/// limit.
void set_memory_limit(std::uint64_t bytes);
std::uint64_t memory_limit();
/// In large pieces (64 KiB and more).
std::uint64_t memory_in_use();

/// Memory that comes from elsewhere (buffers of devices); less when negative.
void count_memory(std::int64_t bytes);
/// Before a large piece of work: throws Error(memory) that says how much `what` ("The film") needs, how much
/// there is, and what to do.
void require_memory(std::uint64_t bytes, const std::string& what);

}  // namespace triad
