#pragma once
/// Counted work as the text that a capture carries.
#include <string>

#include "trace/work_counter.h"

namespace triad {

/// JSON; visits by pixel are not in it.
std::string text_of(const WorkCounts& counts);

/// Throws Error(scene) for what text_of() did not write.
WorkCounts work_counts_of(const std::string& text);

}  // namespace triad
