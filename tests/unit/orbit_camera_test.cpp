// A camera that is led around: by angles, shifts and factors.
#include <gtest/gtest.h>

#include <cmath>

#include "viewer/orbit_camera.h"

namespace triad {
namespace {

Bounds unit_box() {
    Bounds bounds;
    bounds.add(dvec3(-1)), bounds.add(dvec3(1));
    return bounds;
}

/// From +z at the origin.
OrbitCamera from_the_front() {
    return orbit_camera(look_at({0, 0, 4}, {0, 0, 0}, 40 * pi / 180, 1.5), 1.5, 4, unit_box());
}

/// Where a point is seen, in heights of the picture from its middle.
dvec2 seen(const View& view, const dvec3& point) {
    const dvec3 way = point - view.eye;
    const double depth = view.orthographic ? 1 : glm::dot(way, view.forward);
    return dvec2(glm::dot(way, view.right), glm::dot(way, view.up)) / (depth * 2 * view.extent.y);
}

void expect_near(const dvec3& a, const dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-9); }

TEST(OrbitCamera, GoesRoundItsTarget) {
    const OrbitCamera side = orbited(from_the_front(), pi / 2, 0);
    expect_near(side.view.eye, {4, 0, 0});
    expect_near(side.view.forward, {-1, 0, 0});
    expect_near(side.view.up, {0, 1, 0});
    const OrbitCamera above = orbited(from_the_front(), 0, pi / 6);
    expect_near(above.view.eye, {0, 2, 2 * std::sqrt(3.0)});
    OrbitCamera round = from_the_front();
    for (int i = 0; i < 36; ++i) round = orbited(round, pi / 18, 0);
    expect_near(round.view.eye, {0, 0, 4});
}

TEST(OrbitCamera, StopsBeforeThePoles) {
    for (const double way : {10.0, -10.0}) {
        const OrbitCamera pole = orbited(from_the_front(), 0, way);
        EXPECT_NEAR(pole.view.forward.y, way > 0 ? -std::sin(89.5 * pi / 180) : std::sin(89.5 * pi / 180),
                    1e-9);
        EXPECT_NEAR(pole.view.right.y, 0, 1e-12);
        const OrbitCamera back = orbited(pole, 0, way > 0 ? -89.5 * pi / 180 : 89.5 * pi / 180);
        expect_near(back.view.eye, {0, 0, 4});
    }
}

/// One that looks straight down from the start may come back, and goes no further.
TEST(OrbitCamera, LeavesAPole) {
    const OrbitCamera down = orbit_camera(look_at({0, 4, 0}, {0, 0, 0}, 0.7, 1), 1, 4, unit_box());
    EXPECT_NEAR(orbited(down, 0, 0.5).view.eye.y, 4, 1e-9);
    const OrbitCamera lower = orbited(down, 0, -pi / 4);
    EXPECT_NEAR(lower.view.eye.y, 4 * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::length(lower.view.eye), 4, 1e-9);
}

TEST(OrbitCamera, PansWhatIsSeen) {
    const OrbitCamera begun = orbited(from_the_front(), 0.3, 0.2);
    const dvec2 shift(0.25, -0.1);
    const dvec2 before = seen(begun.view, begun.target),
                after = seen(panned(begun, shift).view, begun.target);
    EXPECT_LT(glm::length(after - before - shift), 1e-9);
}

TEST(OrbitCamera, ZoomKeepsTheTargetAndItsLimits) {
    const OrbitCamera near = zoomed(from_the_front(), 0.5);
    expect_near(near.view.eye, {0, 0, 2});
    EXPECT_NEAR(near.view.focus_distance, 2, 1e-12);
    OrbitCamera camera = from_the_front();
    for (int i = 0; i < 50; ++i) camera = zoomed(camera, 1e-3);
    EXPECT_GT(glm::length(camera.view.eye), 0);
    for (int i = 0; i < 50; ++i) camera = zoomed(camera, 1e3);
    EXPECT_NEAR(glm::length(camera.view.eye), 1e4 * camera.size, 1e-3);
}

TEST(OrbitCamera, KeepsLensAndFocusInProportion) {
    OrbitCamera camera = from_the_front();
    camera.view.lens_radius = 0.1, camera.view.focus_distance = 3;
    const OrbitCamera far = zoomed(camera, 2);
    EXPECT_EQ(far.view.lens_radius, 0.1);
    EXPECT_NEAR(far.view.focus_distance, 6, 1e-12);
}

TEST(OrbitCamera, OrthographicViewsKeepTheirDistance) {
    View view = look_at({0, 0, 4}, {0, 0, 0}, 0.7, 1);
    view.orthographic = true, view.extent = {2, 1};
    const OrbitCamera camera = orbit_camera(view, 2, 4, unit_box());
    const OrbitCamera side = orbited(camera, pi / 2, 0);
    expect_near(side.view.eye, {4, 0, 0});
    expect_near(side.view.forward, {-1, 0, 0});
    expect_near(glm::cross(side.view.right, side.view.up), -side.view.forward);
    const OrbitCamera large = zoomed(side, 0.5);
    expect_near(large.view.eye, side.view.eye);
    EXPECT_NEAR(large.view.extent.x, 1, 1e-12);
    EXPECT_LT(glm::length(seen(panned(side, {0.5, 0}).view, side.target) - dvec2(0.5, 0)), 1e-9);
}

/// What the page offers to copy renders the same picture bit for bit.
TEST(OrbitCamera, IsThatOfLookAt) {
    OrbitCamera camera = from_the_front();
    for (int i = 0; i < 5; ++i) camera = zoomed(panned(orbited(camera, 0.37, 0.11), {0.03, -0.07}), 0.9);
    const View again = look_at(camera.view.eye, camera.target, camera.fov * pi / 180, camera.aspect);
    EXPECT_EQ(again.forward, camera.view.forward);
    EXPECT_EQ(again.right, camera.view.right);
    EXPECT_EQ(again.extent, camera.view.extent);
    EXPECT_EQ(again.focus_distance, camera.view.focus_distance);
}

}  // namespace
}  // namespace triad
