// The film as integers, and the error that it knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "base/error.h"
#include "scene/film.h"
#include "sentence_of.h"
#include "synthetic_film.h"

using namespace triad;

TEST(Film, three_uneven_ranges_in_any_order_give_the_bytes_of_one_run) {
    const TemporaryFolder folder;
    std::vector<Film> parts{synthetic({0, 5}, 3, 3), synthetic({5, 6}, 3, 3), synthetic({6, 37}, 3, 3)};
    Film whole = synthetic({0, 37}, 3, 3);
    whole.counters = {37, 3, 0, 6, 9};
    const auto expected = bytes_of(whole, folder);
    std::array<std::size_t, 3> order{0, 1, 2};
    do {
        const std::vector<Film> shuffled{parts[order[0]], parts[order[1]], parts[order[2]]};
        EXPECT_EQ(bytes_of(merge(shuffled), folder), expected);
        const std::vector<Film> later{merge(std::vector<Film>{shuffled[0], shuffled[1]}), shuffled[2]};
        EXPECT_EQ(bytes_of(merge(later), folder), expected);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Film, merging_the_same_samples_twice_is_refused_and_named) {
    const std::vector<Film> parts{synthetic({0, 8}), synthetic({6, 9})};
    expect_contains(sentence_of(Exit::incomplete, [&] { merge(parts); }), "6:8");
}

TEST(Film, merging_different_pictures_is_refused) {
    for (const auto& [change, word] : std::initializer_list<std::pair<void (*)(Film&), const char*>>{
             {[](Film& f) { f.scene = "x"; }, "scene"},
             {[](Film& f) { f.settings = "x"; }, "settings"},
             {[](Film& f) { f.quanta_log2 = 20; }, "quantum"},
             {[](Film& f) { f.x = 0; }, "crop"},
             {[](Film& f) { f.full_width = 8; }, "size"}}) {
        std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4})};
        change(parts[1]);
        expect_contains(sentence_of(Exit::scene, [&] { merge(parts); }), word);
    }
}

TEST(Film, adaptive_films_do_not_merge_and_say_why) {
    std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4})};
    parts[0].samples[3] = 4;
    expect_contains(sentence_of(Exit::scene, [&] { merge(parts); }), "adaptively");
    EXPECT_EQ(merge(std::span<const Film>(parts.data(), 1)).samples, parts[0].samples);
}

TEST(Film, sample_numbers_are_those_of_its_pixels) {
    Film film = synthetic({0, 4});
    EXPECT_TRUE(film.is_even());
    film.samples[3] = 16;
    EXPECT_FALSE(film.is_even());
    const SampleNumbers n = film.sample_numbers();
    EXPECT_EQ(n.least, 4u);
    EXPECT_EQ(n.most, 16u);
    EXPECT_EQ(n.total, 60u);
    EXPECT_DOUBLE_EQ(n.mean, 5.0);
}

TEST(Film, devices_are_sorted_and_unique_after_a_merge) {
    std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4}), synthetic({4, 5})};
    parts[0].devices = {"b"}, parts[1].devices = {"a"}, parts[2].devices = {"b"};
    EXPECT_EQ(merge(parts).devices, (std::vector<std::string>{"a", "b"}));
}

TEST(Film, holes_are_what_is_missing_below_the_end) {
    const std::vector<Film> parts{synthetic({2, 5}), synthetic({7, 8})};
    const Film film = merge(parts);
    EXPECT_EQ(film.sample_count(), 4u);
    EXPECT_EQ(holes(film, 10), (std::vector<SampleRange>{{0, 2}, {5, 7}, {8, 10}}));
    EXPECT_EQ(holes(film, 6), (std::vector<SampleRange>{{0, 2}, {5, 6}}));
    EXPECT_EQ(holes(film, 1), (std::vector<SampleRange>{{0, 1}}));
    EXPECT_TRUE(holes(synthetic({0, 4}), 4).empty());
}

TEST(Film, pixel_mean_is_the_mean_of_its_samples) {
    const Film film = synthetic({0, 18}, 3, 3);
    double sum = 0;
    for (std::uint64_t s = 0; s < 18; ++s)
        sum += double((5 * 7919 + s * 104729 + 2 * 1299709) % 1000003) * 4096.0;
    EXPECT_DOUBLE_EQ(pixel_mean(film, 5)[2], sum / 18.0 / double(1u << 30));
}

TEST(Film, pixel_mean_without_samples_is_black) {
    Film film = synthetic({0, 1});
    film.samples[3] = 0;
    EXPECT_EQ(pixel_mean(film, 3), (std::array<double, 4>{}));
}

