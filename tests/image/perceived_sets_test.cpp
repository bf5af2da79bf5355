// Where adaptive sampling for a panel sends samples, and what that is worth.
#include "display/perceived_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lit_room.h"
#include "panel/perceived.h"

namespace triad::analytic {
namespace {

PanelView rgb_screen() { return {*builtin_panel("rgb"), 45}; }

/// A film of `width` x `height` grey pixels that grows sample by sample, with noise of its own in each set.
class NoisyFilm {
  public:
    using Value = double (*)(unsigned x);
    NoisyFilm(unsigned width, unsigned height, Value mean, Value noise, std::array<unsigned, 2> seeds)
        : mean_(mean), noise_(noise), random_{std::mt19937(seeds[0]), std::mt19937(seeds[1])} {
        film_.full_width = film_.width = width, film_.full_height = film_.height = height;
        film_.quanta_log2 = 20;
        film_.sums.resize(film_.pixels() * 4), film_.half_sums.resize(film_.pixels() * 3);
        film_.samples.resize(film_.pixels());
    }

    const Film& reach(unsigned n) {
        std::normal_distribution<double> normal;
        for (unsigned y = 0; y < film_.height; ++y)
            for (unsigned x = 0; x < film_.width; ++x) {
                const std::size_t p = std::size_t(y) * film_.width + x;
                for (std::uint32_t& s = film_.samples[p]; s < n; ++s) {
                    const double v = mean_(x) + noise_(x) * normal(random_[(x ^ y) & 1]);
                    for (std::size_t c = 0; c < 4; ++c)
                        film_.sums[p * 4 + c] += std::int64_t(std::ldexp(c < 3 ? v : 1.0, 20));
                    for (std::size_t c = 0; c < 3 && s % 2 == 0; ++c)
                        film_.half_sums[p * 3 + c] += std::int64_t(std::ldexp(v, 20));
                }
            }
        film_.ranges = {{0, n}};
        return film_;
    }

    /// What the sets are told after 4, 8 and 16 samples of every pixel.
    SetErrors errors() {
        DisplaySettings display;
        display.tone_map = ToneMap::none;
        PerceivedSets sets(test_device(), rgb_screen(), display);
        SetErrors errors;
        for (const unsigned n : {4u, 8u, 16u})
            errors = sets.of(reach(n), SetSamples(set_pixels(film_.width, film_.height).size(), n));
        return errors;
    }

