// Photons: they bring what paths would bring, where paths can, and closed forms where these cannot.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"
#include "kernels/types.h"
#include "metric/mean_test.h"
#include "scene/glass.h"

namespace triad::analytic {
namespace {

Material smooth_metal() {
    Material m;
    m.metallic = 1.0f, m.roughness = 0.0f;
    return m;
}

/// A floor and a glossy wall, a ball of green glass with interpolated normals, a pane, and a mirror ball.
Builder casters() {
    Builder b;
    Material wall;
    wall.metallic = 0.0f, wall.roughness = 0.5f;
    wall.base_colour = {0.6f, 0.3f, 0.2f, 1.0f};
    Material body = glass(1.5f);
    body.attenuation_colour = {0.5f, 0.9f, 0.6f}, body.attenuation_distance = 1.0f;
    Material pane = glass(1.5f);
    pane.thickness = 0.0f;
    Material varnished = lambert(0.5f);
    varnished.specular = 1.0f, varnished.roughness = 0.0f;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
    b.add(shapes::quad({-2, 0, -1}, {4, 0, 0}, {0, 3, 0}), wall);
    b.add(shapes::lat_long_sphere({-0.5f, 0.6f, 0.2f}, 0.45f, 24, 12), body);
    b.add(shapes::quad({0.9f, 0.1f, -0.6f}, {0, 0, 1.2f}, {0.3f, 1.2f, 0}), pane);
    b.add(shapes::lat_long_sphere({0.5f, 0.4f, 0.5f}, 0.3f, 24, 12), smooth_metal());
    b.add(shapes::box({-1.6f, 0, -0.6f}, {-1.2f, 0.7f, 0.2f}), varnished);
    return b;
}

RenderSettings settings_of(Integrator integrator) {
    RenderSettings s;
    s.width = 64, s.height = 48;
    s.integrator = integrator;
    s.view = look_at({0.4, 1.5, 3.6}, {0, 0.5, 0}, 0.8, 64.0 / 48);
    return s;
}

TileMeans render(Scene scene, RenderSettings settings, std::uint32_t first_seed, unsigned spp,
                 unsigned films = 4) {
    validate(scene);
    TileMeans means;
    for (unsigned k = 0; k < films; ++k) {
        settings.seed = first_seed + k;
        Renderer renderer(test_device(), scene, settings);
        EXPECT_EQ(renderer.photons() > 0, settings.integrator != Integrator::path);
        renderer.render({0, spp}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
        means.add(film);
    }
    return means;
}

void expect_same_picture(const Scene& scene, const std::function<void(RenderSettings&)>& change = {}) {
    const auto means = [&](Integrator integrator, std::uint32_t seed, unsigned spp) {
        RenderSettings settings = settings_of(integrator);
        if (change) change(settings);
        return render(scene, settings, seed, spp);
    };
    const TileMeans paths = means(Integrator::path, 1, 768);
    for (const Integrator integrator : {Integrator::light, Integrator::photons}) {
        const MeanTest test = test_means(means(integrator, 100, 128), paths);
        EXPECT_TRUE(test.same) << test.sentence;
    }
}

Scene with_square_light() {
    Builder b = casters();
    b.add(shapes::quad({-0.8f, 2.5f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}), emitter(4.0f));
    return b.scene;
}

TEST(Photons, flat_mirrors_with_bent_normals_throw_as_much_light_as_paths_find) {
    Builder b;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
    Primitive mirror = shapes::quad({-1.5f, 0.1f, -1.2f}, {3, 0, 0}, {0, 2, -1}, 4, 4);
    mirror.normals.clear();
    const vec3 n = glm::normalize(vec3(0, 1, 2));
    for (const vec3& p : mirror.positions)
        mirror.normals.push_back(glm::normalize(n + 0.5f * (p - vec3(0, 1.1f, -1.7f))));
    b.add(mirror, smooth_metal());
    b.add(shapes::quad({-1, 2.8f, -0.5f}, {2, 0, 0}, {0, 0, 2}), emitter(4.0f));
    expect_same_picture(b.scene);
}

TEST(Photons, a_large_light_shines_through_glass_as_by_paths) { expect_same_picture(with_square_light()); }

TEST(Photons, glass_that_disperses_throws_the_colours_that_paths_find) {
    Builder b;
    Material prism = glass(1.6f);
    prism.dispersion = find_glass("SF10");
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
    b.add(shapes::box({-0.7f, 0.5f, -0.4f}, {0.7f, 1.1f, 0.4f}), prism);
    b.add(shapes::lat_long_sphere({0.2f, 0.4f, 0.9f}, 0.3f, 24, 12), prism);
    b.add(shapes::quad({-0.6f, 2.2f, -0.6f}, {1.2f, 0, 0}, {0, 0, 1.2f}), emitter(6.0f));
    expect_same_picture(b.scene);
    b.scene.materials.back().emission_spectrum =
        LightSpectrum{LightSpectrum::Law::lines, 0, {{450, 1}, {540, 1}, {620, 2}}};
    expect_same_picture(b.scene);
}

TEST(Photons, colours_that_glass_throws_are_the_same_seen_through_more_of_it) {
    Builder b;
    Material prism = glass(1.6f);
    prism.dispersion = find_glass("SF10");
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
    b.add(shapes::box({-0.9f, 0.5f, -0.4f}, {0.9f, 1.1f, 0.4f}), prism);
    b.add(shapes::box({-3, 0.1f, 2.2f}, {3, 3, 2.5f}), prism);  // before the camera
    b.add(shapes::quad({-0.6f, 2.2f, -0.6f}, {1.2f, 0, 0}, {0, 0, 1.2f}), emitter(6.0f));
    expect_same_picture(b.scene);
}

TEST(Photons, a_lens_bins_and_a_crop_see_the_same) {
    expect_same_picture(with_square_light(), [](RenderSettings& s) {
        s.view.lens_radius = 0.2;
        s.view.focus_distance = 3;
        s.bins_x = 2;
        s.crop = {10, 12, 48, 32};
    });
}

TEST(Photons, an_orthographic_view_and_a_longest_path_see_the_same) {
    expect_same_picture(with_square_light(), [](RenderSettings& s) {
        s.view.orthographic = true;
        s.view.extent = {2, 1.5};
        s.max_depth = 5;
    });
}

TEST(Photons, a_map_shines_through_glass_as_by_paths) {
    Builder b = casters();
    EnvironmentMap map{32, 16, std::vector<float>(32 * 16 * 3, 0.3f)};
    for (unsigned y = 2; y < 5; ++y)
        for (unsigned x = 6; x < 12; ++x)
            for (unsigned c = 0; c < 3; ++c) map.rgb[3 * (y * 32 + x) + c] = 6.0f - float(c);
    b.scene.environment = map;
    expect_same_picture(b.scene);
}

/// A floor seen from above beside a perfect mirror in the plane x = 1, under a light that has no extent.
double floor_radiance(const PunctualLight& light, std::uint32_t seed) {
    Builder b;
    b.add(shapes::quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), lambert(0.5f));
    b.add(shapes::quad({1, -1, 2}, {0, 0, -4}, {0, 4, 0}), smooth_metal());
    b.scene.lights.push_back(light);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.seed = seed;
    settings.integrator = Integrator::automatic;
    settings.photons = 1 << 15;
    settings.view = look_at({0, 3, 0}, {0, 0, 0}, 0.02, 1.0);
    const Scene scene = b.scene;
    Renderer renderer(test_device(), scene, settings);
    EXPECT_GT(renderer.photons(), 0u) << renderer.packed().integrator;
    renderer.render({0, 64}, [](const Progress&) { return true; });
    const Film film = renderer.film();
    double sum = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) sum += pixel_mean(film, p)[1];
    return sum / double(film.pixels());
}

double mean_of_seeds(const PunctualLight& light) {
    double sum = 0;
    for (std::uint32_t seed = 0; seed < 4; ++seed) sum += floor_radiance(light, seed) / 4;
    return sum;
}

TEST(Photons, a_point_light_and_its_image_in_a_mirror_follow_the_inverse_square) {
    PunctualLight light;
    light.position = {0.3, 1.5, 0.2};
    light.colour = vec3(5.0f);
    double expected = 0;
    for (const double x : {0.3, 1.7}) {
        const double d2 = x * x + 1.5 * 1.5 + 0.2 * 0.2;
        expected += 0.5 / pi * 5 * 1.5 / std::pow(d2, 1.5);
    }
    EXPECT_NEAR(mean_of_seeds(light), expected, 0.003 * expected);
    // its range ends the way by the mirror too
    light.range = 2.0f;  // direct way 1.54 long, by the mirror 2.28
    const double d2 = 0.3 * 0.3 + 1.5 * 1.5 + 0.2 * 0.2;
    const double direct = 0.5 / pi * 5 * 1.5 / std::pow(d2, 1.5) * (1 - d2 * d2 / 16);
    EXPECT_NEAR(mean_of_seeds(light), direct, 0.003 * direct);
}

/// The floor in a mirror on the ceiling: no path finds the light that comes to it from either mirror.
TEST(Photons, sunlight_comes_from_a_mirror_as_strong_as_from_the_sun) {
    PunctualLight light;
    light.type = PunctualLight::Type::directional;
    light.direction = normalize(dvec3(1, -1, 0.1));
    light.colour = vec3(2.0f);
    const double expected = 2 * 0.5 / pi * 2 * -light.direction.y;
    EXPECT_NEAR(mean_of_seeds(light), expected, 0.003 * expected);
}

/// Mean of the picture's green channel.
double brightness(const Scene& unchecked, const RenderSettings& settings, unsigned spp) {
    Scene scene = unchecked;
    validate(scene);
    Renderer renderer(test_device(), scene, settings);
    renderer.render({0, spp}, [](const Progress&) { return true; });
    const Film film = renderer.film();
    double sum = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) sum += pixel_mean(film, p)[1];
    return sum / double(film.pixels());
}