namespace {

/// A picture with edges, texture and a gradient, whose samples are gamma-distributed: relative variance 2.5
/// each, and skewed as radiance is. Returns estimated over true relMSE.
double relmse_ratio(unsigned samples, unsigned seed) {
    constexpr double shape = 0.4;
    Film film;
    film.full_width = film.width = 40, film.full_height = film.height = 30;
    film.quanta_log2 = 30;
    film.ranges = {{0, samples}};
    film.samples.assign(film.pixels(), samples);
    std::mt19937 random(seed);
    const unsigned half = (samples + 1) / 2;
    double error = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const double x = double(p % 40), y = double(p / 40);
        const double truth = x < 20 ? 0.02 + 0.02 * y : (y < 15 ? 2.0 : 0.4 * (1.2 + std::sin(0.8 * x)));
        for (int c = 0; c < 4; ++c) {
            const double a = truth / shape * std::gamma_distribution<double>(half * shape)(random);
            const double b =
                truth / shape * std::gamma_distribution<double>((samples - half) * shape)(random);
            film.sums.push_back(std::llround(std::ldexp(a + b, 30)));
            if (c < 3) film.half_sums.push_back(std::llround(std::ldexp(a, 30)));
            const double mean = (a + b) / samples;
            if (c < 3) error += (mean - truth) * (mean - truth) / (truth * truth + 0.01);
        }
    }
    return estimated_relmse(film) / (error / (3.0 * double(film.pixels())));
}

}  // namespace

// The median over 100 seeds; its own spread is about 1 %. Fewer than 16 such samples look a little worse than
// they are.
TEST(FilmError, estimate_is_right_within_a_tenth_from_16_samples_on) {
    for (const unsigned samples : {4u, 5u, 7u, 16u, 64u, 1024u}) {
        std::vector<double> ratios;
        for (unsigned seed = 0; seed < 100; ++seed) ratios.push_back(relmse_ratio(samples, seed));
        std::nth_element(ratios.begin(), ratios.begin() + 50, ratios.end());
        EXPECT_GT(ratios[50], 0.9) << samples;
        EXPECT_LT(ratios[50], samples < 16 ? 1.2 : 1.1) << samples;
    }
}

// A pixel that went on has more samples in each half; its variance is counted by its own numbers.
TEST(FilmError, uneven_pixels_are_measured_by_their_own_halves) {
    for (const unsigned bins : {1u, 2u}) {
        const Film even = synthetic({3, 3 + 8 * bins}, bins), longer = synthetic({3, 3 + 13 * bins}, bins);
        Film film = even;
        const std::size_t p = 6, n = 4 * bins;
        std::copy_n(longer.sums.begin() + p * n, n, film.sums.begin() + p * n);
        std::copy_n(longer.half_sums.begin() + p * 3, 3, film.half_sums.begin() + p * 3);
        film.samples[p] = longer.samples[p];
        const auto found = mean_variance(film), at_even = mean_variance(even),
                   at_longer = mean_variance(longer);
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_EQ(found[i], i / 3 == p ? at_longer[i] : at_even[i]) << i;
    }
}

TEST(FilmError, the_map_of_one_set_reads_nothing_of_the_other) {
    const Film film = synthetic({0, 8});
    Film changed = film;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        if ((p % 4 ^ p / 4) & 1)
            for (std::size_t c = 0; c < 3; ++c)
                changed.sums[p * 4 + c] *= 3, changed.half_sums[p * 3 + c] *= 2;
    const auto before = error_map(film, Neighbours::own_set), after = error_map(changed, Neighbours::own_set);
    unsigned differ = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        if ((p % 4 ^ p / 4) & 1)
            differ += before[p] != after[p];
        else
            EXPECT_EQ(before[p], after[p]) << p;
    EXPECT_GT(differ, 0u);
    EXPECT_NE(error_map(film)[0], error_map(changed)[0]);
}

TEST(FilmError, is_the_mean_of_its_map) {
    const Film film = synthetic({0, 8});
    double sum = 0;
    for (const float e : error_map(film)) sum += e;
    EXPECT_DOUBLE_EQ(estimated_relmse(film), sum / double(film.pixels()));
}

TEST(FilmError, is_unknown_while_a_half_is_empty) {
    EXPECT_LT(estimated_relmse(synthetic({0, 1})), 0.0);
    EXPECT_LT(estimated_relmse(synthetic({0, 9}, 3, 3)),
              0.0);  // nine bins: the first nine samples are one half
    EXPECT_GT(estimated_relmse(synthetic({0, 10}, 3, 3)), 0.0);
}

TEST(FilmError, equal_halves_have_no_error) {
    Film film = synthetic({0, 2});
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::size_t c = 0; c < 3; ++c)
            film.half_sums[p * 3 + c] = (film.sums[p * 4 + c] &= ~std::int64_t(1)) / 2;
    EXPECT_EQ(estimated_relmse(film), 0.0);
}

TEST(FilmError, a_single_pixel_is_measured_against_itself) {
    Film film;
    film.full_width = film.width = film.full_height = film.height = 1;
    film.quanta_log2 = 10;
    film.ranges = {{0, 2}};
    film.samples = {2};
    film.sums = {4096, 4096, 4096, 2048};  // halves 1 and 3: mean 2, variance of the mean 1
    film.half_sums = {1024, 1024, 1024};
    EXPECT_NEAR(estimated_relmse(film), 1 / 4.01, 1e-7);
}
