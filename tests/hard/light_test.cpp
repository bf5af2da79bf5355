// Hard because of light: bodies within bodies, suns in a texel, sharp mirrors, many lights, many bounces.
#include <algorithm>
#include <cmath>

#include "hard_scene.h"
#include "io/io.h"

namespace triad::hard {
namespace {

/// What a stack of parallel smooth faces lets through at right angles, all reflections between them included
/// and added up as light, not as waves: 1 / T - 1 adds up R / (1 - R) over the faces. `indices` from the eye
/// to the lamp.
double transmittance(std::initializer_list<double> indices) {
    double sum = 0, before = 0;
    for (const double n : indices) {
        if (before > 0) {
            const double r = std::pow((n - before) / (n + before), 2);
            sum += r / (1 - r);
        }
        before = n;
    }
    return 1 / (1 + sum);
}

/// Light through column `column` of the scene "dielectrics".
void expect_stack(const char* what, unsigned column, double expected) {
    const Scene scene = load("dielectrics");
    const Shot shot{
        .width = 144, .height = 24, .spp = 64};  // a column is 24 pixels wide, its bodies 16, inner ones 14
    expect_mean(std::string("dielectrics, ") + what,
                measure(scene, shot, seeds, {24 * column + 6, 6, 12, 12}), expected);
}

constexpr double glass = 1.5, water = 1.333;

TEST_F(Hard, glass_alone_transmits_as_a_slab) { expect_stack("glass", 0, transmittance({1, glass, 1})); }
TEST_F(Hard, water_within_glass_is_water_in_glass) {
    expect_stack("water within glass", 1, transmittance({1, glass, water, glass, 1}));
}
TEST_F(Hard, water_that_touches_glass_is_water_on_glass) {
    expect_stack("water touches glass", 2, transmittance({1, glass, water, 1}));
}
TEST_F(Hard, water_above_glass_has_air_between) {
    expect_stack("water, air, glass", 3, transmittance({1, glass, 1, water, 1}));
}
TEST_F(Hard, water_that_overlaps_glass_is_water_on_glass) {
    expect_stack("water overlaps glass", 4, transmittance({1, glass, water, 1}));
}
TEST_F(Hard, a_bubble_in_glass_is_air_in_glass) {
    expect_stack("bubble in glass", 5, transmittance({1, glass, 1, glass, 1}));
}

TEST_F(Hard, deep_stacks_of_glass_transmit_what_their_faces_do) {
    const Scene scene = load("glass_stack");
    const Shot shot{.width = 48, .height = 24, .spp = 64};
    double sum = 0;
    for (int face = 0; face < 64; ++face) sum += 0.04 / 0.96;
    expect_mean("32 panes", measure(scene, shot, seeds, {6, 6, 12, 12}), 1 / (1 + sum));
    expect_mean("32 thin walls", measure(scene, shot, seeds, {30, 6, 12, 12}), 1 / (1 + sum));
}

/// Irradiance of a floor that looks up into a map: bilinear between texels as it is looked up, by quadrature.
double irradiance_of_floor(const EnvironmentMap& map) {
    const auto texel = [&](int x, int y) {
        x = (x + int(map.width)) % int(map.width), y = std::clamp(y, 0, int(map.height) - 1);
        return double(map.rgb[(std::size_t(y) * map.width + std::size_t(x)) * 3 + 1]);
    };
    constexpr int steps =
        4;  // per texel; bilinear between centres, so the midpoint rule errs by the sine's curvature
    double sum = 0;
    for (int j = 0; j < int(map.height) / 2 * steps; ++j) {
        const double y = (j + 0.5) / steps, theta = pi * y / map.height;
        const int y0 = int(std::floor(y - 0.5));
        const double ay = y - 0.5 - y0;
        double row = 0;
        for (int i = 0; i < int(map.width) * steps; ++i) {
            const double x = (i + 0.5) / steps;
            const int x0 = int(std::floor(x - 0.5));
            const double ax = x - 0.5 - x0;
            row += (1 - ay) * ((1 - ax) * texel(x0, y0) + ax * texel(x0 + 1, y0)) +
                   ay * ((1 - ax) * texel(x0, y0 + 1) + ax * texel(x0 + 1, y0 + 1));
        }
        sum += row * std::cos(theta) * std::sin(theta);
    }
    return sum * (pi / (map.height * steps)) * (2 * pi / (map.width * steps));
}

TEST_F(Hard, a_sun_of_1e7_in_one_texel_lights_as_much_as_it_holds) {
    Scene scene = load("sun_in_a_texel");
    scene.environment = load_environment(generated("sun_in_a_texel") / "sun_in_a_texel.hdr");
    const double expected = 0.5 / pi * irradiance_of_floor(*scene.environment);
    // The corner at +x, +z: texel 900 of 1024 is 137 degrees from +x towards +z, the shadow goes to +x, -z.
    const Shot shot{.width = 32, .height = 32, .spp = 256, .max_depth = 2};
    const Measured corner = measure(scene, shot, seeds, {28, 28, 4, 4});
    // The post, 1 high and 0.4 wide at 2.5, hides 0.2 % of the dim sky there, which gives 2 % of the light.
    expect_mean("a sun of 1e7 in a texel", corner, expected, 2e-4);
}

TEST_F(Hard, sharp_mirrors_lose_no_small_light) {
    const Scene scene = load("mirrors");
    // Squares that face their reflection at right angles: radiance times area over the area of the picture.
    const double sharp = 100 * 1e-6 / 1e-4, wide = 100 * 1e-4 / 0.04;
    expect_mean("mirror, alpha 1e-4", measure(scene, {.spp = 64}, seeds), sharp, 1e-4);
    // Of the wider lobe a share of alpha^2 / (alpha^2 + tan^2 theta_h) leaves the picture, 0.2 of 1.41 m
    // away: 2.4e-4.
    expect_mean("mirror, alpha 1.1e-3", measure(scene, {.spp = 512, .camera = 1}, seeds), wide, 1.5e-3);
}

/// Irradiance of a point that looks up, from a triangle that shines on both sides or one: Lambert's polygon
/// formula.
double irradiance_from(const dvec3& p, const dvec3& n, const dvec3 (&corner)[3]) {
    dvec3 v[3];
    for (int i = 0; i < 3; ++i) v[i] = glm::normalize(corner[i] - p);
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const dvec3 c = glm::cross(v[i], v[(i + 1) % 3]);
        const double s = glm::length(c);
        if (s > 0) sum += std::asin(std::min(s, 1.0)) * glm::dot(c, n) / s;  // angles are small
    }
    return 0.5 * std::abs(sum);
}

TEST_F(Hard, ten_thousand_lights_add_up) {
    const Scene scene = load("ten_thousand_lights");
    EXPECT_EQ(scene.lights.size(), 5000u);
    const dvec3 up(0, 1, 0);
    const auto irradiance = [&](const dvec3& p) {
        double e = 0;
        for (const PunctualLight& l : scene.lights) {
            const dvec3 d = l.position - p;
            e += l.colour.y * d.y / std::pow(glm::dot(d, d), 1.5);
        }
        for (const MeshInstance& instance : scene.instances)
            for (const Primitive& mesh : scene.meshes[instance.mesh].primitives)
                for (const uvec3& t : mesh.triangles) {
                    const double radiance = scene.materials[mesh.material].emission.y;
                    if (radiance == 0) continue;
                    const dvec3 corner[3] = {dvec3(mesh.positions[t.x]), dvec3(mesh.positions[t.y]),
                                             dvec3(mesh.positions[t.z])};
                    if (glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), p - corner[0]) <=
                        0)
                        continue;
                    e += radiance * irradiance_from(p, up, corner);
                }
        return e;
    };
    // Shadows between lights of 4 cm are small: none is thrown by points on points, and triangles cover 0.02
    // % of the sky.
    const Shot shot{.width = 16, .height = 16, .spp = 1024, .max_depth = 2};
    constexpr int grid = 12;
    for (const unsigned tile : {0u, 1u, 2u, 3u}) {
        const unsigned x = 8 * (tile % 2), y = 8 * (tile / 2);
        double expected = 0;
        for (int j = 0; j < grid; ++j)
            for (int i = 0; i < grid; ++i)
                expected +=
                    0.5 / pi / (grid * grid) *
                    irradiance({-4 + 0.5 * x + 4 * (i + 0.5) / grid, 0, -4 + 0.5 * y + 4 * (j + 0.5) / grid});
        expect_mean("ten thousand lights, tile " + std::to_string(tile),
                    measure(scene, shot, seeds, {x, y, 8, 8}), expected, 2e-3);
    }
}

TEST_F(Hard, albedo_0_99_keeps_the_light_of_a_hundred_bounces) {
    const Scene scene = load("white_boxes");
    expect_mean("boxes of albedo 0.99", measure(scene, {.width = 12, .height = 9, .spp = 256}, seeds), 100,
                1e-5);
}

}  // namespace
}  // namespace triad::hard
