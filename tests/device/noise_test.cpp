// Tone maps of films whose bins hold few rays: noise keeps its mean, edges stay tame, and what has converged
// is what it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "device_fixture.h"
#include "display/reconstruction.h"

using namespace triad;

namespace {

constexpr unsigned width = 40, height = 24;

/// 3 x 3 bins of `rays` each, whose means are those of `colour(x, y)`, in bins. The halves are alike.
Film film_of(unsigned rays, const std::function<vec3(unsigned, unsigned)>& colour) {
    Film film;
    film.full_width = film.width = width, film.full_height = film.height = height;
    film.bins_x = film.bins_y = 3;
    film.quanta_log2 = 24;
    film.samples.assign(film.pixels(), rays * 9);
    film.ranges = {{0, rays * 9}};
    film.sums.resize(film.pixels() * 36);
    film.half_sums.resize(film.pixels() * 3);
    const double unit = std::ldexp(double(rays), film.quanta_log2);
    for (unsigned y = 0; y < height * 3; ++y)
        for (unsigned x = 0; x < width * 3; ++x) {
            const vec3 c = colour(x, y);
            const std::size_t bin = (y / 3 * width + x / 3) * 9 + y % 3 * 3 + x % 3;
            for (int i = 0; i < 3; ++i) {
                film.sums[bin * 4 + i] = std::int64_t(double(c[i]) * unit);
                film.half_sums[bin / 9 * 3 + i] += film.sums[bin * 4 + i] / rays * ((rays + 1) / 2);
            }
            film.sums[bin * 4 + 3] = std::int64_t(unit);
        }
    return film;
}

/// Most rays find nothing; the others are bright.
Film noise(unsigned rays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any;
    return film_of(rays,
                   [&](unsigned, unsigned) { return vec3(any(random) < 0.25f ? 8.0f * any(random) : 0); });
}

/// Halves that differ by as much as the mean.
Film halves_apart(Film film) {
    for (std::size_t i = 0; i < film.half_sums.size(); ++i)
        film.half_sums[i] += film.half_sums[i] / 2 * (i / 3 % 2 ? 1 : -1);
    return film;
}

/// Means of `rays` rays, half of which find nothing.
Film mean_noise(unsigned rays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any;
    return film_of(rays, [&](unsigned, unsigned) {
        float sum = 0;
        for (unsigned i = 0; i < rays; ++i) sum += any(random) < 0.5f ? 4.0f * any(random) : 0;
        return vec3(sum / float(rays));
    });
}

/// Bins of `rays` rays of 1 on average, exponentially distributed, every second one in the first half.
Film exponential(unsigned rays) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any;
    std::vector<float> halves;
    Film film = film_of(rays, [&](unsigned, unsigned) {
        std::array<float, 2> sums{};
        for (unsigned i = 0; i < rays; ++i) sums[i % 2] -= std::log(1.0f - any(random));
        halves.push_back(sums[0]);
        return vec3((sums[0] + sums[1]) / float(rays));
    });
    film.half_sums.assign(film.half_sums.size(), 0);
    for (std::size_t bin = 0; bin < halves.size(); ++bin) {
        const std::size_t pixel = bin / (9 * width) * width + bin % (3 * width) / 3;
        for (int c = 0; c < 3; ++c)
            film.half_sums[pixel * 3 + c] += std::llround(std::ldexp(halves[bin], film.quanta_log2));
    }
    return film;
}

std::vector<float> shown(const Film& film, ToneOrder order) {
    return resolve_display(test_device(), film, {.order = order, .alpha = false});
}

double mean_of(const std::vector<float>& rgba) {
    double sum = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) sum += rgba[i];
    return sum / (double(rgba.size()) / 4);
}

double greatest_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double(a[i]) - b[i]));
    return most;
}

}  // namespace

TEST(Noise, of_single_rays_does_not_darken) {
    const Film film = noise(1);
    const double pixel = mean_of(shown(film, ToneOrder::per_pixel));
    const double bins = mean_of(shown(film, ToneOrder::per_bin));
    EXPECT_LT(bins, 0.8 * pixel) << "or there is nothing to mend";
    EXPECT_NEAR(mean_of(shown(film, ToneOrder::noise_aware)), pixel, 0.15 * (pixel - bins));
}

