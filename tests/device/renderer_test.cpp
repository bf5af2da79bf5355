// A picture is a function of scene, settings and samples: not of how the work was cut, scheduled or
// specialised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../analytic/analytic_scene.h"

namespace triad {
namespace {

using analytic::Builder;

/// A small room with everything in it: textures, alpha, glass, metal, an area light, a point light, an
/// environment.
Scene varied_scene() {
    Builder b;
    Material wall = analytic::lambert(0.7f);
    wall.base_colour_texture = TextureUse{};
    b.scene.images.push_back(
        {"checks", 2, 2, 8, {255, 255, 255, 255, 90, 60, 40, 255, 90, 60, 40, 255, 255, 255, 255, 255}});
    b.scene.textures.push_back({});
    Material metal;
    metal.base_colour = {0.9f, 0.7f, 0.4f, 1.0f};
    metal.roughness = 0.3f;
    Material leaf = analytic::lambert(0.5f);
    leaf.alpha_mode = AlphaMode::blend;
    leaf.base_colour.w = 0.6f;
    Material shade = analytic::emitter(5.0f);
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 4, 4), wall);
    b.add(shapes::lat_long_sphere({-0.7f, 0.5f, 0}, 0.5f, 32, 16), analytic::glass(1.5f));
    b.add(shapes::lat_long_sphere({0.7f, 0.5f, 0}, 0.5f, 32, 16), metal);
    b.add(shapes::quad({-1, 0, 0.8f}, {2, 0, 0}, {0, 1, 0}), leaf);
    b.add(shapes::quad({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}), shade);
    b.scene.lights.push_back({.position = {1, 2, 1}, .colour = vec3(2.0f)});
    std::vector<float> sky(16 * 8 * 3);
    for (std::size_t i = 0; i < sky.size(); ++i) sky[i] = 0.1f + 0.01f * static_cast<float>(i % 37);
    b.scene.environment = EnvironmentMap{16, 8, sky};
    return b.scene;
}

RenderSettings small_settings() {
    RenderSettings s;
    s.width = 37;
    s.height = 29;
    s.seed = 5;
    s.view = look_at({0.3, 1.2, 3.5}, {0, 0.5, 0}, 0.8, 37.0 / 29.0);
    return s;
}

Film render(Device& device, const Scene& scene, const RenderSettings& settings,
            const std::vector<SampleRange>& ranges, const std::optional<Features>& features = {}) {
    Scene copy = scene;
    validate(copy);
    Renderer renderer(device, copy, settings, features);
    for (const SampleRange& r : ranges) renderer.render(r, [](const Progress&) { return true; });
    return renderer.film();
}

void expect_same_bytes(const Film& a, const Film& b, const std::string& what) {
    EXPECT_EQ(a.sums, b.sums) << what;
    EXPECT_EQ(a.half_sums, b.half_sums) << what;
    EXPECT_EQ(a.samples, b.samples) << what;
    EXPECT_EQ(a.ranges, b.ranges) << what;
    EXPECT_EQ(a.counters, b.counters) << what;
}

TEST(Renderer, same_bytes_however_the_samples_are_cut) {
    const Scene scene = varied_scene();
    const Film whole = render(test_device(), scene, small_settings(), {{0, 12}});
    EXPECT_EQ(whole.counters[1], 0u) << "samples that were not finite";
    expect_same_bytes(whole, render(test_device(), scene, small_settings(), {{7, 12}, {0, 3}, {3, 7}}),
                      "three ranges, out of order");
    const Film parts[] = {render(test_device(), scene, small_settings(), {{5, 12}}),
                          render(test_device(), scene, small_settings(), {{0, 1}}),
                          render(test_device(), scene, small_settings(), {{1, 5}})};
    expect_same_bytes(whole, merge(parts), "three films merged");
}

TEST(Renderer, same_bytes_for_every_work_group_size) {
    const Scene scene = varied_scene();
    Device& device = test_device();
    const std::size_t before = device.preferred_local();
    const Film whole = render(device, scene, small_settings(), {{0, 3}});
    for (std::size_t local : {1, 8, 64, 256}) {
        if (local > device.info().max_work_group) continue;
        device.set_preferred_local(local);
        expect_same_bytes(whole, render(device, scene, small_settings(), {{0, 3}}),
                          "local size " + std::to_string(local));
    }
    device.set_preferred_local(before);
}

