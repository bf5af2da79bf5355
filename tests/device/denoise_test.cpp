// The denoiser on films whose truth is known.
#include "display/denoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "device_fixture.h"
#include "kernels/types.h"

using namespace triad;

namespace {

constexpr unsigned width = 75, height = 41, samples = 16;  // no multiple of any vector

/// A floor of light and dark tiles in a light that fades, and a wall: [pixel][R, G, B].
struct Truth {
    std::vector<double> colour;
    std::vector<float> guides;
};

Truth floor_and_wall() {
    Truth truth;
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const bool floor = y > height / 2;
            const double albedo = floor ? ((x / 5 + y / 5) % 2 ? 0.8 : 0.1) : 0.5;
            const double light = 0.3 + 2.0 * std::exp(-std::hypot(x - 20.0, y - 15.0) / 20);
            for (const double tint : {1.0, 0.8, 0.5}) truth.colour.push_back(albedo * light * tint);
            for (int c = 0; c < 3; ++c) truth.guides.push_back(float(albedo));
            for (const float n : {0.0f, floor ? 1.0f : 0.0f, floor ? 0.0f : 1.0f}) truth.guides.push_back(n);
            truth.guides.push_back(floor ? 4.0f + float(height - y) * 0.1f : 8.0f);
        }
    return truth;
}

/// Halves of `samples` with noise of that standard deviation per sample, relative.
Film noisy_film(const Truth& truth, double deviation) {
    Film film;
    film.full_width = film.width = width, film.full_height = film.height = height;
    film.quanta_log2 = 24;
    film.samples.assign(film.pixels(), samples);
    film.ranges = {{0, samples}};
    film.guides = truth.guides, film.has_guides = true;
    std::mt19937 random(7);
    std::gamma_distribution<double> gamma(deviation > 0 ? 1 / (deviation * deviation) : 1,
                                          deviation * deviation);
    const double unit = std::ldexp(1.0, film.quanta_log2);
    for (std::size_t i = 0; i < film.pixels(); ++i) {
        double sums[4] = {0, 0, 0, 0.5 * samples}, half[3] = {};
        for (unsigned s = 0; s < samples; ++s) {
            const double factor = deviation > 0 ? gamma(random) : 1;
            for (int c = 0; c < 3; ++c) {
                sums[c] += truth.colour[3 * i + c] * factor;
                if (s % 2 == 0) half[c] += truth.colour[3 * i + c] * factor;
            }
        }
        for (const double sum : sums) film.sums.push_back(std::llround(sum * unit));
        for (const double sum : half) film.half_sums.push_back(std::llround(sum * unit));
    }
    return film;
}

/// The film with that many bins in a row per pixel, of 1.5, .5, 1.5, ... times its value.
Film in_bins(const Film& film, unsigned bins) {
    Film split = film;
    split.bins_x = bins, split.sums.clear();
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (unsigned bin = 0; bin < bins; ++bin)
            for (std::size_t c = 0; c < 4; ++c)
                split.sums.push_back(film.sums[4 * p + c] * (bin % 2 == 0 ? 3 : 1) / (2 * bins));
    return split;
}

double relmse(const std::vector<float>& rgba, const Truth& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.colour.size(); ++i) {
        const double r = truth.colour[i], x = rgba[i / 3 * 4 + i % 3];
        sum += (x - r) * (x - r) / (r * r + 0.01);
    }
    return sum / double(truth.colour.size());
}

}  // namespace

TEST(Denoise, takes_most_of_the_noise_and_leaves_edges) {
    const Truth truth = floor_and_wall();
    const Film film = noisy_film(truth, 1.0);
    const double before = relmse(resolve_linear(film), truth);
    EXPECT_NEAR(before, 1.0 / samples, 0.02);
    const std::vector<float> after = denoised(test_device(), film, Denoiser::own).rgba;
    EXPECT_LT(relmse(after, truth), before / 6);
    for (std::size_t i = 3; i < after.size(); i += 4) ASSERT_EQ(after[i], 0.5f) << "alpha";
}

