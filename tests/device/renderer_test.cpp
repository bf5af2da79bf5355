// A picture is a function of scene, settings and samples: not of how the work was cut, scheduled or
// specialised.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analytic/analytic_scene.h"
#include "pack/pack.h"
#include "same_film.h"

namespace triad {
namespace {

using analytic::Builder;
using analytic::varied_scene;

Film render(Device& device, const Scene& scene, const RenderSettings& settings,
            const std::vector<SampleRange>& ranges) {
    return picture_case::render(device, scene, settings, ranges);
}

TEST(Renderer, same_bytes_on_one_thread) {
    if (test_device().info().type != "cpu") GTEST_SKIP() << "threads are for CPU devices";
    const char* selector = std::getenv("TRIAD_TEST_DEVICE");
    Device one = Device::open({.selector = selector ? selector : "", .threads = 1});
    const Scene scene = varied_scene();
    expect_same_bytes(render(test_device(), scene, analytic::varied_settings(), {{0, 3}}),
                      render(one, scene, analytic::varied_settings(), {{0, 3}}), "one thread");
}

TEST(Renderer, a_crop_has_the_pixels_of_the_whole) {
    const Scene scene = varied_scene();
    const Film whole = render(test_device(), scene, analytic::varied_settings(), {{0, 2}});
    RenderSettings settings = analytic::varied_settings();
    settings.crop = {5, 11, 17, 9};
    const Film crop = render(test_device(), scene, settings, {{0, 2}});
    for (unsigned y = 0; y < 9; ++y)
        for (unsigned x = 0; x < 17; ++x)
            for (unsigned c = 0; c < 4; ++c)
                ASSERT_EQ(crop.sums[(y * 17 + x) * 4 + c], whole.sums[((y + 11) * 37 + x + 5) * 4 + c])
                    << x << "," << y;
}

TEST(Renderer, wavelengths_change_no_bit_where_nothing_disperses) {
    const Scene scene = varied_scene();
    RenderSettings settings = analytic::varied_settings();
    const auto film = [&](const Scene& of, Spectral spectral, const std::optional<Features>& features) {
        settings.spectral = spectral;
        return picture_case::render(test_device(), of, settings, {{0, 4}}, features);
    };
    const Film off = film(scene, Spectral::off, {});
    expect_same_bytes(off, film(scene, Spectral::automatic, {}), "auto");
    expect_same_bytes(off, film(scene, Spectral::automatic, Features{}), "auto, everything compiled in");
    Scene dispersive = scene;
    for (Material& m : dispersive.materials)
        if (m.transmission > 0) m.dispersion = Dispersion{Dispersion::Law::cauchy, 0, {1.4, 0.03}, {}};
    EXPECT_FALSE(features_of(pack(scene, settings), settings).dispersion)
        << "the same program, so the same speed";
    expect_same_bytes(off, film(dispersive, Spectral::off, Features{}), "dispersion turned off");
    expect_same_bytes(film(dispersive, Spectral::automatic, {}),
                      film(dispersive, Spectral::automatic, Features{}), "specialised and general");
    EXPECT_NE(off.sums, film(dispersive, Spectral::automatic, {}).sums);
}

TEST(Renderer, spectra_of_lights_are_their_colours_until_something_disperses) {
    const Scene white = varied_scene();
    Scene lit = white;
    const LightSpectrum lines{LightSpectrum::Law::lines, 0, {{450, 1}, {589.3, 2}}};
    for (Material& m : lit.materials)
        if (m.emission != vec3(0.0f)) m.emission_spectrum = lines;
    for (PunctualLight& l : lit.lights) l.spectrum = lines;
    Scene dispersive = lit;
    for (Material& m : dispersive.materials)
        if (m.transmission > 0) m.dispersion = Dispersion{Dispersion::Law::cauchy, 0, {1.4, 0.03}, {}};
    RenderSettings settings = analytic::varied_settings();
    const auto film = [&](const Scene& of, Spectral spectral, const std::optional<Features>& features) {
        settings.spectral = spectral;
        return picture_case::render(test_device(), of, settings, {{0, 4}}, features);
    };
    const Film off = film(lit, Spectral::off, {});
    EXPECT_NE(off.sums, film(white, Spectral::off, {}).sums);
    expect_same_bytes(off, film(lit, Spectral::automatic, {}), "auto");
    expect_same_bytes(off, film(lit, Spectral::automatic, Features{}), "auto, everything compiled in");
    expect_same_bytes(off, film(dispersive, Spectral::off, {}), "dispersion turned off");
    for (const Spectral spectral : {Spectral::automatic, Spectral::full, Spectral::classic})
        expect_same_bytes(film(dispersive, spectral, {}), film(dispersive, spectral, Features{}),
                          "specialised and general");
}

TEST(Renderer, begins_again_with_another_seed_as_a_new_one_would) {
    const Scene scene = varied_scene();
    RenderSettings settings = analytic::varied_settings();
    Renderer renderer(test_device(), scene, settings);
    const auto go_on = [](const Progress&) { return true; };
    renderer.render({0, 3}, go_on);
    renderer.restart(77);
    renderer.render({0, 1}, go_on);
    renderer.render({1, 2}, go_on);
    const Film again = renderer.film();
    settings.seed = 77;
    const Film other = render(test_device(), scene, settings, {{0, 2}});
    expect_same_bytes(again, other, "again");
    EXPECT_EQ(again.settings_text, other.settings_text);
    EXPECT_EQ(again.settings, other.settings);
}

TEST(Renderer, bins_share_the_samples_of_a_pixel) {
    const Scene scene = varied_scene();
    RenderSettings settings = analytic::varied_settings();
    settings.bins_x = settings.bins_y = 3;
    const Film film = render(test_device(), scene, settings, {{0, 90}});
    const Film plain = render(test_device(), scene, analytic::varied_settings(), {{0, 90}});
    double binned = 0, whole = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        binned += pixel_mean(film, p)[1];
        whole += pixel_mean(plain, p)[1];
        for (std::size_t b = 0; b < 9; ++b) EXPECT_GE(film.sums[(p * 9 + b) * 4 + 3], 0);
    }
    EXPECT_NEAR(binned / whole, 1.0, 0.02);
}

TEST(Renderer, instanced_and_flattened_meshes_give_the_same_picture) {
    Builder b;
    Primitive ball = shapes::lat_long_sphere({0, 0, 0}, 0.4f, 24, 12);
    b.add(ball, analytic::lambert(0.8f), glm::translate(dmat4(1.0), dvec3(-0.6, 0, 0)));
    b.scene.instances.push_back(
        {"second", 0, glm::scale(glm::translate(dmat4(1.0), dvec3(0.6, 0, 0)), dvec3(-1.0, 1.5, 1.0))});
    b.sky(1.0f);
    RenderSettings flat = analytic::varied_settings(), instanced = analytic::varied_settings();
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
    RenderSettings settings = analytic::varied_settings();
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

TEST(Renderer, estimated_error_is_the_true_error) {
    Scene scene = varied_scene();
    RenderSettings settings = analytic::varied_settings();
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
    // Of 16 x 16 pixels few have neighbours that show the same.
    EXPECT_GT(ratios[50], 0.9);
    EXPECT_LT(ratios[50], 1.2);
}

}  // namespace
}  // namespace triad