TEST(Renderer, same_bytes_on_one_thread) {
    if (test_device().info().type != "cpu") GTEST_SKIP() << "threads are for CPU devices";
    const char* selector = std::getenv("TRIAD_TEST_DEVICE");
    Device one = Device::open({.selector = selector ? selector : "", .threads = 1});
    const Scene scene = varied_scene();
    expect_same_bytes(render(test_device(), scene, small_settings(), {{0, 3}}),
                      render(one, scene, small_settings(), {{0, 3}}), "one thread");
}

TEST(Renderer, same_bytes_with_everything_compiled_in) {
    // Scenes that lack one thing each; the specialised program against the general one.
    std::vector<std::pair<std::string, Scene>> scenes{{"varied", varied_scene()}};
    Scene plain = varied_scene();
    for (Material& m : plain.materials) m = analytic::lambert(0.5f);
    plain.lights.clear();
    plain.environment.reset();
    plain.sky = vec3(1.0f);
    scenes.push_back({"lambert under a sky", plain});
    Scene opaque = varied_scene();
    for (Material& m : opaque.materials) m.transmission = 0, m.alpha_mode = AlphaMode::opaque;
    scenes.push_back({"no transmission, no alpha", opaque});
    for (auto& [name, scene] : scenes)
        expect_same_bytes(render(test_device(), scene, small_settings(), {{0, 2}}),
                          render(test_device(), scene, small_settings(), {{0, 2}}, Features{}), name);
}

TEST(Renderer, a_crop_has_the_pixels_of_the_whole) {
    const Scene scene = varied_scene();
    const Film whole = render(test_device(), scene, small_settings(), {{0, 2}});
    RenderSettings settings = small_settings();
    settings.crop = {5, 11, 17, 9};
    const Film crop = render(test_device(), scene, settings, {{0, 2}});
    for (unsigned y = 0; y < 9; ++y)
        for (unsigned x = 0; x < 17; ++x)
            for (unsigned c = 0; c < 4; ++c)
                ASSERT_EQ(crop.sums[(y * 17 + x) * 4 + c], whole.sums[((y + 11) * 37 + x + 5) * 4 + c])
                    << x << "," << y;
}

TEST(Renderer, bins_share_the_samples_of_a_pixel) {
    const Scene scene = varied_scene();
    RenderSettings settings = small_settings();
    settings.bins_x = settings.bins_y = 3;
    const Film film = render(test_device(), scene, settings, {{0, 90}});
    const Film plain = render(test_device(), scene, small_settings(), {{0, 90}});
    double binned = 0, whole = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        binned += pixel_mean(film, p)[1];
        whole += pixel_mean(plain, p)[1];
        for (std::size_t b = 0; b < 9; ++b) EXPECT_GE(film.sums[(p * 9 + b) * 4 + 3], 0);
    }
    EXPECT_NEAR(binned / whole, 1.0, 0.02);
}

TEST(Renderer, C4_translation_by_2_to_the_20_changes_no_bit) {
    const Scene scene = varied_scene();
    Scene moved = scene;
    RenderSettings settings = small_settings();
    const dvec3 by(1048576.0, -1048576.0, 1048576.0);
    for (MeshInstance& i : moved.instances) i.to_world = glm::translate(dmat4(1.0), by) * i.to_world;
    for (PunctualLight& l : moved.lights) l.position += by;
    // The eye must be as exact as the rest: its digits below 2^-32 are gone once it is far away.
    for (int c = 0; c < 3; ++c)
        settings.view.eye[c] = std::ldexp(std::round(std::ldexp(settings.view.eye[c], 24)), -24);
    RenderSettings moved_settings = settings;
    moved_settings.view.eye += by;
    expect_same_bytes(render(test_device(), scene, settings, {{0, 2}}),
                      render(test_device(), moved, moved_settings, {{0, 2}}), "translated");
}

TEST(Renderer, C5_scaling_by_powers_of_two_changes_no_bit) {
    const Scene scene = varied_scene();
    const Film whole = render(test_device(), scene, small_settings(), {{0, 2}});
    for (int k : {-20, -7, 1, 20}) {
        const double s = std::ldexp(1.0, k);
        Scene scaled = scene;
        for (Mesh& m : scaled.meshes)
            for (Primitive& p : m.primitives)
                for (vec3& v : p.positions) v *= static_cast<float>(s);
        for (PunctualLight& l : scaled.lights) l.position *= s, l.colour *= static_cast<float>(s * s);
        for (Material& m : scaled.materials) m.attenuation_distance *= static_cast<float>(s);
        RenderSettings settings = small_settings();
        settings.view.eye *= s;
        settings.view.focus_distance *= s;
        expect_same_bytes(whole, render(test_device(), scaled, settings, {{0, 2}}), "2^" + std::to_string(k));
    }
}

