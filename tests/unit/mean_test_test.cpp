// Is the mean of some films the reference's picture? Of equal pictures that is seldom denied, whatever their
// noise.
#include "metric/mean_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace triad {
namespace {

constexpr unsigned width = 48, height = 32;

/// Samples of a gradient: bright with probability p, else black, times `factor` in the left 16 columns.
Film make_film(unsigned spp, unsigned seed, double p, double factor = 1.0) {
    std::mt19937 random(seed);
    Film film;
    film.full_width = film.width = width, film.full_height = film.height = height;
    film.quanta_log2 = 20;
    film.ranges = {{0, spp}};
    film.samples.assign(film.pixels(), spp);
    for (std::size_t i = 0; i < film.pixels(); ++i) {
        const double level = (0.2 + double(i % width) / width) * (i % width < 16 ? factor : 1.0);
        for (int c = 0; c < 4; ++c) {
            std::binomial_distribution<int> half(int(spp / 2), p);
            const double a = half(random) * level / p, b = half(random) * level / p;
            film.sums.push_back(std::int64_t((a + b) * 0x1p20));
            if (c < 3) film.half_sums.push_back(std::int64_t(a * 0x1p20));
        }
    }
    return film;
}

TileMeans means(unsigned films, unsigned spp, unsigned seed, double p, double factor = 1.0) {
    TileMeans tiles;
    for (unsigned i = 0; i < films; ++i) tiles.add(make_film(spp, seed + i, p, factor));
    return tiles;
}

TEST(MeanTest, equal_pictures_are_the_same) {
    // At a family of 5 %, so that the rate can be seen: 80 tests each, 4 expected, deviation 1.9.
    for (const double p : {0.5, 0.02, 0.0003}) {
        int denied = 0;
        for (unsigned i = 0; i < 80; ++i)
            denied += !test_means(means(3, 16, 1000 * i, p), means(1, 64, 1000 * i + 500, p), 0.05).same;
        EXPECT_LE(denied, 13) << p;
        if (p == 0.5) {
            EXPECT_GE(denied, 1);
        }
    }
}

TEST(MeanTest, a_few_per_cent_in_one_column_of_tiles_are_found) {
    const TileMeans reference = means(1, 1024, 1, 0.3);
    EXPECT_TRUE(test_means(means(5, 64, 10, 0.3), reference).same);
    const MeanTest wrong = test_means(means(5, 64, 10, 0.3, 0.96), reference);
    EXPECT_FALSE(wrong.same);
    EXPECT_TRUE(wrong.sentence.starts_with("Not the reference's picture; least probable: "))
        << wrong.sentence;
}

TEST(MeanTest, values_without_noise_may_differ_by_rounding_alone) {
    EXPECT_TRUE(test_means(means(2, 16, 1, 1.0), means(1, 16, 2, 1.0)).same);
    EXPECT_FALSE(test_means(means(2, 16, 1, 1.0, 1.001), means(1, 16, 2, 1.0)).same);
}

TEST(MeanTest, wants_films_of_one_size_with_two_halves) {
    Film other = make_film(16, 1, 0.5);
    other.height /= 2;
    other.samples.resize(other.pixels()), other.sums.resize(other.pixels() * 4),
        other.half_sums.resize(other.pixels() * 3);
    TileMeans tiles = means(1, 16, 1, 0.5);
    EXPECT_THROW(tiles.add(other), std::invalid_argument);
    EXPECT_THROW(test_means(tiles, {}), std::invalid_argument);
}

}  // namespace
}  // namespace triad
