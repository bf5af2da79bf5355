// The kernels' own mathematics against double: the largest errors that kernels/common/math.h states.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "base/math.h"
#include "device_fixture.h"

using namespace triad;

namespace {

const char* const source = R"(#include "common/math.h"
__kernel void evaluate(__global const float* a, __global const float* b, __global float* out, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = EXPRESSION;
}
)";

std::vector<float> evaluate(const std::string& expression, const std::vector<float>& a,
                            std::vector<float> b = {}) {
    Device& device = test_device();
    if (b.empty()) b.resize(a.size());
    std::string text = source;
    text.replace(text.find("EXPRESSION"), 10, expression);
    const Buffer out = device.allocate(a.size() * sizeof(float));
    device.run(device.build_source("evaluate.cl", text).kernel("evaluate"),
               Arguments().add(device.upload(a)).add(device.upload(b)).add(out).add(std::uint32_t(a.size())),
               a.size());
    return device.download<float>(out);
}

std::vector<float> uniform(float lo, float hi, std::size_t count, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> number(lo, hi);
    std::vector<float> values(count);
    for (float& v : values) v = number(generator);
    return values;
}

/// Every bit pattern equally likely between two positive floats: all exponents get their share.
std::vector<float> uniform_bits(float lo, float hi, std::size_t count, unsigned seed) {
    std::uint32_t a, b;
    std::memcpy(&a, &lo, 4), std::memcpy(&b, &hi, 4);
    std::mt19937 generator(seed);
    std::uniform_int_distribution<std::uint32_t> number(a, b);
    std::vector<float> values(count);
    for (float& v : values) {
        const std::uint32_t bits = number(generator);
        std::memcpy(&v, &bits, 4);
    }
    return values;
}

double ulp(double reference) {
    const int exponent = std::max(std::ilogb(reference), -126);
    return std::ldexp(1.0, exponent - 23);
}

/// Largest error in ulp of max(|reference|, floor).
double largest_error(const std::vector<float>& result, const std::function<double(std::size_t)>& reference,
                     double floor = 0) {
    double worst = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double r = reference(i), error = std::abs(result[i] - r) / ulp(std::max(std::abs(r), floor));
        worst = error <= worst ? worst : error;  // a NaN stays
    }
    return worst;
}

constexpr std::size_t count = 1 << 21;
constexpr double small = 1.0 / 1024;

TEST(Math, sin_and_cos_of_turns) {
    for (float range : {1.0f, 1000.0f}) {
        const auto x = uniform(-range, range, count, 1);
        const auto angle = [&](std::size_t i) { return 2 * pi * (x[i] - std::round(double(x[i]))); };
        EXPECT_LE(largest_error(
                      evaluate("math_sin_turns(a[i])", x), [&](auto i) { return std::sin(angle(i)); }, small),
                  1.1);
        EXPECT_LE(largest_error(
                      evaluate("math_cos_turns(a[i])", x), [&](auto i) { return std::cos(angle(i)); }, small),
                  1.1);
    }
}

TEST(Math, sin_and_cos_of_radians) {
    for (float range : {0.8f, 7.0f, 1024.0f}) {
        const auto x = uniform(-range, range, count, 2);
        EXPECT_LE(largest_error(
                      evaluate("math_sin(a[i])", x), [&](auto i) { return std::sin(double(x[i])); }, small),
                  1.6);
        EXPECT_LE(largest_error(
                      evaluate("math_cos(a[i])", x), [&](auto i) { return std::cos(double(x[i])); }, small),
                  1.6);
    }
}

TEST(Math, exponentials) {
    auto x = uniform(-126.0f, 127.999f, count, 3);
    EXPECT_LE(largest_error(evaluate("math_exp2(a[i])", x), [&](auto i) { return std::exp2(double(x[i])); }),
              0.9);
    for (float& v : x) v *= 0.693f;
    EXPECT_LE(largest_error(evaluate("math_exp(a[i])", x), [&](auto i) { return std::exp(double(x[i])); }),
              1.1);
    const auto edges = evaluate("math_exp(a[i])", {0.0f, -200.0f, 200.0f, -INFINITY, INFINITY, NAN});
    EXPECT_EQ(edges[0], 1.0f);
    EXPECT_EQ(edges[1], 0.0f);
    EXPECT_EQ(edges[2], INFINITY);
    EXPECT_EQ(edges[3], 0.0f);
    EXPECT_EQ(edges[4], INFINITY);
    EXPECT_TRUE(std::isnan(edges[5]));
}

