// The sampler: uniform, stratified as Sobol's sequence must be, and without correlation between any two
// names.
#include <cmath>
#include <set>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/measurements.h"
#include "kernels/types.h"

namespace triad {
namespace {

const char* const source = R"(#include "common/random.h"
__kernel void sample(__global UVec2* out, uint pixel, uint pixel_step, uint index, uint index_step, uint high,
                     uint stream, uint seed, uint set, uint set_step, uint first_block, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Sampler s = sampler_make(pixel + i * pixel_step, index + i * index_step, high, stream, seed);
    s.first_block = first_block;
    out[i] = sampler_2d_bits(&s, set + i * set_step);
}
__kernel void sobol(__global UVec2* out, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = uvec2_make(random_reverse_bits(i), RANDOM_FIRST_LANE(random_reverse_lanes(random_sobol1_reversed((RandomLanes)(i)))));
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
                  set = 0, set_step = 0, first_block = 0;
};

Numbers draw(Check& check, const Names& n, std::size_t count) {
    return run_kernel<Pair>(check.device, source, "sample",
                            Arguments()
                                .add(n.pixel)
                                .add(n.pixel_step)
                                .add(n.index)
                                .add(n.index_step)
                                .add(n.high)
                                .add(n.stream)
                                .add(n.seed)
                                .add(n.set)
                                .add(n.set_step)
                                .add(n.first_block),
                            count);
}

double unit(std::uint32_t bits) { return (bits >> 8) * 0x1p-24; }

/// Chi-square of pairs of numbers over 64 x 64 cells (fewer for few pairs), as a standard normal.
double pair_z(const std::vector<std::array<double, 2>>& pairs) {
    const int n = grid_edge(pairs.size(), 64);
    std::vector<double> cells(std::size_t(n * n));
    for (const auto& [x, y] : pairs) ++cells[std::size_t(x * n) * n + std::size_t(y * n)];
    return chi_square_z(cells,
                        std::vector<double>(cells.size(), double(pairs.size()) / double(cells.size())));
}

/// C18: successive numbers along an axis, 2^19 pairs; |z| < 5 (two-sided 6e-7 each).
void expect_independent(Check& check, const Numbers& numbers, const std::string& axis) {
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) {
            std::vector<std::array<double, 2>> pairs;
            for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
                pairs.push_back({unit(numbers[i][a]), unit(numbers[i + 1][b])});
            check.below(std::abs(pair_z(pairs)), 5, axis, ", components ", a, " and ", b);
        }
}

void floats_stay_below_one(Check& check) {
    const std::uint32_t count = 1u << 16;  // exhaustive: the values that could round up
    const auto values =
        run_kernel<float>(check.device, source, "to_float", Arguments().add(0u - count), count);
    for (float v : values) check.below(v, 1.0f, "largest float");
    check.equal(values.back(), 1.0f - 0x1p-24f, "the largest");
    check.equal(run_kernel<float>(check.device, source, "to_float", Arguments().add(0u), 1)[0], 0.0f,
                "the least");
}

void pixels_are_independent(Check& check) {
    expect_independent(check, draw(check, {.pixel_step = 1}, check.count(1 << 20)), "first sample");
    expect_independent(check, draw(check, {.pixel_step = 1, .index = 1234, .set = 9}, check.count(1 << 20)),
                       "later sample");
    expect_independent(check, draw(check, {.pixel_step = 1920, .set = 3}, check.count(1 << 20)), "rows");
    expect_independent(check, draw(check, {.pixel_step = 1, .set = 40}, check.count(1 << 20)), "hashed sets");
}

void sets_are_independent(Check& check) {
    // one sample in sets (s, s + 1) over many pixels
    for (std::uint32_t s : {0u, 1u, 3u, 6u, 35u, 36u, 50u}) {
        const Numbers a = draw(check, {.pixel_step = 1, .index = 5, .set = s}, check.count(1 << 19));
        const Numbers b = draw(check, {.pixel_step = 1, .index = 5, .set = s + 1}, check.count(1 << 19));
        Numbers both;
        for (std::size_t i = 0; i < a.size(); ++i) both.push_back(a[i]), both.push_back(b[i]);
        expect_independent(check, both, "sets " + std::to_string(s) + " and next");
    }
}

void hashed_samples_are_independent(Check& check) {
    expect_independent(check, draw(check, {.index_step = 1, .set = 36}, check.count(1 << 20)), "samples");
    // --sampler independent: the sets that are Sobol's otherwise, which would be far too regular
    for (const std::uint32_t set : {0u, 5u, 35u})
        expect_independent(check,
                           draw(check, {.index_step = 1, .set = set, .first_block = SAMPLER_SOBOL_BLOCKS},
                                check.count(1 << 19)),
                           "independent samples of set " + std::to_string(set));
}

// Sobol points of one set are negatively correlated by design; between sets of one pixel, over its samples,
// they must fill the square of every two components: never more regular than random by construction, so only
// an excess fails.
void sets_of_a_pixel_fill_their_product(Check& check) {
    for (std::uint32_t s : {0u, 3u, 4u, 5u, 6u, 20u}) {
        const Numbers a = draw(check, {.index_step = 1, .set = s}, check.count(1 << 19)),
                      b = draw(check, {.index_step = 1, .set = s + 1}, check.count(1 << 19));
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                std::vector<std::array<double, 2>> pairs;
                for (std::size_t k = 0; k < a.size(); ++k) pairs.push_back({unit(a[k][i]), unit(b[k][j])});
                check.below(pair_z(pairs), 5, "sets ", s, " and ", s + 1);
            }
    }
}

