// Shading normals that point elsewhere than the geometry must not lose light.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"

namespace triad::analytic {
namespace {

/// A flat square in the plane z = 0 whose normals all lean by `angle` radians towards +x.
Primitive leaning_square(double angle) {
    Primitive p = shapes::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    p.normals.assign(p.positions.size(), vec3(std::sin(angle), 0.0, std::cos(angle)));
    return p;
}

/// The square under a white sky, seen at `view` radians from its geometric normal, from the side of -x.
Measured seen_under_white_sky(const Material& material, double lean, double view) {
    Builder b;
    b.add(leaning_square(lean), material).sky(1.0f);
    return measure(b.scene, {.view = orthographic({0, 0, 0}, {std::sin(view), 0, -std::cos(view)}, 0.1, 3),
                             .size = 8,
                             .spp = 64});
}

TEST(ShadingNormal, a_mirror_is_not_black_where_its_normal_would_reflect_below_the_surface) {
    // A smooth white metal reflects the white sky wherever its mirror direction is above the surface.
    for (double lean : {0.3, 0.8, 1.2, 1.5})
        for (double view : {0.1, 0.6, 1.2, 1.5}) {
            Material metal;
            metal.roughness = 0.0f;
            const Measured m = seen_under_white_sky(metal, lean, view);
            EXPECT_EQ(m.not_finite, 0u);
            EXPECT_NEAR(m.mean, 1.0, 1e-4) << "lean " << lean << ", view " << view;
        }
}

TEST(ShadingNormal, clear_thin_glass_passes_or_reflects_all_light_whatever_its_normal) {
    for (double lean : {0.3, 0.8, 1.2, 1.5})
        for (double view : {0.1, 0.6, 1.2, 1.5}) {
            Material wall = glass(1.5f);
            wall.thickness = 0.0f;
            const Measured m = seen_under_white_sky(wall, lean, view);
            EXPECT_EQ(m.not_finite, 0u);
            EXPECT_GT(m.mean, 0.99) << "lean " << lean << ", view " << view;
            EXPECT_LT(m.mean, 1.01) << "lean " << lean << ", view " << view;
        }
}

}  // namespace
}  // namespace triad::analytic
