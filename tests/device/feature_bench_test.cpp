// The scenes that triad bench features compares.
#include <gtest/gtest.h>

#include "bench/feature_bench.h"
#include "bench/feature_scenes.h"
#include "device_fixture.h"
#include "render/renderer.h"

namespace triad {
namespace {

TEST(FeatureBench, scenes_differ_by_their_feature_alone) {
    for (const FeatureCase& c : feature_cases(8)) {
        const auto features = [&](const FeatureScene& s) {
            return Renderer(test_device(), s.scene, s.settings).features();
        };
        const Features without = features(c.without), with = features(c.with);
        for (const FeatureOption& f : feature_options()) {
            const bool differ = without.*f.member != with.*f.member;
            EXPECT_EQ(differ, f.member == c.feature.member) << c.feature.name << ": " << f.name;
        }
        EXPECT_TRUE(with.*c.feature.member) << c.feature.name;
    }
}

TEST(FeatureBench, unused_features_change_no_bit) {
    const auto costs = measure_features(test_device(), {.size = 16, .samples = 4, .repetitions = 1},
                                        [](const FeatureCost&) { return true; });
    EXPECT_EQ(costs.size(), feature_options().size() + 1);
    for (const FeatureCost& c : costs) EXPECT_TRUE(c.same_bits) << c.feature;
}

}  // namespace
}  // namespace triad
