// The sampler: uniform, stratified as Sobol's sequence must be, and without correlation between any two
// names.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/math.h"
#include "device_fixture.h"

using namespace triad;

namespace {

const char* const source = R"(#include "common/random.h"
__kernel void sample(__global uint2* out, uint pixel, uint pixel_step, uint index, uint index_step, uint high,
                     uint stream, uint seed, uint set, uint set_step, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Sampler s = sampler_make(pixel + i * pixel_step, index + i * index_step, high, stream, seed);
    out[i] = sampler_2d_bits(&s, set + i * set_step);
}
__kernel void sobol(__global uint2* out, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = (uint2)(random_reverse_bits(i), random_reverse_bits4(random_sobol1_reversed((uint4)(i))).x);
}
__kernel void to_float(__global float* out, uint first, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = random_float(first + i);
}
)";

using Pair = std::array<std::uint32_t, 2>;
using Numbers = std::vector<Pair>;

/// Which names to draw: a start and a step along pixel, sample index or set.
struct Names {
    std::uint32_t pixel = 7, pixel_step = 0, index = 0, index_step = 0, high = 0, stream = 0, seed = 1,
                  set = 0, set_step = 0;
};

template <class T>
std::vector<T> run(const std::string& kernel, const Arguments& arguments, std::uint32_t count) {
    Device& device = test_device();
    const Buffer out = device.allocate(count * sizeof(T));
    device.run(device.build_source("random_test.cl", source).kernel(kernel),
               Arguments().add(out).add(arguments).add(count), count);
    return device.download<T>(out);
}

Numbers draw(const Names& n, std::uint32_t count) {
    return run<Pair>("sample",
                     Arguments()
                         .add(n.pixel)
                         .add(n.pixel_step)
                         .add(n.index)
                         .add(n.index_step)
                         .add(n.high)
                         .add(n.stream)
                         .add(n.seed)
                         .add(n.set)
                         .add(n.set_step),
                     count);
}

double unit(std::uint32_t bits) { return (bits >> 8) * 0x1p-24; }

/// Chi-square of pairs of numbers over 64 x 64 cells, as a standard normal.
double pair_z(const std::vector<std::array<double, 2>>& pairs) {
    std::vector<double> cells(64 * 64);
    for (const auto& [x, y] : pairs) ++cells[std::size_t(x * 64) * 64 + std::size_t(y * 64)];
    const double expected = double(pairs.size()) / cells.size(), freedom = cells.size() - 1.0;
    double chi2 = 0;
    for (double n : cells) chi2 += (n - expected) * (n - expected) / expected;
    return (chi2 - freedom) / std::sqrt(2 * freedom);
}

/// C18: successive numbers along an axis, 2^19 pairs; |z| < 5 (two-sided 6e-7 each).
void expect_independent(const Numbers& numbers, const std::string& axis) {
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
            std::vector<std::array<double, 2>> pairs;
            for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
                pairs.push_back({unit(numbers[i][a]), unit(numbers[i + 1][b])});
            EXPECT_LT(std::abs(pair_z(pairs)), 5) << axis << ", components " << a << " and " << b;
        }
}

TEST(Random, floats_stay_below_one) {
    const std::uint32_t count = 1u << 16;
    const auto values = run<float>("to_float", Arguments().add(0u - count), count);
    for (float v : values) ASSERT_LT(v, 1.0f);
    EXPECT_EQ(values.back(), 1.0f - 0x1p-24f);
    EXPECT_EQ(run<float>("to_float", Arguments().add(0u), 1)[0], 0.0f);
}

TEST(Random, pairs_along_the_pixel_axis_are_independent) {
    expect_independent(draw({.pixel_step = 1}, 1u << 20), "first sample");
    expect_independent(draw({.pixel_step = 1, .index = 1234, .set = 9}, 1u << 20), "later sample");
    expect_independent(draw({.pixel_step = 1920, .set = 3}, 1u << 20), "rows");
    expect_independent(draw({.pixel_step = 1, .set = 40}, 1u << 20), "hashed sets");
}

TEST(Random, pairs_along_the_set_axis_are_independent) {
    // one sample in sets (s, s + 1) over many pixels
    for (std::uint32_t s : {0u, 1u, 3u, 6u, 35u, 36u, 50u}) {
        const Numbers a = draw({.pixel_step = 1, .index = 5, .set = s}, 1u << 19);
        const Numbers b = draw({.pixel_step = 1, .index = 5, .set = s + 1}, 1u << 19);
        Numbers both;
        for (std::size_t i = 0; i < a.size(); ++i) both.push_back(a[i]), both.push_back(b[i]);
        expect_independent(both, "sets " + std::to_string(s) + " and next");
    }
}

