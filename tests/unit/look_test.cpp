// Light and ground of Triad's own making.
#include "scene/look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "scene/framing.h"
#include "scene/shapes.h"

using namespace triad;

namespace {

/// Irradiance of what faces up, and mean radiance of the rows just below the horizon, green.
struct Light {
    double above = 0, below = 0;
};

Light light_of(const EnvironmentMap& map) {
    Light light;
    for (unsigned y = 0; y < map.height; ++y)
        for (unsigned x = 0; x < map.width; ++x) {
            const double theta = pi * (y + 0.5) / map.height, value = map.rgb[(y * map.width + x) * 3 + 1];
            if (y < map.height / 2)
                light.above +=
                    value * std::cos(theta) * std::sin(theta) * (2 * pi / map.width) * (pi / map.height);
            if (y == map.height / 2) light.below += value / map.width;
        }
    return light;
}

Scene ball() {
    Scene scene;
    scene.materials.push_back({});
    scene.meshes.push_back({"ball", {shapes::lat_long_sphere({3, 5, 7}, 2, 16, 8)}});
    scene.instances.push_back({"ball", 0});
    return scene;
}

}  // namespace

TEST(Look, white_paper_is_white_in_a_studio) {
    Scene scene;
    light(scene, Look::studio);
    ASSERT_TRUE(scene.environment);
    EXPECT_NEAR(light_of(*scene.environment).above, pi, 0.01 * pi);
    for (const float value : scene.environment->rgb) ASSERT_TRUE(value >= 0 && std::isfinite(value));
    Scene white;
    light(white, Look::white);
    EXPECT_EQ(white.sky, vec3(1.0f));
    EXPECT_FALSE(white.environment);
}

TEST(Look, the_ground_passes_into_what_lies_behind_it) {
    for (const Look look : {Look::studio, Look::sky}) {
        Scene scene;
        light(scene, look);
        const Light found = light_of(*scene.environment);
        EXPECT_NEAR(found.below, ground_albedo / pi * found.above, 0.03 * found.below) << name_of(look);
    }
}

TEST(Look, the_ground_lies_below_and_is_no_part_of_what_is_framed) {
    Scene scene = ball();
    const View before = frame(scene, 0.6, 1.5);
    stand_on_ground(scene);
    ASSERT_EQ(scene.instances.size(), 2u);
    const MeshInstance& ground = scene.instances.back();
    EXPECT_TRUE(ground.is_ground);
    const dvec3 middle = transform_point(ground.to_world, dvec3(0.0));
    EXPECT_LT(middle.y, 3.0);
    EXPECT_NEAR(middle.y, 3.0, 1e-2);
    const View after = frame(scene, 0.6, 1.5);
    EXPECT_EQ(before.eye, after.eye);
    EXPECT_EQ(validate(scene), 0u);
}

TEST(Look, a_view_from_above_is_steeper) {
    const Scene scene = ball();
    const View front = frame(scene, 0.6, 1.5, {0, 0, 1}), above = frame(scene, 0.6, 1.5, {0, 1, 0.5});
    EXPECT_NEAR(front.forward.y, 0, 1e-12);
    EXPECT_LT(above.forward.y, -0.8);
}

TEST(Look, names_are_names) {
    for (const Look look : {Look::studio, Look::sky, Look::white}) EXPECT_EQ(look_named(name_of(look)), look);
    EXPECT_THROW(look_named("night"), Error);
}
