// Where adaptive sampling sends samples, and that it does not bias the picture.
#include "render/adaptive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "base/parallel_for.h"

using namespace triad;

namespace {

/// A film of which only the size matters.
Film sized(unsigned width, unsigned height) {
    Film film;
    film.full_width = film.width = width, film.full_height = film.height = height;
    return film;
}

std::size_t set_of(const Film& film, std::size_t x, std::size_t y) {
    return 2 * (y / 8 * ((film.width + 7) / 8) + x / 8) + ((x ^ y) & 1);
}

double mean_of(const Film& film, const SetSamples& samples) {
    const auto pixels = set_pixels(film.width, film.height);
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) sum += double(pixels[i]) * samples[i];
    return sum / double(film.pixels());
}

SetSamples distribute_by(const Film& film, const std::vector<float>& errors, const SetSamples& have,
                         double mean, unsigned step, double dearer = 1) {
    return distribute(film.width, film.height, relmse_of_sets(film, errors, have), have, mean, step, dearer)
        .samples;
}

/// Over tiles [from, to) of each row of a picture of 128 pixels.
double mean_of_columns(const SetSamples& samples, std::size_t from, std::size_t to) {
    double sum = 0, sets = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (i / 2 % 16 >= from && i / 2 % 16 < to) sum += samples[i], sets += 1;
    return sum / sets;
}

/// A power of two, or one and a half times that.
bool is_well_placed(std::uint32_t n) {
    return std::has_single_bit(n) || (n % 3 == 0 && std::has_single_bit(n / 3));
}

/// A picture that is built up sample by sample: a pixel is bright with a probability, rarely on the left, and
/// less rarely on the right.
class Fireflies {
  public:
    static constexpr unsigned width = 16, height = 16;
    static double probability(std::size_t x) { return x < width / 2 ? 0.002 : 0.02; }

    explicit Fireflies(unsigned seed) : random_(seed) {
        film_ = sized(width, height);
        film_.quanta_log2 = 20;
        film_.sums.assign(film_.pixels() * 4, 0);
        film_.half_sums.assign(film_.pixels() * 3, 0);
        film_.samples.assign(film_.pixels(), 0);
        have_.assign(set_pixels(width, height).size(), 0);
    }

    void reach(const SetSamples& wanted) {
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t p = y * width + x, set = set_of(film_, x, y);
                const unsigned half = (wanted[set] - have_[set]) / 2;
                for (int which = 0; which < 2; ++which) {
                    std::binomial_distribution<unsigned> hits(half, probability(x));
                    const auto sum = std::int64_t(std::ldexp(hits(random_) / probability(x), 20));
                    for (std::size_t c = 0; c < 4; ++c) film_.sums[4 * p + c] += sum;
                    for (std::size_t c = 0; c < 3 && which == 0; ++c) film_.half_sums[3 * p + c] += sum;
                }
                film_.samples[p] = wanted[set];
            }
        have_ = wanted;
        film_.ranges = {{0, *std::min_element(have_.begin(), have_.end())}};
    }

    /// Eight samples for all, then doubled three times. `own`: let every set decide for itself.
    void render(bool own) {
        reach(SetSamples(have_.size(), 8));
        for (const double mean : {16.0, 32.0, 64.0}) {
            std::vector<float> errors = error_map(film_, Neighbours::own_set);
            if (own)  // the neighbour's place is in the other set of the same tile
                for (std::size_t p = 0; p < errors.size(); p += 2) std::swap(errors[p], errors[p + 1]);
            reach(distribute(width, height, relmse_of_sets(film_, errors, have_), have_, mean, 2, 1e-3)
                      .samples);  // so cheap: always
        }
    }

    const Film& film() const { return film_; }
    /// Of the whole picture; the truth is 1.
    double mean() const {
        double sum = 0;
        for (std::size_t p = 0; p < film_.pixels(); ++p) sum += pixel_mean(film_, p)[0];
        return sum / double(film_.pixels());
    }

  private:
    std::mt19937 random_;
    Film film_;
    SetSamples have_;
};

/// Mean over seeds, and how many standard errors it is from the truth.
std::pair<double, double> bias(bool own, unsigned seeds) {
    set_host_threads(1);  // starting threads takes longer than such a picture
    double sum = 0, squares = 0;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        Fireflies picture(seed);
        picture.render(own);
        const double error = picture.mean() - 1;
        sum += error, squares += error * error;
    }
    set_host_threads(0);
    const double mean = sum / seeds, variance = (squares / seeds - mean * mean) / (seeds - 1);
    return {mean, mean / std::sqrt(variance)};
}

}  // namespace

// Over 8000 seeds of a picture that has hardly found its bright paths: its relMSE is 4. A standard error is
// .14 % of the mean. (Where a tile has found next to nothing, at a relMSE of 16, later rounds are off by 4 %
// of the mean, and sets that decide for themselves by 17 %: docs/error.md.)
TEST(Adaptive, does_not_bias_the_mean) {
    const auto [mean, z] = bias(false, 8000);
    EXPECT_LT(std::abs(z), 4.9) << mean;  // 1e-6
}

TEST(Adaptive, the_test_of_bias_finds_sets_that_decide_for_themselves) {
    const auto [mean, z] = bias(true, 8000);
    EXPECT_LT(z, -4.9) << mean;
    EXPECT_LT(mean, -0.005);
}

