// The thin lens: what is out of focus is blurred by a disc, and what is in focus is sharp.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"

namespace triad::analytic {
namespace {

/// The picture's mean around the point `x` of the plane z = 0, which is 4 away and bright where its own x is
/// negative.
Measured edge_seen_at(double x, double lens_radius, double focus_distance) {
    Builder b;
    b.add(shapes::quad({-10, -10, 0}, {10, 0, 0}, {0, 20, 0}), emitter(1.0f));
    View view = look_at({x, 0, 4}, {x, 0, 0}, 1e-4, 1.0);
    view.lens_radius = lens_radius;
    view.focus_distance = focus_distance;
    return measure(b.scene, {.view = view, .size = 8, .spp = 256, .max_depth = 1});
}

/// Share of a disc of radius c around x that is on the negative side of the edge.
double share(double x, double c) {
    const double t = -x / c;
    return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi;
}

TEST(Lens, an_edge_out_of_focus_is_blurred_by_the_disc_of_confusion) {
    for (const double x : {-0.06, -0.01, 0.0, 0.03})
        for (const double focus : {2.0, 8.0}) {
            const double c = 0.1 * std::abs(1 - 4 / focus);
            if (std::abs(x) < c)
                expect_closed_form("x " + std::to_string(x) + ", focus " + std::to_string(focus),
                                   edge_seen_at(x, 0.1, focus), share(x, c), 1e-3);
        }
}

TEST(Lens, an_edge_in_focus_is_sharp) {
    EXPECT_NEAR(edge_seen_at(-0.001, 0.1, 4).mean, 1, 1e-6);
    EXPECT_NEAR(edge_seen_at(0.001, 0.1, 4).mean, 0, 1e-6);
    EXPECT_NEAR(edge_seen_at(-0.001, 0, 2).mean, 1, 1e-6) << "without a lens all is sharp";
}

}  // namespace
}  // namespace triad::analytic
