#pragma once
#include <gtest/gtest.h>

#include <string>

#include "scene/film.h"

namespace triad {

inline void expect_same_bytes(const Film& a, const Film& b, const std::string& what) {
    EXPECT_EQ(a.sums, b.sums) << what;
    EXPECT_EQ(a.half_sums, b.half_sums) << what;
    EXPECT_EQ(a.samples, b.samples) << what;
    EXPECT_EQ(a.ranges, b.ranges) << what;
    EXPECT_EQ(a.counters, b.counters) << what;
}

}  // namespace triad
