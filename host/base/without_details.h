#pragma once
#include <algorithm>

#include "base/log.h"

namespace triad {

/// While it lives -v says no more than without: what is told of scenes is to be of the user's, not of those
/// by which a device is checked and tuned.
class WithoutDetails {
  public:
    WithoutDetails() { set_log_level(std::min(level_, 1)); }
    ~WithoutDetails() { set_log_level(level_); }
    WithoutDetails(const WithoutDetails&) = delete;
    WithoutDetails& operator=(const WithoutDetails&) = delete;

  private:
    const int level_ = log_level();
};

}  // namespace triad
