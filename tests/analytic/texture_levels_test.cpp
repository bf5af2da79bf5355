// Pictures with levels of textures are those without, in the limit, and less noisy before.
#include <gtest/gtest.h>

#include <random>

#include "analytic_scene.h"
#include "metric/mean_test.h"

namespace triad {
namespace {

using namespace analytic;

/// A floor, a wall and a mirror with pixels of noise, far smaller than those of the picture, and a lamp:
/// colours are seen directly, mirrored, and by a bounce.
Scene noisy_room() {
    Builder b;
    Image image{"noise", 256, 256, 8, std::vector<std::uint8_t>(256 * 256 * 4)};
    std::mt19937 random(1);
    // blotches of two sizes, so that means over different areas differ
    std::vector<std::uint8_t> blotch(16 * 16);
    for (std::uint8_t& x : blotch) x = random() % 2 ? 255 : 20;
    for (std::size_t i = 0; i < 256 * 256; ++i)
        for (std::size_t c = 0; c < 4; ++c)
            image.texels[4 * i + c] = c == 1 || random() % 2 ? blotch[i / 4096 * 16 + i % 256 / 16] : 0;
    b.scene.images.push_back(std::move(image));
    b.scene.textures.push_back({});
    Material floor = lambert(0.9f), wall = lambert(0.9f), lamp = emitter(6.0f), mirror;
    floor.base_colour_texture = TextureUse{.transform = {7, 0, 0.1f, 0, 5, 0}};
    wall.base_colour_texture = TextureUse{};
    mirror.base_colour_texture = TextureUse{};
    mirror.roughness = 0.0f;
    lamp.emission_texture = TextureUse{};
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), floor);
    b.add(shapes::quad({-2, 0, -2}, {4, 0, 0}, {0, 2, 0}), wall);
    b.add(shapes::quad({-2, 0, 2}, {0, 0, -4}, {0, 2, 0}), mirror);
    b.add(shapes::quad({-0.5f, 2.2f, -0.5f}, {1, 0, 0}, {0, 0, 1}), lamp);
    return b.scene;
}

RenderSettings settings_of(bool levels) {
    RenderSettings s;
    s.width = 48, s.height = 32;
    s.texture_levels = levels;
    s.view = look_at({0.5, 1.1, 4.5}, {-0.3, 0.7, 0}, 0.9, 1.5);
    return s;
}

TileMeans means(const Scene& scene, RenderSettings settings, std::uint32_t first_seed, SampleRange samples,
                unsigned films) {
    TileMeans sum;
    for (unsigned k = 0; k < films; ++k) {
        settings.seed = first_seed + k;
        sum.add(render(test_device(), scene, settings, {samples}));
    }
    return sum;
}

TEST(TextureLevels, pictures_have_the_mean_of_those_without) {
    const auto change = [](auto&& to) {
        const TileMeans without = [&] {
            RenderSettings s = settings_of(false);
            to(s);
            return means(noisy_room(), s, 100, {0, 1024}, 4);
        }();
        RenderSettings s = settings_of(true);
        to(s);
        const MeanTest whole = test_means(means(noisy_room(), s, 1, {0, 2048}, 4), without);
        EXPECT_TRUE(whole.same) << whole.sentence;
        const MeanTest late = test_means(means(noisy_room(), s, 1, {1 << 16, (1 << 16) + 512}, 4), without);
        EXPECT_TRUE(late.same) << "late samples: " << late.sentence;
    };
    change([](RenderSettings&) {});
    change([](RenderSettings& s) {
        s.view.orthographic = true;
        s.view.extent = {3, 2};
        s.bins_x = 3;
    });
}

/// A block of glass that disperses, one half of it red and one blue, before a wall.
Scene tinted_prism() {
    Builder b;
    Image halves{"halves", 256, 256, 8, std::vector<std::uint8_t>(256 * 256 * 4, 255)};
    for (std::size_t i = 0; i < 256 * 256; ++i) halves.texels[4 * i + (i % 256 < 128 ? 2 : 0)] = 40;
    b.scene.images.push_back(std::move(halves));
    b.scene.textures.push_back({});
    Material prism = glass(1.6f);
    prism.dispersion = find_glass("SF10");
    prism.base_colour_texture = TextureUse{};
    b.add(shapes::quad({-4, -1, -1}, {8, 0, 0}, {0, 4, 0}), lambert(0.8f));
    b.add(shapes::quad({-2.5f, -0.7f, 0}, {5, 0, 0}, {0, 2.8f, 0}), prism);
    b.add(shapes::quad({-2.5f, -0.7f, -0.2f}, {0, 2.8f, 0}, {5, 0, 0}), glass(1.6f));
    b.add(shapes::quad({-4, 2.5f, -1}, {8, 0, 0}, {0, 0, 4}), emitter(6.0f));
    return b.scene;
}

TEST(TextureLevels, every_wavelength_sees_as_much_of_a_texture) {
    // The first samples, over whose share of the pixel the texture hardly changes.
    const TileMeans without = means(tinted_prism(), settings_of(false), 100, {0, 8}, 48);
    const MeanTest early = test_means(means(tinted_prism(), settings_of(true), 1, {0, 8}, 48), without);
    EXPECT_TRUE(early.same) << early.sentence;
}

/// Mean over the pixels of the squared difference from the picture of `reference`.
double error_of(const Film& film, const Film& reference) {
    double sum = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        sum += std::pow(pixel_mean(film, p)[1] - pixel_mean(reference, p)[1], 2);
    return sum / double(film.pixels());
}

TEST(TextureLevels, few_samples_have_less_noise) {
    const auto film = [](bool levels, std::uint32_t seed, unsigned spp) {
        RenderSettings s = settings_of(levels);
        s.seed = seed;
        return render(test_device(), noisy_room(), s, {{0, spp}});
    };
    const Film reference = film(false, 9, 1024);
    EXPECT_LT(error_of(film(true, 1, 1), reference), 0.9 * error_of(film(false, 1, 1), reference));
}

TEST(TextureLevels, parts_of_the_samples_make_the_same_film) {
    const RenderSettings s = settings_of(true);
    const Film once = render(test_device(), noisy_room(), s, {{0, 9}}),
               parts = render(test_device(), noisy_room(), s, {{5, 9}, {0, 2}, {2, 5}});
    EXPECT_EQ(once.sums, parts.sums);
}

}  // namespace
}  // namespace triad