  private:
    Film film_;
    Value mean_, noise_;
    std::array<std::mt19937, 2> random_;
};

constexpr unsigned tiles_across = 16, tiles_down = 6;

/// Mean over both sets of the tiles of columns [begin, end).
double mean_error(const SetErrors& errors, unsigned begin, unsigned end) {
    double sum = 0;
    for (unsigned y = 0; y < tiles_down; ++y)
        for (unsigned i = 2 * begin; i < 2 * end; ++i) sum += errors[y * tiles_across * 2 + i];
    return sum / (2.0 * tiles_down * (end - begin));
}

SetErrors errors_of(NoisyFilm::Value mean, NoisyFilm::Value noise, std::array<unsigned, 2> seeds = {1, 2}) {
    return NoisyFilm(8 * tiles_across, 8 * tiles_down, mean, noise, seeds).errors();
}

double grey(unsigned) { return 0.4; }
double loud_on_the_right(unsigned x) { return x < 64 ? 0.02 : 0.06; }
double bright_on_the_right(unsigned x) { return x < 64 ? 0.4 : 3.0; }
double even_noise(unsigned) { return 0.05; }

TEST(PerceivedSets, three_times_the_noise_is_nine_times_the_error) {
    const SetErrors errors = errors_of(grey, loud_on_the_right);
    EXPECT_NEAR(mean_error(errors, 10, 16) / mean_error(errors, 0, 6), 9.0, 1.5);
}

TEST(PerceivedSets, noise_that_a_display_clips_is_no_error) {
    const SetErrors errors = errors_of(bright_on_the_right, even_noise);
    EXPECT_GT(mean_error(errors, 0, 6), 0);
    EXPECT_LT(mean_error(errors, 11, 16), 1e-4 * mean_error(errors, 0, 6));
}

TEST(PerceivedSets, a_set_is_told_by_its_own_samples_alone) {
    for (const unsigned odd : {0u, 1u}) {
        const auto errors = [odd](std::array<unsigned, 2> seeds) {
            return NoisyFilm(40 + odd, 24 + odd, grey, even_noise, seeds).errors();
        };
        const SetErrors a = errors({1, 2}), b = errors({1, 3});
        for (std::size_t i = 0; i < a.size(); i += 2) {
            EXPECT_EQ(a[i], b[i]) << i;
            if (a[i + 1] > 0) {
                EXPECT_NE(a[i + 1], b[i + 1]) << i;
            }
        }
    }
}

TEST(PerceivedSets, what_got_no_samples_keeps_its_error) {
    NoisyFilm picture(16, 8, grey, even_noise, {1, 2});
    PerceivedSets sets(test_device(), rgb_screen(), {});
    EXPECT_TRUE(sets.of(picture.reach(4), SetSamples(4, 4)).empty());
    const Film film = picture.reach(8);
    const SetErrors first = sets.of(film, SetSamples(4, 8));
    EXPECT_EQ(sets.of(film, SetSamples(4, 8)), first);
}

TEST(PerceivedSets, what_was_kept_of_another_film_is_refused) {
    NoisyFilm picture(16, 8, grey, even_noise, {1, 2});
    PerceivedSets sets(test_device(), rgb_screen(), {});
    sets.of(picture.reach(4), SetSamples(4, 4));
    NoisyFilm larger(32, 8, grey, even_noise, {1, 2});
    PerceivedSets others(test_device(), rgb_screen(), {});
    others.go_on_from(sets.kept());
    EXPECT_THROW(others.of(larger.reach(8), SetSamples(8, 8)), Error);
}

/// Perceived errors of a dim room with a metal block, even or adaptive, from 144 paths per pixel; mean
/// square.
TEST(PerceivedSets, adaptive_sampling_has_less_perceived_error) {
    Scene scene = lit_room(1, false);
    validate(scene);
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.bins_x = settings.bins_y = 3;
    settings.view = look_at({0.8, 1.3, 5.2}, {0, 0.6, 0}, 0.8, 1.0);
    DisplaySettings display;
    display.exposure_ev = -1;
    const auto shown = [&](bool adaptive, unsigned spp, unsigned seed) {
        settings.seed = seed;
        Renderer renderer(test_device(), scene, settings);
        RenderGoal goal{.samples = {0, spp}, .adaptive = adaptive};
        if (adaptive) goal.set_errors = perceived_sets(test_device(), rgb_screen(), display);
        renderer.render_until(goal, [](const Progress&) { return true; });
        const Film film = renderer.film();
        EXPECT_NEAR(film.sample_numbers().mean, spp, 1);
        EXPECT_NE(film.is_even(), adaptive);
        const std::vector<float> rgba = resolve_display(test_device(), film, display);
        RgbImage image{film.width, film.height, std::vector<float>(film.pixels() * 3)};
        for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = rgba[i / 3 * 4 + i % 3];
        return image;
    };
    const RgbImage picture = shown(false, 9 * 256, 99);
    const auto error = [&](bool adaptive, unsigned seed) {
        RgbImage difference = shown(adaptive, 144, seed);
        for (std::size_t i = 0; i < difference.rgb.size(); ++i) difference.rgb[i] -= picture.rgb[i];
        return std::pow(perceived_difference(rgb_screen().panel, difference, {.ppd = 45, .border = 0}), 2);
    };
    double even = 0, adaptive = 0;
    for (unsigned seed = 0; seed < 4; ++seed) even += error(false, seed), adaptive += error(true, seed);
    EXPECT_LT(adaptive, 0.75 * even);
}

}  // namespace
}  // namespace triad::analytic
