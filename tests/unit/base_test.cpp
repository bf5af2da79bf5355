// Built-in checks of base.
#include <gtest/gtest.h>

#include "base/hash.h"

TEST(Hash, separates_lengths) {
    EXPECT_NE(triad::Hash().add("ab").add("c").hex(), triad::Hash().add("a").add("bc").hex());
    EXPECT_EQ(triad::Hash().add("ab").hex().size(), 32u);
}