TEST(Math, logarithms) {
    auto x = uniform_bits(1.2e-38f, 3.4e38f, count, 4);
    const auto near_one = uniform(0.7f, 1.5f, count / 4, 5);
    x.insert(x.end(), near_one.begin(), near_one.end());
    EXPECT_LE(largest_error(evaluate("math_log(a[i])", x), [&](auto i) { return std::log(double(x[i])); }),
              1.2);
    EXPECT_LE(largest_error(evaluate("math_log2(a[i])", x), [&](auto i) { return std::log2(double(x[i])); }),
              1.2);
    const auto edges = evaluate("math_log(a[i])", {0.0f, 1.0f});
    EXPECT_EQ(edges[0], -INFINITY);
    EXPECT_EQ(edges[1], 0.0f);
}

TEST(Math, powers) {
    // x^y over the whole range of exponents, then large y with a result in range
    struct Range {
        float lo, hi, power, bound;
    };
    for (const Range& r :
         {Range{1e-12f, 1e12f, 3, 1.6f}, Range{1e-30f, 1e30f, 1.2f, 1.2f}, Range{0.5f, 2, 120, 24}}) {
        const auto x = uniform_bits(r.lo, r.hi, count, 6), y = uniform(-r.power, r.power, count, 7);
        EXPECT_LE(largest_error(evaluate("math_pow(a[i], b[i])", x, y),
                                [&](auto i) { return std::pow(double(x[i]), double(y[i])); }),
                  r.bound);
    }
    const auto edges = evaluate("math_pow(a[i], b[i])", {0.0f, 0.0f, 2.0f, 2.0f, 5.0f},
                                {0.0f, 2.4f, 1000.0f, -1000.0f, 0.0f});
    EXPECT_EQ(edges, (std::vector<float>{1.0f, 0.0f, INFINITY, 0.0f, 1.0f}));
}

TEST(Math, angles) {
    const auto y = uniform(-2.0f, 2.0f, count, 10), x = uniform(-2.0f, 2.0f, count, 11);
    EXPECT_LE(largest_error(evaluate("math_atan2(a[i], b[i])", y, x),
                            [&](auto i) { return std::atan2(double(y[i]), double(x[i])); }),
              1.7);
    const auto edges = evaluate("math_atan2(a[i], b[i])", {0, 0, 0, 1, -1, 1e-30f}, {0, 1, -1, 0, 0, 1e30f});
    EXPECT_EQ(edges[0], 0.0f);
    EXPECT_EQ(edges[1], 0.0f);
    EXPECT_FLOAT_EQ(edges[2], float(pi));
    EXPECT_FLOAT_EQ(edges[3], float(pi / 2));
    EXPECT_FLOAT_EQ(edges[4], float(-pi / 2));
    EXPECT_EQ(edges[5], 0.0f);
    auto c = uniform(-1.0f, 1.0f, count, 12);
    for (std::size_t i = 0; i < 1000; ++i) c[i] = 1.0f - 5.96e-8f * i, c[1000 + i] = -c[i];
    EXPECT_LE(largest_error(
                  evaluate("math_acos(a[i])", c), [&](auto i) { return std::acos(double(c[i])); }, small),
              1.2);
}

TEST(Math, floor_is_exact) {
    auto x = uniform(-2e9f, 2e9f, count / 4, 13);
    const auto near_zero = uniform(-3.0f, 3.0f, count / 4, 14);
    x.insert(x.end(), near_zero.begin(), near_zero.end());
    x.insert(x.end(), {-1.0f, 0.0f, 1.0f, -0.0f, 0.99999994f, -1e-30f, 8388609.0f});
    const auto result = evaluate("math_floor(a[i])", x);
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(result[i], std::floor(x[i])) << x[i];
}

TEST(Math, not_finite_is_seen_by_bits) {
    const auto result = evaluate("convert_float(math_is_finite(a[i]))",
                                 {0, 1, -3e38f, 1e-40f, INFINITY, -INFINITY, NAN, -NAN});
    EXPECT_EQ(result, (std::vector<float>{1, 1, 1, 1, 0, 0, 0, 0}));
}

TEST(Math, differences_of_products_keep_their_digits) {
    // a b - c d of nearly equal products: plain arithmetic loses a thousandfold
    const auto a = uniform(0.5f, 1.0f, count / 4, 15), b = uniform(0.5f, 1.0f, count / 4, 16);
    const auto result =
        evaluate("math_difference_of_products(a[i], b[i], a[i] * 1.001f, b[i] * 0.9991f)", a, b);
    EXPECT_LE(largest_error(result,
                            [&](auto i) {
                                const float c = a[i] * 1.001f, d = b[i] * 0.9991f;
                                return double(a[i]) * b[i] - double(c) * d;
                            }),
              1.5);
}

}  // namespace
