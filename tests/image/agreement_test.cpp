// Whole pictures that must be equal, and some that must not, by the statistics of measure/statistics.h: seeds
// are fixed, and equal pictures would be called different once in a million seeds.
#include <gtest/gtest.h>

#include "display/perceived_sets.h"
#include "kernels/types.h"
#include "lit_room.h"
#include "metric/statistics.h"

namespace triad::analytic {
namespace {

constexpr unsigned size = 48, batches = 12, spp = 16;

std::vector<Batch> render(Scene scene, std::uint32_t first_seed, unsigned bins = 1, unsigned max_depth = 0,
                          bool adaptive = false, double roulette = 0.8,
                          Spectral spectral = Spectral::automatic, bool for_a_panel = false) {
    validate(scene);
    std::vector<Batch> result;
    for (unsigned k = 0; k < batches; ++k) {
        RenderSettings settings;
        settings.width = settings.height = size;
        settings.bins_x = settings.bins_y = bins;
        settings.seed = first_seed + k;
        settings.max_depth = max_depth;
        settings.roulette = roulette;
        settings.spectral = spectral;
        settings.view = room_view();
        Renderer renderer(test_device(), scene, settings);
        RenderGoal goal{.samples = {0, std::max(spp, 8 * bins * bins)}, .adaptive = adaptive};
        if (for_a_panel) goal.set_errors = perceived_sets(test_device(), {*builtin_panel("rgb"), 45}, {});
        renderer.render_until(goal, [](const Progress&) { return true; });
        const Film film = renderer.film();
        EXPECT_NE(film.is_even(), adaptive);
        EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
        Batch batch{size, size, std::vector<float>(std::size_t(size) * size * 3)};
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            const auto mean = pixel_mean(film, p);
            for (int c = 0; c < 3; ++c) batch.rgb[p * 3 + c] = float(mean[c]);
        }
        result.push_back(std::move(batch));
    }
    return result;
}

const std::vector<Batch>& plain() {
    static const std::vector<Batch> batches_of_it = render(lit_room(1, false), 100);
    return batches_of_it;
}

void expect_agreement(const std::vector<Batch>& other) {
    const Agreement found = compare_pictures(plain(), other);
    EXPECT_TRUE(found.agree) << found.sentence();
}

TEST(Agreement, other_seeds_show_the_same_picture) { expect_agreement(render(lit_room(1, false), 200)); }

TEST(Agreement, a_light_in_one_piece_shines_as_one_in_thirty_two) {
    expect_agreement(render(lit_room(4, false), 300));
}

TEST(Agreement, an_even_sky_shines_as_a_map_of_it_that_is_sampled) {
    expect_agreement(render(lit_room(1, true), 400));
}

TEST(Agreement, bins_change_no_mean) { expect_agreement(render(lit_room(1, false), 500, 2)); }

TEST(Agreement, a_wavelength_for_every_path_shows_the_same_picture) {
    expect_agreement(render(lit_room(1, false), 1000, 1, 0, false, 0.8, Spectral::classic));
}

/// The room with a ball of absorbing glass, with a dispersion or none.
Scene glass_room(const std::optional<Dispersion>& dispersion, float roughness = 0.0f) {
    Scene scene = lit_room(1, false);
    const std::size_t material = scene.materials.size();
    Material glass = picture_case::glass(1.5f, roughness);
    glass.attenuation_distance = 0.5f;
    glass.attenuation_colour = {0.9f, 0.6f, 0.4f};
    glass.dispersion = dispersion;
    if (dispersion) glass.ior = float(dispersion->index(line_d));
    scene.materials.push_back(glass);
    Primitive ball = shapes::lat_long_sphere({0.9f, 0.5f, 0.6f}, 0.45f, 48, 24);
    ball.material = material;
    scene.meshes.push_back({"ball", {ball}});
    scene.instances.push_back({"ball", scene.meshes.size() - 1, dmat4(1.0)});
    return scene;
}

/// Without a colour, so that RGB and spectra must agree exactly.
Scene grey(Scene scene) {
    for (Material& m : scene.materials) {
        m.base_colour = vec4(vec3(m.base_colour.x), m.base_colour.w);
        m.attenuation_colour = vec3(m.attenuation_colour.x);
    }
    return scene;
}

std::vector<Batch> brighter(std::vector<Batch> batches_of_it, float factor) {
    for (Batch& b : batches_of_it)
        for (float& value : b.rgb) value *= factor;
    return batches_of_it;
}

TEST(Agreement, a_dispersion_of_nothing_shows_the_same_picture) {
    for (const float roughness : {0.0f, 0.4f}) {
        const Dispersion nothing{Dispersion::Law::cauchy, 0, {1.5}, {}};
        const Agreement found = compare_pictures(render(glass_room({}, roughness), 1100),
                                                 render(glass_room(nothing, roughness), 1200));
        EXPECT_TRUE(found.agree) << found.sentence();
    }
}

TEST(Agreement, four_wavelengths_show_a_grey_room_as_rgb_does) {
    const Scene room = grey(glass_room({}));
    const Agreement found =
        compare_pictures(render(room, 1300), render(room, 1400, 1, 0, false, 0.8, Spectral::full));
    EXPECT_TRUE(found.agree) << found.sentence();
}

TEST(Agreement, four_wavelengths_split_as_one_does) {
    for (const float roughness : {0.0f, 0.4f}) {
        // from 2.2 at 380 nm to 1.3 at 780 nm
        const Dispersion strong{Dispersion::Law::cauchy, 0, {1.05, 0.17}, {}};
        const Scene room = grey(glass_room(strong, roughness));
        const auto one = render(room, 1500);
        const Agreement found = compare_pictures(one, render(room, 1600, 1, 0, false, 0.8, Spectral::full));
        EXPECT_TRUE(found.agree) << "roughness " << roughness << ": " << found.sentence();
        EXPECT_FALSE(
            compare_pictures(one, brighter(render(room, 1600, 1, 0, false, 0.8, Spectral::full), 1.02f))
                .agree)
            << "roughness " << roughness << ": the test would not see 2 %";
        if (roughness == 0.0f) continue;  // a clear ball hides its dispersion in this noise
        const Agreement none = compare_pictures(one, render(room, 1700, 1, 0, false, 0.8, Spectral::off));
        EXPECT_FALSE(none.agree) << "the test would not see dispersion";
    }
}

/// The room under a lamp of this spectrum; its sky stays D65.
Scene under(const LightSpectrum& spectrum, Scene room) {
    for (Material& m : room.materials)
        if (m.emission != vec3(0.0f)) m.emission_spectrum = spectrum;
    return room;
}

const LightSpectrum candle{LightSpectrum::Law::blackbody, 1900, {}};
const LightSpectrum three_lines{LightSpectrum::Law::lines, 0, {{450, 1}, {532.4, 1}, {650, 3}}};

TEST(Agreement, spectra_of_lights_show_a_grey_room_alike_in_every_scheme) {
    const Dispersion nothing{Dispersion::Law::cauchy, 0, {1.5}, {}};
    for (const LightSpectrum& spectrum : {candle, three_lines}) {
        const Scene room = under(spectrum, grey(glass_room(nothing, 0.4f)));
        const auto off = render(room, 1800, 1, 0, false, 0.8, Spectral::off);
        EXPECT_FALSE(compare_pictures(off, render(grey(glass_room(nothing, 0.4f)), 1900)).agree);
        for (const Spectral scheme : {Spectral::automatic, Spectral::full}) {
            const Agreement found = compare_pictures(off, render(room, 2000, 1, 0, false, 0.8, scheme));
            EXPECT_TRUE(found.agree) << int(scheme) << ": " << found.sentence();
        }
    }
}

TEST(Agreement, four_wavelengths_split_lines_as_one_does) {
    const Dispersion strong{Dispersion::Law::cauchy, 0, {1.05, 0.17}, {}};
    const Scene room = under(three_lines, grey(glass_room(strong, 0.4f)));
    const auto one = render(room, 2100);
    const Agreement found = compare_pictures(one, render(room, 2200, 1, 0, false, 0.8, Spectral::full));
    EXPECT_TRUE(found.agree) << found.sentence();
}

TEST(Agreement, roulette_changes_no_mean) {
    expect_agreement(render(lit_room(1, false), 900, 1, 0, false, 2.0));
}

TEST(Agreement, adaptive_sampling_from_four_samples_on_changes_no_mean) {
    expect_agreement(render(lit_room(1, false), 800, 1, 0, true));
}

TEST(Agreement, samples_by_perceived_error_change_no_mean) {
    for (const unsigned bins : {1u, 3u})
        expect_agreement(
            render(lit_room(1, false), 1800 + 100 * bins, bins, 0, true, 0.8, Spectral::automatic, true));
}

TEST(Agreement, one_tile_that_is_five_percent_brighter_is_found) {
    auto biased = render(lit_room(1, false), 600);
    for (Batch& b : biased)
        for (unsigned y = 32; y < 48; ++y)
            for (unsigned x = 16; x < 32; ++x)
                for (int c = 0; c < 3; ++c) b.rgb[(std::size_t(y) * size + x) * 3 + c] *= 1.05f;
    const Agreement found = compare_pictures(plain(), biased);
    EXPECT_FALSE(found.agree) << found.sentence();
    EXPECT_EQ(found.worst_place.substr(0, 9), "tile 1, 2") << found.sentence();
}

TEST(Agreement, paths_without_their_tail_are_darker) {
    const Agreement found = compare_pictures(plain(), render(lit_room(1, false), 700, 1, 3));
    EXPECT_FALSE(found.agree) << found.sentence();
    EXPECT_LT(found.worst.mean_b, found.worst.mean_a);
}

TEST(Agreement, a_weak_light_alone_in_its_cone_is_no_noise) {
    // A narrow blue spot beside a lamp a thousand times its power that shines elsewhere.
    Builder b;
    b.add(shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), lambert(0.5f));
    b.scene.lights.push_back({.position = {0, -1, 0}, .colour = vec3(100.0f)});
    b.scene.lights.push_back({.type = PunctualLight::Type::spot,
                              .position = {0, 4, 0},
                              .direction = {0, -1, 0},
                              .colour = {0, 0, 10},
                              .inner_cone = 0.09f,
                              .outer_cone = 0.1f});
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.2, 2);
    validate(b.scene);
    Renderer renderer(test_device(), b.scene, settings);
    renderer.render({0, 256}, [](const Progress&) { return true; });
    EXPECT_LT(estimated_relmse(renderer.film()), 0.05);
}

}  // namespace
}  // namespace triad::analytic
