// Distributions in integers: what may be picked, and what may not.
#include <gtest/gtest.h>

#include "pack/pack.h"

namespace triad {
namespace {

TEST(IntegerCdf, whatever_has_weight_can_be_picked) {
    const std::vector<std::uint32_t> cdf = integer_cdf(std::vector<double>{1e-30, 0.0, 1e9, 1e-30, 0.0});
    const std::vector<std::uint32_t> shares = {1, 0, 4294967293u, 1, 0};
    for (std::size_t i = 0; i < shares.size(); ++i) EXPECT_EQ(cdf[i + 1] - cdf[i], shares[i]) << i;
    EXPECT_EQ(cdf.front(), 0u);
    EXPECT_EQ(cdf.back(), 0xffffffffu);
}

TEST(IntegerCdf, shares_are_proportional) {
    const std::vector<std::uint32_t> cdf = integer_cdf(std::vector<double>{1, 2, 5});
    EXPECT_NEAR((cdf[1] - cdf[0]) / 4294967295.0, 0.125, 1e-9);
    EXPECT_NEAR((cdf[2] - cdf[1]) / 4294967295.0, 0.25, 1e-9);
    EXPECT_NEAR((cdf[3] - cdf[2]) / 4294967295.0, 0.625, 1e-9);
}

TEST(IntegerCdf, without_any_weight_all_intervals_but_the_last_are_empty) {
    EXPECT_EQ(integer_cdf(std::vector<double>{0, 0}), (std::vector<std::uint32_t>{0, 0, 0xffffffffu}));
}

}  // namespace
}  // namespace triad