// Correlation of two streams of numbers, as a standard normal.
double correlation_z(const Numbers& a, const Numbers& b, int i, int j) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (unit(a[k][i]) - 0.5) * (unit(b[k][j]) - 0.5);
    return sum * 12 / std::sqrt(double(a.size()));
}

void streams_are_uncorrelated(Check& check) {
    // over pixels, at one sample index: pairs of halves, bins, seeds, upper index halves, neighbours
    const Names base{.pixel_step = 1, .index = 77, .set = 4};
    const Numbers a = draw(check, base, check.count(1 << 18));
    std::vector<Names> others(5, base);
    others[0].stream = 1, others[1].stream = 2, others[2].seed = 2, others[3].high = 1, others[4].pixel = 8;
    for (std::size_t o = 0; o < others.size(); ++o) {
        const Numbers b = draw(check, others[o], check.count(1 << 18));
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) check.below(std::abs(correlation_z(a, b, i, j)), 5, "variation ", o);
    }
}

/// Every elementary interval of area 2^-k holds one of the first 2^k points.
void expect_net(Check& check, const Numbers& points, unsigned k, const std::string& what) {
    for (unsigned a = 0; a <= k; ++a) {
        std::vector<int> cells(1u << k);
        for (std::size_t i = 0; i < (1u << k); ++i) {
            const std::uint32_t x = a ? points[i][0] >> (32 - a) : 0,
                                y = k - a ? points[i][1] >> (32 - (k - a)) : 0;
            ++cells[(x << (k - a)) | y];
        }
        for (int n : cells) check.equal(n, 1, what, ": 2^", k, " points, x split in 2^", a);
    }
}

void every_prefix_is_a_net(Check& check) {
    const unsigned most = check.level == CheckLevel::tiny ? 8 : 14;
    const std::size_t count = std::size_t(1) << most;
    const Numbers plain = run_kernel<Pair>(check.device, source, "sobol", Arguments(), count);
    const Numbers first = draw(check, {.index_step = 1}, count),
                  later = draw(check, {.pixel = 99, .index_step = 1, .seed = 3, .set = 14}, count);
    for (unsigned k = 0; k <= most; ++k) {
        expect_net(check, plain, k, "unscrambled");
        expect_net(check, first, k, "set 0");
        expect_net(check, later, k, "set 14");
    }
}

void error_on_a_disc_falls_fast(Check& check) {
    // area of the quarter disc: root of the mean square over many pixels at 64 and 4096 samples
    const std::uint32_t pixels = std::uint32_t(check.count(256, 16));
    const double spread = 1 + 4 / std::sqrt(2.0 * pixels);  // of an estimated root mean square, 4 sigma
    double error[2] = {};
    const std::uint32_t samples[2] = {64, 4096};
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const Numbers p = draw(check, {.pixel = pixel, .index_step = 1, .set = 3}, samples[1]);
        int inside = 0;
        for (std::uint32_t i = 0; i < samples[1]; ++i) {
            inside += unit(p[i][0]) * unit(p[i][0]) + unit(p[i][1]) * unit(p[i][1]) < 1;
            for (int k = 0; k < 2; ++k)
                if (i + 1 == samples[k])
                    error[k] += std::pow(double(inside) / samples[k] - pi / 4, 2) / pixels;
        }
    }
    const double slope = std::log(std::sqrt(error[1] / error[0])) / std::log(64.0);
    // random: -0.50; Owen-scrambled (0,2)-sequence: -0.75, estimated from two roots
    check.at_most(slope, -0.75 + 1.4 * std::log(spread) / std::log(64.0), "slope");
    check.at_most(std::sqrt(error[1]), 0.0022 * spread, "error at 4096 samples");
}

void no_sample_repeats(Check& check) {
    std::set<Pair> seen;
    for (std::uint32_t set : {0u, 40u}) {
        seen.clear();
        for (const Names& n : {Names{.index = 0xfffffff8u, .index_step = 1, .set = set},
                               Names{.index = 0, .index_step = 1, .high = 1, .set = set},
                               Names{.index = 0, .index_step = 1, .set = set}})
            for (const Pair& p : draw(check, n, 8))
                check.holds(seen.insert(p).second, "a repeated sample in set ", set);
    }
}

}  // namespace

void add_random(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"C18", "random pairs along pixels", quick, pixels_are_independent},
            {"C18b", "random pairs along sets", standard, sets_are_independent},
            {"C18c", "random pairs along hashed samples", standard, hashed_samples_are_independent},
            {"C18d", "sets of one pixel fill their product", quick, sets_of_a_pixel_fill_their_product},
            {"C18e", "streams and seeds without correlation", standard, streams_are_uncorrelated},
            {"C18f", "every prefix of Sobol's points is a net", quick, every_prefix_is_a_net},
            {"C18g", "error on a disc falls faster than randomly", standard, error_on_a_disc_falls_fast},
            {"C19", "floats stay below 1", quick, floats_stay_below_one},
            {"C21", "no sample repeats beyond 2^32", quick, no_sample_repeats},
        });
}

}  // namespace triad