TEST(Adaptive, samples_go_as_the_square_root_of_the_noise) {
    const Film film = sized(128, 64);
    std::vector<float> errors(film.pixels());
    for (std::size_t p = 0; p < errors.size(); ++p) errors[p] = p % 128 < 64 ? 1.0f : 9.0f;
    const SetSamples have(2 * 16 * 8, 16), given = distribute_by(film, errors, have, 40, 2, 0.5);
    EXPECT_NEAR(mean_of(film, given), 40, 0.01);
    EXPECT_NEAR(mean_of_columns(given, 1, 7), 20, 2);  // far from the border, 1 : 3
    EXPECT_NEAR(mean_of_columns(given, 9, 15), 60, 2);
    for (std::size_t i = 0; i + 2 < given.size(); ++i)  // the last two take what is left
        EXPECT_TRUE(is_well_placed(given[i])) << given[i];
}

TEST(Adaptive, samples_go_everywhere_where_noise_promises_too_little) {
    const Film film = sized(128, 64);
    std::vector<float> errors(film.pixels());
    for (std::size_t p = 0; p < errors.size(); ++p) errors[p] = p % 128 < 64 ? 1.0f : 2.0f;
    const SetSamples have(2 * 16 * 8, 16);
    const SetErrors s = relmse_of_sets(film, errors, have);
    const Distribution given = distribute(128, 64, s, have, 40, 2);
    EXPECT_FALSE(given.by_noise);
    EXPECT_EQ(given.samples, SetSamples(2 * 16 * 8, 40));

    for (std::size_t p = 0; p < errors.size(); ++p) errors[p] = p % 128 < 96 ? 1.0f : 9.0f;
    const SetErrors noisy = relmse_of_sets(film, errors, have);
    EXPECT_TRUE(distribute(128, 64, noisy, have, 24, 2).by_noise);
    EXPECT_FALSE(distribute(128, 64, noisy, have, 24, 2, 2.5).by_noise) << "they are too dear";
    const SetSamples uneven = distribute(128, 64, noisy, have, 24, 2).samples;
    EXPECT_EQ(distribute(128, 64, s, uneven, 64, 2, 10).samples, SetSamples(2 * 16 * 8, 64)) << "even again";
}

TEST(Adaptive, even_samples_go_on_to_a_power_of_two_where_noise_promises_little_more) {
    const Film film = sized(128, 64);
    std::vector<float> errors(film.pixels());
    for (std::size_t p = 0; p < errors.size(); ++p) errors[p] = p % 128 < 88 ? 1.0f : 9.0f;
    const auto by_noise = [&](std::uint32_t had, double mean) {
        const SetSamples have(2 * 16 * 8, had);
        return distribute(128, 64, relmse_of_sets(film, errors, have), have, mean, 2, 1.3).by_noise;
    };
    EXPECT_TRUE(by_noise(64, 80));
    EXPECT_TRUE(by_noise(96, 108));
    EXPECT_FALSE(by_noise(96, 120)) << "from where 128 is near";
    EXPECT_FALSE(by_noise(96, 127)) << "where some sets come to it by rounding";
    EXPECT_FALSE(by_noise(96, 128));
    EXPECT_TRUE(by_noise(128, 160));
}

TEST(Adaptive, no_set_loses_starves_or_takes_all) {
    const Film film = sized(61, 37);
    std::vector<float> errors(film.pixels(), 1e-9f);
    errors[20 * 61 + 30] = 1.0f;
    SetSamples have(2 * 8 * 5, 8);
    have[7] = 50;
    const auto pixels = set_pixels(61, 37);
    const SetSamples given = distribute_by(film, errors, have, 40, 6);
    for (std::size_t i = 0; i < have.size(); ++i) {
        EXPECT_GE(given[i], have[i]);
        EXPECT_EQ((given[i] - have[i]) % 6, 0u);
        EXPECT_LE(given[i], 4 * have[i] + 6);
        EXPECT_TRUE(pixels[i] < 32 || given[i] >= 10u - 6) << i;
    }
}

TEST(Adaptive, what_rounding_leaves_over_is_no_sets_alone) {
    const Film film = sized(480, 272);
    std::vector<float> errors(film.pixels());
    for (std::size_t p = 0; p < errors.size(); ++p) errors[p] = p / 480 >= 248 ? 4.0f : 0.001f;
    for (const std::uint32_t had : {22u, 40u, 64u, 100u}) {
        const SetSamples have(2 * 60 * 34, had);
        const SetErrors s = relmse_of_sets(film, errors, have);
        const Distribution given = distribute(480, 272, s, have, 2 * had, 2);
        EXPECT_TRUE(given.by_noise);
        EXPECT_LE(*std::ranges::max_element(given.samples), 4 * had) << had;
        EXPECT_EQ(given.samples[2 * 60 * 33 + 60], 4 * had) << "a noisy one";
    }
}

TEST(Adaptive, something_is_given_even_when_it_is_less_than_a_step) {
    const Film film = sized(9, 1);  // the second tile has one pixel: its other set has none
    const std::vector<float> errors(film.pixels(), 1.0f);
    const SetSamples have(4, 8), given = distribute_by(film, errors, have, 8.001, 2);
    EXPECT_NE(given, have);
    EXPECT_GT(mean_of(film, given), 8);
}

TEST(Adaptive, sets_have_the_pixels_of_their_colour) {
    const auto pixels = set_pixels(9, 10);
    EXPECT_EQ(pixels, (std::vector<std::uint32_t>{32, 32, 4, 4, 8, 8, 1, 1}));
}