TEST(Noise, is_believed_less_the_more_rays_there_are) {
    const std::vector<float> bins = shown(noise(1), ToneOrder::per_bin);
    double before = 1;
    for (const unsigned rays : {1u, 4u, 16u, 10000u}) {
        const double left = greatest_difference(shown(noise(rays), ToneOrder::noise_aware), bins);
        EXPECT_LT(left, before) << rays;
        before = left;
    }
    EXPECT_LT(before, 0.02);
}

TEST(Noise, of_many_rays_does_not_darken_either) {
    for (const unsigned rays : {4u, 16u, 64u}) {
        const Film film = mean_noise(rays);
        const double pixel = mean_of(shown(film, ToneOrder::per_pixel));
        const double bins = mean_of(shown(film, ToneOrder::per_bin));
        EXPECT_GT(pixel - bins, 0.1 / rays) << "or there is nothing to mend";
        EXPECT_NEAR(mean_of(shown(film, ToneOrder::noise_aware)), pixel, 0.2 * (pixel - bins)) << rays;
    }
}

TEST(Noise, of_whole_pixels_darkens_less) {
    // Alone, a pixel's mean is noisy too: tangents there lose another 5 % of what bins lose.
    for (const unsigned rays : {1u, 4u}) {
        const Film film = mean_noise(rays);
        const auto mean = [&](ToneOrder order) {
            return mean_of(resolve_display(
                test_device(), film,
                {.exposure_ev = -1, .tone_map = ToneMap::agx, .order = order, .alpha = false}));
        };
        const double pixel = mean(ToneOrder::per_pixel), bins = mean(ToneOrder::per_bin);
        EXPECT_GT(mean(ToneOrder::noise_aware), pixel - 0.03 * (pixel - bins)) << rays;
    }
}

TEST(Noise, of_pixels_is_given_back_what_it_takes_from_their_tone_mapped_mean) {
    const Film even = film_of(1, [](unsigned, unsigned) { return vec3(1.0f); });
    const double truth = mean_of(shown(even, ToneOrder::per_pixel));
    for (const unsigned rays : {1u, 4u, 16u}) {
        const Film film = exponential(rays);
        const double pixel = mean_of(shown(film, ToneOrder::per_pixel));
        EXPECT_LT(pixel, truth - 0.04 / rays) << "or there is nothing to give back";
        const double back = (mean_of(shown(film, ToneOrder::noise_aware)) - pixel) / (truth - pixel);
        // Of single rays there are no halves of the samples, and nine are few.
        EXPECT_GT(back, rays == 1 ? 0.2 : 0.4) << rays;
        EXPECT_LT(back, 1.0) << rays;
    }
}

TEST(Noise, is_evened_out_within_pixels_and_fine_lines_are_not) {
    const auto fringes = [](const Film& film, ToneOrder order) {
        ReconstructionChoice choice;
        choice.panel = PanelView{*builtin_panel("rgb"), 45};
        DisplaySettings settings;
        apply(reconstruction_of(choice), settings);
        settings.tone_map = ToneMap::none, settings.refine.reset(), settings.order = order;
        const auto drives = resolve_display(test_device(), film, settings);
        double squares = 0;
        for (std::size_t i = 0; i < drives.size(); i += 4) squares += std::pow(drives[i] - drives[i + 2], 2);
        return std::sqrt(squares / (double(drives.size()) / 4));
    };
    std::mt19937 random(11);
    std::uniform_real_distribution<float> any(0.2f, 0.6f);
    const Film grey = film_of(1, [&](unsigned, unsigned) { return vec3(any(random)); }),
               lines = film_of(64, [](unsigned x, unsigned) { return vec3(x % 5 < 2 ? 0.6f : 0.2f); });
    EXPECT_LT(fringes(grey, ToneOrder::noise_aware), 0.65 * fringes(grey, ToneOrder::per_bin));
    EXPECT_GT(fringes(lines, ToneOrder::noise_aware), 0.95 * fringes(lines, ToneOrder::per_bin));
}