TEST(Renderer, instanced_and_flattened_meshes_give_the_same_picture) {
    Builder b;
    Primitive ball = shapes::lat_long_sphere({0, 0, 0}, 0.4f, 24, 12);
    b.add(ball, analytic::lambert(0.8f), glm::translate(dmat4(1.0), dvec3(-0.6, 0, 0)));
    b.scene.instances.push_back(
        {"second", 0, glm::scale(glm::translate(dmat4(1.0), dvec3(0.6, 0, 0)), dvec3(-1.0, 1.5, 1.0))});
    b.sky(1.0f);
    RenderSettings flat = small_settings(), instanced = small_settings();
    instanced.flatten_below = 0;
    const Film a = render(test_device(), b.scene, flat, {{0, 64}}),
               c = render(test_device(), b.scene, instanced, {{0, 64}});
    double worst = 0;
    for (std::size_t p = 0; p < a.pixels(); ++p)
        worst = std::max(worst, std::abs(pixel_mean(a, p)[1] - pixel_mean(c, p)[1]));
    EXPECT_LT(worst, 0.02);  // the same rays; only rounding at silhouettes differs
}

TEST(Renderer, alpha_is_the_coverage_and_glass_is_clear) {
    Builder b;
    Material veil = analytic::lambert(0.5f);
    veil.alpha_mode = AlphaMode::blend;
    veil.base_colour.w = 0.25f;
    b.add(shapes::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), veil).sky(1.0f);
    RenderSettings settings = small_settings();
    settings.transparent = true;
    settings.view = analytic::orthographic({0, 0, 0}, {0, 0, -1}, 1, 2);
    auto mean_alpha = [&](const Scene& scene, unsigned spp) {
        const Film film = render(test_device(), scene, settings, {{0, spp}});
        double sum = 0;
        for (std::size_t p = 0; p < film.pixels(); ++p) sum += pixel_mean(film, p)[3];
        return sum / static_cast<double>(film.pixels());
    };
    EXPECT_NEAR(mean_alpha(b.scene, 64), 0.25, 0.01);  // 68,000 coin throws: standard error .0017
    Builder window;
    Material pane = analytic::glass(1.5f);
    pane.thickness = 0;
    window.add(shapes::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), pane).sky(1.0f);
    EXPECT_NEAR(mean_alpha(window.scene, 64), 1.0 - 0.923076923, 0.005);  // what the slab reflects is opaque
}

TEST(Renderer, exact_duplicates_change_nothing) {
    // C7 and C3: coincident faces, in one mesh and across instances, neither shadow nor shine twice.
    const Scene scene = varied_scene();
    const Film whole = render(test_device(), scene, small_settings(), {{0, 4}});
    Scene twice = scene;
    for (std::size_t i = 0, n = scene.instances.size(); i < n; ++i)
        twice.instances.push_back(scene.instances[i]);
    const Film doubled = render(test_device(), twice, small_settings(), {{0, 4}});
    EXPECT_EQ(whole.sums, doubled.sums);
}

TEST(Renderer, estimated_error_is_the_true_error) {
    Scene scene = varied_scene();
    RenderSettings settings = small_settings();
    settings.width = settings.height = 16;
    settings.seed = 777;
    const Film reference = render(test_device(), scene, settings, {{0, 8192}});
    std::vector<double> ratios;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        settings.seed = seed;
        const Film film = render(test_device(), scene, settings, {{0, 32}});
        double error = 0;
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            const auto x = pixel_mean(film, p), r = pixel_mean(reference, p);
            for (int c = 0; c < 3; ++c) error += (x[c] - r[c]) * (x[c] - r[c]) / (r[c] * r[c] + 0.01) / 3.0;
        }
        ratios.push_back(estimated_relmse(film) / (error / static_cast<double>(film.pixels())));
    }
    std::nth_element(ratios.begin(), ratios.begin() + 50, ratios.end());
    EXPECT_GT(ratios[50], 0.9);
    EXPECT_LT(ratios[50], 1.1);
}

}  // namespace
}  // namespace triad