// Single samples of a light that hardly any finds, in either half; and a lamp, which all find.
TEST(Denoise, sparks_go_and_lamps_stay) {
    Truth truth = floor_and_wall();
    const std::size_t lamp = 9 * width + 50;
    for (std::size_t c = 0; c < 3; ++c) truth.colour[3 * lamp + c] = 300;
    const Film clean = noisy_film(truth, 0.5);
    const auto with_sparks = [&](const std::vector<std::size_t>& places) {
        Film film = clean;
        const std::int64_t spark = std::int64_t(5000) << film.quanta_log2;
        for (const std::size_t p : places)
            for (std::size_t c = 0; c < 3; ++c) {
                film.sums[4 * p + c] += spark;
                if (p % 2 == 0) film.half_sums[3 * p + c] += spark;
            }
        EXPECT_GT(relmse(resolve_linear(film), truth), 10);
        return film;
    };
    const Film inside = with_sparks({5 * width + 7, 20 * width + 33, 35 * width + 60}),
               corners = with_sparks({0, height * width - 1});
    const std::vector<float> after = denoised(test_device(), inside, Denoiser::own).rgba,
                             without = denoised(test_device(), clean, Denoiser::own).rgba;
    EXPECT_LT(relmse(after, truth), 1.5 * relmse(without, truth));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[4 * lamp + c], 300, 60);
    EXPECT_LT(relmse(denoised(test_device(), corners, Denoiser::own).rgba, truth), 0.05);
    const std::vector<float> bins = denoised(test_device(), in_bins(corners, 2), Denoiser::own).rgba;
    EXPECT_LT(*std::max_element(bins.begin(), bins.begin() + 40), 10) << "the first of them";
}

TEST(Denoise, works_without_guides_by_colours_alone) {
    const Truth truth = floor_and_wall();
    Film film = noisy_film(truth, 0.5);
    film.guides.clear(), film.has_guides = false;
    EXPECT_LT(relmse(denoised(test_device(), film, Denoiser::own).rgba, truth),
              relmse(resolve_linear(film), truth) / 2);
}

TEST(Denoise, leaves_what_has_no_noise) {
    const Truth truth = floor_and_wall();
    EXPECT_LT(relmse(denoised(test_device(), noisy_film(truth, 0), Denoiser::own).rgba, truth), 1e-9);
}

TEST(Denoise, lanes_do_not_change_the_picture) {
    const Truth truth = floor_and_wall();
    const Film film = noisy_film(truth, 1.0);
    const std::vector<float> sixteen = denoised(test_device(), film, Denoiser::own, 16).rgba,
                             one = denoised(test_device(), film, Denoiser::own, 1).rgba;
    ASSERT_EQ(sixteen.size(), one.size());
    // exp of vectors and of scalars may round differently, and a choice between equals may turn.
    double worst = 0, mean = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double difference = std::abs(double(sixteen[i]) - one[i]);
        worst = std::max(worst, difference), mean += difference / double(one.size());
    }
    EXPECT_LT(mean, 1e-4);
    EXPECT_LT(worst, 0.1);
}

TEST(Denoise, a_picture_of_one_pixel_and_one_of_one_row) {
    for (const auto& [w, h] : {std::pair{1u, 1u}, {40u, 1u}, {1u, 40u}}) {
        Film film = noisy_film(floor_and_wall(), 0.5);
        film.width = film.full_width = w, film.height = film.full_height = h;
        film.sums.resize(film.pixels() * 4), film.half_sums.resize(film.pixels() * 3);
        film.samples.resize(film.pixels()), film.guides.resize(film.pixels() * DENOISE_GUIDES);
        for (const float value : denoised(test_device(), film, Denoiser::own).rgba)
            ASSERT_TRUE(std::isfinite(value));
    }
}

TEST(Denoise, films_that_do_not_know_their_noise_are_refused) {
    Film film = noisy_film(floor_and_wall(), 0.5);
    film.samples[5] = 1;
    EXPECT_THROW(denoised(test_device(), film, Denoiser::own), Error);
    film = noisy_film(floor_and_wall(), 0.5);
    film = in_bins(film, 2);
    EXPECT_THROW(denoised(test_device(), film, Denoiser::oidn), Error);
    film.samples[5] = 3;
    EXPECT_THROW(denoised(test_device(), film, Denoiser::own), Error);
}

TEST(Denoise, bins_keep_their_places_and_what_they_differ_by) {
    const Truth truth = floor_and_wall();
    const Film film = in_bins(noisy_film(truth, 1.0), 2);
    const BinImage image = denoised(test_device(), film, Denoiser::own);
    ASSERT_EQ(image.columns, 2 * width);
    ASSERT_EQ(image.rows, height);
    std::vector<float> mean(film.pixels() * 4);
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::size_t c = 0; c < 4; ++c) {
            const float left = image.rgba[8 * p + c], right = image.rgba[8 * p + 4 + c];
            ASSERT_NEAR(left, 3 * right, 1e-4f * (1 + left)) << "a filter is linear";
            mean[4 * p + c] = 0.5f * (left + right);
        }
    EXPECT_LT(relmse(mean, truth), relmse(resolve_linear(film), truth) / 6);
}
