// Direct light with a closed form: form factors, Lambert's polygon, punctual lights, the environment.
#include "check/cases.h"
#include "check/picture.h"

namespace triad {
namespace {

using namespace picture_case;

Primitive disc(double height, bool up, double radius, unsigned segments = 2048) {
    Primitive p;
    p.positions.push_back({0, static_cast<float>(height), 0});
    for (unsigned i = 0; i < segments; ++i) {
        const double phi = 2 * pi * i / segments;
        p.positions.push_back({static_cast<float>(radius * std::cos(phi)), static_cast<float>(height),
                               static_cast<float>(radius * std::sin(phi))});
        const unsigned a = 1 + i, b = 1 + (i + 1) % segments;
        p.triangles.push_back(up ? uvec3(0, b, a) : uvec3(0, a, b));
    }
    return p;
}

void facing_squares(Check& check) {
    // Lo = rho E / pi and E = pi L F: the mean over the receiver is F (D1).
    Builder b;
    b.add(square(0, true), lambert(1.0f)).add(square(1, false), emitter(1.0f));
    expect_closed_form(
        check, "F",
        measure(check, b.scene,
                {.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.5, 0.5), .spp = 256, .max_depth = 2}),
        0.199824896, 1e-5);
}

void close_squares(Check& check) {
    Builder b;
    b.add(square(0, true), lambert(1.0f)).add(square(0.1, false), emitter(1.0f));
    expect_closed_form(
        check, "F",
        measure(check, b.scene,
                {.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.5, 0.05), .spp = 1024, .max_depth = 2}),
        0.826994522, 1e-5);
}

void squares_with_a_common_edge(Check& check) {
    Builder b;
    b.add(shapes::quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}), lambert(1.0f));
    b.add(shapes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), emitter(1.0f));
    expect_closed_form(
        check, "F",
        measure(check, b.scene,
                {.view = orthographic({0.5, 0, 0.5}, {0, -1, 0}, 0.5, 2), .spp = 1024, .max_depth = 2}),
        0.200043776, 1e-5);
}

void coaxial_discs(Check& check) {
    // Only pixels inside the disc receive; the square picture's mean is F times pi / 4.
    Builder b;
    b.add(disc(0, true, 1), lambert(1.0f)).add(disc(1, false, 1), emitter(1.0f));
    expect_closed_form(
        check, "F",
        measure(
            check, b.scene,
            {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1.0, 0.5), .size = 64, .spp = 64, .max_depth = 2}),
        0.381966011 * pi / 4, 1e-4);
}

void square_light(Check& check) {
    // D2: E / L = .752274688 below the centre; .419469706 at (.7, .2), where albedo .8 gives Lo = .106817083.
    Builder b;
    b.add(square(0, true, 2.0), lambert(0.8f)).add(square(1, false), emitter(1.0f));
    const Measured centre = measure(
        check, b.scene,
        {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-3, 0.5), .size = 4, .spp = 4096, .max_depth = 2});
    expect_closed_form(check, "centre", centre, 0.8 * 0.752274688 / pi, 1e-5);
    const Measured aside = measure(
        check, b.scene,
        {.view = orthographic({0.7, 0, 0.2}, {0, -1, 0}, 1e-3, 0.5), .size = 4, .spp = 4096, .max_depth = 2});
    expect_closed_form(check, "aside", aside, 0.106817083, 1e-5);
    // Farther away points are drawn by area: four times a square that begins at its foot.
    constexpr double height = 3, x = 0.5 / height;
    Builder far;
    far.add(square(0, true, 2.0), lambert(0.8f)).add(square(height, false), emitter(1.0f));
    const double beside = std::sqrt(1 + x * x), irradiance = 4 * x / beside * std::atan(x / beside);
    expect_closed_form(
        check, "far",
        measure(
            check, far.scene,
            {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-3, 0.5), .size = 4, .spp = 4096, .max_depth = 2}),
        0.8 * irradiance / pi, 1e-5);
}

/// What a smooth varnish of index 1.5 leaves of light that comes from below (KHR_materials_clearcoat).
double through_varnish(double cosine) { return 1 - (0.04 + 0.96 * std::pow(1 - cosine, 5)); }

