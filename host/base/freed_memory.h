#pragma once

namespace triad {

/// From now on pieces of more than 1 MiB go back to the system as soon as they are freed. The C library else
/// comes to keep what is below the largest that was freed, up to 32 MiB. For a program, at its start.
void keep_no_large_pieces();

/// Hands to the system what was freed in small pieces, which the C library otherwise keeps. Takes
/// milliseconds for every 100 MB: for between large steps.
void give_back_freed_memory();

}  // namespace triad