TEST(Photons, the_classic_map_is_as_bright_as_paths_but_for_its_blur) {
    Builder b = casters();
    Material wall = lambert(0.5f);
    wall.double_sided = true;
    b.add(shapes::box({-2.2f, -0.2f, -2}, {2.2f, 3.2f, 4}), wall);
    b.add(shapes::quad({-0.8f, 2.5f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}), emitter(4.0f));
    const double by_paths = brightness(b.scene, settings_of(Integrator::path), 256);
    RenderSettings classic = settings_of(Integrator::photon_map);
    classic.photons = 400000;
    for (const bool final_gather : {true, false}) {
        classic.final_gather = final_gather;
        EXPECT_NEAR(brightness(b.scene, classic, 32), by_paths, 0.02 * by_paths) << final_gather;
    }
}

TEST(Photons, parts_and_work_group_sizes_change_no_bit) {
    Scene scene = with_square_light();
    validate(scene);
    for (const Integrator integrator : {Integrator::photons, Integrator::photon_map}) {
        RenderSettings settings = settings_of(integrator);
        settings.photons = 4000;
        const auto film = [&](Device& device, const std::vector<SampleRange>& ranges) {
            return picture_case::render(device, scene, settings, ranges);
        };
        Device& device = test_device();
        const Film whole = film(device, {{0, 5}});
        const std::size_t before = device.preferred_local();
        device.set_preferred_local(before == 1 ? 64 : 1);
        const Film other = film(device, {{3, 5}, {0, 3}});
        device.set_preferred_local(before);
        EXPECT_EQ(whole.sums, other.sums);
        EXPECT_EQ(whole.half_sums, other.half_sums);
        EXPECT_EQ(whole.counters, other.counters);
    }
}