void lamp_below_its_varnish(Check& check) {
    // Seen: L (1 - F). Lit by it, E below the centre is the integral of that by midpoints; both samplings of
    // the lamp take part. With a texture half of the lamp has the varnish.
    Material lamp = emitter(1.0f);
    lamp.clearcoat = Clearcoat{.factor = 1.0f};
    for (const double degrees : {0.0, 40.0, 70.0, 85.0}) {
        const double t = degrees * pi / 180;
        Builder b;
        b.add(square(0, true, 4), lamp);
        expect_closed_form(check, "seen at " + std::to_string(int(degrees)) + " degrees",
                           measure(check, b.scene,
                                   {.view = orthographic({0, 0, 0}, {std::sin(t), -std::cos(t), 0}, 0.05, 1),
                                    .size = 4,
                                    .spp = 4}),
                           through_varnish(std::cos(t)), 3e-3);
    }
    constexpr int n = 256;
    double plain = 0, varnished = 0;
    for (int i = 0; i < n * n; ++i) {
        const double x = (i / n + 0.5) / n - 0.5, y = (i % n + 0.5) / n - 0.5,
                     cosine = 1 / std::sqrt(1 + x * x + y * y);
        const double share = std::pow(cosine, 4) / (double(n) * n);
        plain += share, varnished += share * through_varnish(cosine);
    }
    for (const bool textured : {false, true}) {
        Builder b;
        if (textured) {
            b.scene.images.push_back({"half", 2, 1, 8, {255, 255, 255, 255, 0, 0, 0, 255}});
            b.scene.textures.push_back({});
            lamp.clearcoat->texture = TextureUse{};
        }
        b.add(square(0, true, 2.0), lambert(0.8f)).add(square(1, false), lamp);
        expect_closed_form(check, textured ? "half a varnish" : "lit",
                           measure(check, b.scene,
                                   {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-3, 0.5),
                                    .size = 4,
                                    .spp = 4096,
                                    .max_depth = 2}),
                           0.8 / pi * (textured ? 0.5 * (plain + varnished) : varnished), 1e-3);
    }
}

void sphere_light(Check& check) {
    // D2: E = pi L (R / d)^2, .196349541 for R = .5, d = 2; the inscribed polyhedron is smaller by about
    // 1e-4.
    Builder b;
    b.add(square(0, true, 1.0), lambert(1.0f))
        .add(shapes::lat_long_sphere({0, 2, 0}, 0.5f, 256, 128), emitter(1.0f));
    expect_closed_form(
        check, "E",
        measure(
            check, b.scene,
            {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-3, 1.0), .size = 4, .spp = 4096, .max_depth = 2}),
        0.196349541 / pi, 5e-4);
}

void inverse_square(Check& check) {
    for (double height : {0.01, 1.0, 100.0}) {
        Builder b;
        b.add(square(0, true, 4 * height), lambert(0.5f));
        b.scene.lights.push_back(
            {.type = PunctualLight::Type::point, .position = {0, height, 0}, .colour = vec3(3.0f)});
        const Measured m = measure(check, b.scene,
                                   {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-4 * height, 0.5 * height),
                                    .size = 4,
                                    .spp = 16,
                                    .max_depth = 2});
        expect_closed_form(check, "height " + std::to_string(height), m, 0.5 / pi * 3.0 / (height * height),
                           1e-5);
    }
}

void range_cone_and_direction(Check& check) {
    Builder floor;
    floor.add(square(0, true, 4), lambert(1.0f));
    const Plan plan{
        .view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-4, 0.5), .size = 4, .spp = 16, .max_depth = 2};
    auto with = [&](PunctualLight light) {
        Scene scene = floor.scene;
        scene.lights.push_back(light);
        return measure(check, scene, plan);
    };
    using Type = PunctualLight::Type;
    expect_closed_form(check, "range", with({.type = Type::point, .position = {0, 1, 0}, .range = 2.0f}),
                       (1.0 - 1.0 / 16.0) / pi, 1e-5);
    expect_closed_form(check, "directional",
                       with({.type = Type::directional,
                             .direction = glm::normalize(dvec3(0.6, -0.8, 0)),
                             .colour = vec3(2.0f)}),
                       2.0 * 0.8 / pi, 1e-5);
    // Spot at 45 degrees off axis between cones of 30 and 60 degrees: attenuation is ((cos 45 - cos 60) /
    // (cos 30 - cos 60))^2.
    const double a = (std::cos(pi / 4) - 0.5) / (std::cos(pi / 6) - 0.5);
    expect_closed_form(check, "spot",
                       with({.type = Type::spot,
                             .position = {0, 1, 0},
                             .direction = glm::normalize(dvec3(1, -1, 0)),
                             .inner_cone = static_cast<float>(pi / 6),
                             .outer_cone = static_cast<float>(pi / 3)}),
                       a * a / pi, 1e-5);
}