TEST(Noise, is_not_what_no_so_many_rays_can_bring) {
    // The same bins, be they of four rays or of 64: as rough as noise, too rough for 64.
    const auto bins = shown(noise(1), ToneOrder::per_bin), pixels = shown(noise(1), ToneOrder::per_pixel);
    const double whole = mean_of(pixels) - mean_of(bins);
    const auto believed = [&](unsigned rays) {
        return (mean_of(shown(noise(rays), ToneOrder::noise_aware)) - mean_of(bins)) / whole;
    };
    EXPECT_GT(believed(1), 0.85);
    EXPECT_LT(believed(16), 0.15);
    EXPECT_LT(believed(64), 0.04);
}

TEST(Noise, of_bright_rays_is_believed_where_the_halves_differ) {
    const Film film = noise(16);
    const double pixel = mean_of(shown(film, ToneOrder::per_pixel)),
                 bins = mean_of(shown(film, ToneOrder::per_bin)),
                 alike = mean_of(shown(film, ToneOrder::noise_aware)),
                 apart = mean_of(shown(halves_apart(film), ToneOrder::noise_aware));
    EXPECT_LT(alike - bins, 0.15 * (pixel - bins));
    EXPECT_GT(apart - bins, 0.75 * (pixel - bins));
}

TEST(Noise, is_not_seen_in_the_edges_of_lamps) {
    // Bright bins beside dark ones, cutting through pixels.
    const Film film = film_of(1, [](unsigned x, unsigned y) { return vec3(x + y / 2 < 61 ? 200.0f : 0.1f); });
    const auto bins = shown(film, ToneOrder::per_bin), pixels = shown(film, ToneOrder::per_pixel),
               both = shown(film, ToneOrder::noise_aware);
    EXPECT_GT(greatest_difference(bins, pixels), 0.5);
    double squares = 0, whole = 0;
    for (std::size_t i = 0; i < bins.size(); i += 4)
        squares += std::pow(both[i] - bins[i], 2), whole += std::pow(pixels[i] - bins[i], 2);
    EXPECT_LT(std::sqrt(squares / whole), 0.4);
}

TEST(Noise, changes_no_constant_on_any_panel) {
    for (const Panel& panel : builtin_panels())
        for (const float level : {0.0f, 0.3f, 1.0f}) {
            ReconstructionChoice choice;
            choice.panel = PanelView{panel, 45};
            DisplaySettings settings;
            settings.tone_map = ToneMap::none;
            apply(reconstruction_of(choice), settings);
            ASSERT_EQ(settings.order, ToneOrder::noise_aware);
            const Film film = film_of(1, [&](unsigned, unsigned) { return vec3(level); });
            const auto drives = resolve_display(test_device(), film, settings);
            for (std::size_t i = 0; i < drives.size(); ++i)
                ASSERT_NEAR(drives[i], i % 4 == 3 ? 1.0f : level, 1e-6) << panel.name;
        }
}

TEST(Noise, of_a_million_or_without_end_gives_drives) {
    for (const float bright : {1e6f, 8e9f}) {
        std::mt19937 random(5);
        const Film film =
            film_of(1, [&](unsigned, unsigned) { return vec3(random() % 20 ? 0.01f : bright); });
        for (const ToneMap map : {ToneMap::none, ToneMap::khronos, ToneMap::aces, ToneMap::agx})
            for (const float exposure : {0.0f, 64.0f})
                for (const float v : resolve_display(
                         test_device(), film,
                         {.exposure_ev = exposure, .tone_map = map, .order = ToneOrder::noise_aware}))
                    ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << v;
    }
}

TEST(Noise, is_weighed_alike_in_pieces_of_little_memory) {
    ReconstructionChoice choice;
    choice.panel = PanelView{*builtin_panel("rgb"), 45};
    DisplaySettings settings;
    apply(reconstruction_of(choice), settings);
    settings.refine.reset();
    Device small = limited_device(192 * 1024);
    for (const Film& film : {noise(1), halves_apart(noise(16))})
        EXPECT_EQ(resolve_display(small, film, settings), resolve_display(test_device(), film, settings));
}