TEST(Random, pairs_along_the_sample_axis_are_independent_where_hashed) {
    expect_independent(draw({.index_step = 1, .set = 36}, 1u << 20), "samples");
}

// Sobol points of one set are negatively correlated by design; between sets of one pixel, over its samples,
// they must fill the square of every two components: never more regular than random by construction, so only
// an excess fails.
TEST(Random, two_sets_of_one_pixel_fill_their_product) {
    for (std::uint32_t s : {0u, 3u, 4u, 5u, 6u, 20u}) {
        const Numbers a = draw({.index_step = 1, .set = s}, 1u << 19),
                      b = draw({.index_step = 1, .set = s + 1}, 1u << 19);
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                std::vector<std::array<double, 2>> pairs;
                for (std::size_t k = 0; k < a.size(); ++k) pairs.push_back({unit(a[k][i]), unit(b[k][j])});
                EXPECT_LT(pair_z(pairs), 5) << "sets " << s << " and " << s + 1;
            }
    }
}

// Correlation of two streams of numbers, as a standard normal.
double correlation_z(const Numbers& a, const Numbers& b, int i, int j) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (unit(a[k][i]) - 0.5) * (unit(b[k][j]) - 0.5);
    return sum * 12 / std::sqrt(double(a.size()));
}

TEST(Random, streams_seeds_and_pixels_are_uncorrelated) {
    // over pixels, at one sample index: pairs of halves, bins, seeds, upper index halves, neighbours
    const Names base{.pixel_step = 1, .index = 77, .set = 4};
    const Numbers a = draw(base, 1u << 18);
    std::vector<Names> others(5, base);
    others[0].stream = 1, others[1].stream = 2, others[2].seed = 2, others[3].high = 1, others[4].pixel = 8;
    for (std::size_t o = 0; o < others.size(); ++o) {
        const Numbers b = draw(others[o], 1u << 18);
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                EXPECT_LT(std::abs(correlation_z(a, b, i, j)), 5) << "variation " << o;
    }
}

/// Every elementary interval of area 2^-k holds one of the first 2^k points.
void expect_net(const Numbers& points, unsigned k, const std::string& what) {
    for (unsigned a = 0; a <= k; ++a) {
        std::vector<int> cells(1u << k);
        for (std::size_t i = 0; i < (1u << k); ++i) {
            const std::uint32_t x = a ? points[i][0] >> (32 - a) : 0,
                                y = k - a ? points[i][1] >> (32 - (k - a)) : 0;
            ++cells[(x << (k - a)) | y];
        }
        for (int n : cells) ASSERT_EQ(n, 1) << what << ": 2^" << k << " points, x split in 2^" << a;
    }
}

TEST(Random, every_prefix_is_a_net) {
    const std::uint32_t count = 1u << 14;
    const Numbers plain = run<Pair>("sobol", Arguments(), count);
    const Numbers first = draw({.index_step = 1}, count),
                  later = draw({.pixel = 99, .index_step = 1, .seed = 3, .set = 14}, count);
    for (unsigned k = 0; k <= 14; ++k) {
        expect_net(plain, k, "unscrambled");
        expect_net(first, k, "set 0");
        expect_net(later, k, "set 14");
    }
}

TEST(Random, error_on_a_disc_falls_faster_than_randomly) {
    // area of the quarter disc: root of the mean square over 256 pixels at 64 and 4096 samples
    double error[2] = {};
    const std::uint32_t samples[2] = {64, 4096};
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel) {
        const Numbers p = draw({.pixel = pixel, .index_step = 1, .set = 3}, samples[1]);
        int inside = 0;
        for (std::uint32_t i = 0; i < samples[1]; ++i) {
            inside += unit(p[i][0]) * unit(p[i][0]) + unit(p[i][1]) * unit(p[i][1]) < 1;
            for (int k = 0; k < 2; ++k)
                if (i + 1 == samples[k]) error[k] += std::pow(double(inside) / samples[k] - pi / 4, 2) / 256;
        }
    }
    const double slope = std::log(std::sqrt(error[1] / error[0])) / std::log(64.0);
    EXPECT_LT(slope, -0.70);  // random: -0.50; Owen-scrambled (0,2)-sequence: -0.75
    EXPECT_LT(std::sqrt(error[1]), 0.0022 * 1.3);
}

TEST(Random, no_sample_repeats_beyond_the_index_of_32_bits) {
    std::set<Pair> seen;
    for (std::uint32_t set : {0u, 40u}) {
        seen.clear();
        for (const Names& n : {Names{.index = 0xfffffff8u, .index_step = 1, .set = set},
                               Names{.index = 0, .index_step = 1, .high = 1, .set = set},
                               Names{.index = 0, .index_step = 1, .set = set}})
            for (const Pair& p : draw(n, 8)) EXPECT_TRUE(seen.insert(p).second);
    }
}

}  // namespace