void sphere_returns_its_albedo(Check& check) {
    // Every pixel of the picture is rho where the sphere is; the camera sees nothing else.
    Builder b;
    b.add(
        [] {
            Primitive p = shapes::lat_long_sphere({0, 0, 0}, 1.0f, 64, 32);
            p.normals.clear();
            return p;
        }(),
        lambert(0.6f));
    b.scene.environment = EnvironmentMap{64, 32, std::vector<float>(64 * 32 * 3, 1.0f)};
    expect_closed_form(
        check, "constant map",
        measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.6, 2), .spp = 64}), 0.6, 1e-5);
    b.scene.environment.reset();
    expect_closed_form(
        check, "constant sky",
        measure(check, b.sky(1.0f).scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.6, 2), .spp = 64}),
        0.6, 1e-5);
}

void gradient_map(Check& check) {
    // L = 1 + y: a plane that faces up receives E = pi (1 + 2/3), one that faces down pi (1 - 2/3); rho = 1.
    EnvironmentMap map{256, 128, {}};
    for (unsigned y = 0; y < map.height; ++y)
        for (unsigned x = 0; x < map.width * 3; ++x)
            map.rgb.push_back(static_cast<float>(1.0 + std::cos(pi * (y + 0.5) / map.height)));
    Builder up, down;
    up.add(square(0, true, 4), lambert(1.0f)).scene.environment = map;
    down.add(square(0, false, 4), lambert(1.0f)).scene.environment = map;
    expect_closed_form(
        check, "up",
        measure(check, up.scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1, 1), .spp = 256}),
        1.0 + 2.0 / 3.0, 2e-4);
    expect_closed_form(
        check, "down",
        measure(check, down.scene, {.view = orthographic({0, 0, 0}, {0, 1, 0}, 1, 1), .spp = 256}),
        1.0 - 2.0 / 3.0, 2e-4);
}

void texel_of_sun(Check& check) {
    // C16: a texel of radiance 1e7 over nothing. E on a plane facing it = L omega cos.
    EnvironmentMap map{128, 64, std::vector<float>(128 * 64 * 3, 0.0f)};
    const unsigned row = 16, column = 40;
    for (int c = 0; c < 3; ++c) map.rgb[(row * 128 + column) * 3 + c] = 1e7f;
    // The bilinear footprint of a texel: a tent over 2 x 2 cells. Integrate L cos(theta) over it numerically.
    double e = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
        const double v = (row - 0.5 + 2.0 * (i + 0.5) / n) / 64.0, theta = pi * v;
        const double tent = 1.0 - std::abs(v * 64.0 - (row + 0.5));
        e += 1e7 * tent * std::cos(theta) * std::sin(theta) * (pi / 64.0) * (2 * pi / 128.0) * 2.0 / n;
    }
    Builder b;
    b.add(square(0, true, 4), lambert(0.5f)).scene.environment = map;
    expect_closed_form(
        check, "sun",
        measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1, 1), .spp = 256}),
        0.5 * e / pi, 1e-3);
}

}  // namespace

void add_radiometry(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"D1", "form factor of facing squares", quick, facing_squares},
            {"D1b", "form factor of close squares", standard, close_squares},
            {"D1c", "form factor of squares with a common edge", standard, squares_with_a_common_edge},
            {"D1d", "form factor of coaxial discs", full, coaxial_discs},
            {"D2", "irradiance of a square light", quick, square_light},
            {"D2e", "a lamp below its varnish", standard, lamp_below_its_varnish},
            {"D2b", "irradiance of a sphere light", standard, sphere_light},
            {"D2c", "point lights by the inverse square", standard, inverse_square},
            {"D2d", "range, cone and direction of lights", standard, range_cone_and_direction},
            {"E1", "constant environment on a sphere", quick, sphere_returns_its_albedo},
            {"E2", "gradient of the environment", standard, gradient_map},
            {"C16b", "one texel of sun lights a plane", quick, texel_of_sun},
        });
}

}  // namespace triad