TEST(Photons, are_used_where_something_casts_a_small_light_and_in_doubt_of_a_large_one) {
    const auto chosen = [](Scene scene, Integrator integrator) {
        validate(scene);
        return Renderer(test_device(), scene, settings_of(integrator)).photons() > 0;
    };
    Builder small = casters();
    small.add(shapes::quad({0, 2.5f, 0}, {0.05f, 0, 0}, {0, 0, 0.05f}), emitter(400.0f));
    EXPECT_TRUE(chosen(small.scene, Integrator::automatic));
    EXPECT_FALSE(chosen(small.scene, Integrator::path));
    Builder middling = casters();
    middling.add(shapes::quad({-0.8f, 5, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}), emitter(4.0f));
    const auto in_doubt = [](Scene scene) {
        validate(scene);
        return pack(scene, settings_of(Integrator::automatic)).photons_in_doubt;
    };
    EXPECT_FALSE(in_doubt(small.scene));
    EXPECT_TRUE(in_doubt(middling.scene)) << "no reason by itself";
    EXPECT_TRUE(in_doubt(with_square_light())) << "a large light";
    EXPECT_TRUE(chosen(with_square_light(), Integrator::photons));
    Builder tube = casters();
    tube.add(shapes::quad({-1.5f, 5, 0}, {3, 0, 0}, {0, 0, 0.02f}), emitter(200.0f));
    EXPECT_TRUE(chosen(tube.scene, Integrator::automatic)) << "long and thin";
    Builder plain;
    plain.add(square(0, true), lambert(0.5f));
    plain.scene.lights.push_back({});
    EXPECT_FALSE(chosen(plain.scene, Integrator::photons)) << "nothing casts";
}

}  // namespace
}  // namespace triad::analytic
