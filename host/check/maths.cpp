// The kernels' own mathematics against double: the largest errors that kernels/common/math.h states.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/measurements.h"

namespace triad {
namespace {

const char* const maths_source = R"(#include "common/math.h"
TRIAD_FUNCTION float stored4(float x) { float to[5]; vstore4((float4)(0.0f, 0.0f, 0.0f, x), 0, to + 1); return to[4]; }
TRIAD_FUNCTION float stored8(float x) { float to[9]; vstore8((float8)(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, x), 0, to + 1); return to[8]; }
__kernel void evaluate(__global float* out, __global const float* a, __global const float* b, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = EXPRESSION;
}
)";

std::vector<float> evaluate(Check& check, const std::string& expression, const std::vector<float>& a,
                            std::vector<float> b = {}) {
    if (b.empty()) b.resize(a.size());
    std::string text = maths_source;
    text.replace(text.find("EXPRESSION"), 10, expression);
    return run_kernel<float>(check.device, text, "evaluate",
                             Arguments().add(check.device.upload(a)).add(check.device.upload(b)), a.size());
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

using Reference = std::function<double(std::size_t)>;

/// The largest error of an expression in ulp of max(|reference|, floor) is at most `bound`.
void expect_ulps(Check& check, double bound, const std::string& expression, const std::vector<float>& a,
                 const std::vector<float>& b, const Reference& reference, double floor = 0) {
    const std::vector<float> result = evaluate(check, expression, a, b);
    double worst = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double r = reference(i), error = std::abs(result[i] - r) / ulp(std::max(std::abs(r), floor));
        worst = error <= worst ? worst : error;  // a NaN stays
    }
    check.at_most(worst, bound, "ulp of ", expression);
}

constexpr std::size_t full = 1 << 21;  ///< arguments of each function
constexpr double small = 1.0 / 1024;

void sin_and_cos_of_turns(Check& check) {
    for (float range : {1.0f, 1000.0f}) {
        const auto x = uniform(-range, range, check.count(full), 1);
        const auto angle = [&](auto i) { return 2 * pi * (x[i] - std::round(double(x[i]))); };
        const auto sine = [&](auto i) { return std::sin(angle(i)); };
        const auto cosine = [&](auto i) { return std::cos(angle(i)); };
        expect_ulps(check, 1.1, "math_sin_turns(a[i])", x, {}, sine, small);
        expect_ulps(check, 1.1, "math_cos_turns(a[i])", x, {}, cosine, small);
    }
}

void sin_and_cos_of_radians(Check& check) {
    for (float range : {0.8f, 7.0f, 1024.0f}) {
        const auto x = uniform(-range, range, check.count(full), 2);
        const auto sine = [&](auto i) { return std::sin(double(x[i])); };
        const auto cosine = [&](auto i) { return std::cos(double(x[i])); };
        expect_ulps(check, 1.6, "math_sin(a[i])", x, {}, sine, small);
        expect_ulps(check, 1.6, "math_cos(a[i])", x, {}, cosine, small);
    }
}

void exponentials(Check& check) {
    auto x = uniform(-126.0f, 127.999f, check.count(full), 3);
    const auto exp2 = [&](auto i) { return std::exp2(double(x[i])); };
    expect_ulps(check, 0.9, "math_exp2(a[i])", x, {}, exp2);
    for (float& v : x) v *= 0.693f;
    const auto exp = [&](auto i) { return std::exp(double(x[i])); };
    expect_ulps(check, 1.1, "math_exp(a[i])", x, {}, exp);
    const auto edges = evaluate(check, "math_exp(a[i])", {0.0f, -200.0f, 200.0f, -INFINITY, INFINITY, NAN});
    const std::vector<float> expected{1.0f, 0.0f, INFINITY, 0.0f, INFINITY};
    for (std::size_t i = 0; i < expected.size(); ++i)
        check.equal(edges[i], expected[i], "edge ", i, " of exp");
    check.holds(std::isnan(edges[5]), "exp of NaN is a number");
}

void logarithms(Check& check) {
    auto x = uniform_bits(1.2e-38f, 3.4e38f, check.count(full), 4);
    const auto near_one = uniform(0.7f, 1.5f, check.count(full / 4), 5);
    x.insert(x.end(), near_one.begin(), near_one.end());
    const auto log = [&](auto i) { return std::log(double(x[i])); };
    const auto log2 = [&](auto i) { return std::log2(double(x[i])); };
    expect_ulps(check, 1.2, "math_log(a[i])", x, {}, log);
    expect_ulps(check, 1.2, "math_log2(a[i])", x, {}, log2);
    const auto edges = evaluate(check, "math_log(a[i])", {0.0f, 1.0f});
    check.equal(edges[0], -INFINITY, "log of 0");
    check.equal(edges[1], 0.0f, "log of 1");
}

void powers(Check& check) {
    // x^y over the whole range of exponents, then large y with a result in range
    struct Range {
        float lo, hi, power, bound;
    };
    for (const Range& r :
         {Range{1e-12f, 1e12f, 3, 1.6f}, Range{1e-30f, 1e30f, 1.2f, 1.2f}, Range{0.5f, 2, 120, 24}}) {
        const std::size_t count = check.count(full);
        const auto x = uniform_bits(r.lo, r.hi, count, 6), y = uniform(-r.power, r.power, count, 7);
        const auto pow = [&](auto i) { return std::pow(double(x[i]), double(y[i])); };
        expect_ulps(check, r.bound, "math_pow(a[i], b[i])", x, y, pow);
    }
    const auto edges = evaluate(check, "math_pow(a[i], b[i])", {0.0f, 0.0f, 2.0f, 2.0f, 5.0f},
                                {0.0f, 2.4f, 1000.0f, -1000.0f, 0.0f});
    check.equal(edges, std::vector<float>{1.0f, 0.0f, INFINITY, 0.0f, 1.0f}, "pow at its edges");
}

void angles(Check& check) {
    const std::size_t count = check.count(full, 2048);
    const auto y = uniform(-2.0f, 2.0f, count, 10), x = uniform(-2.0f, 2.0f, count, 11);
    const auto atan2 = [&](auto i) { return std::atan2(double(y[i]), double(x[i])); };
    expect_ulps(check, 1.7, "math_atan2(a[i], b[i])", y, x, atan2);
    const auto edges =
        evaluate(check, "math_atan2(a[i], b[i])", {0, 0, 0, 1, -1, 1e-30f}, {0, 1, -1, 0, 0, 1e30f});
    const std::vector<float> expected{0.0f, 0.0f, float(pi), float(pi / 2), float(-pi / 2), 0.0f};
    for (std::size_t i = 0; i < expected.size(); ++i)
        check.near(edges[i], expected[i], 4 * ulp(expected[i]), "edge ", i, " of atan2");
    auto c = uniform(-1.0f, 1.0f, count, 12);
    for (std::size_t i = 0; i < 1000; ++i) c[i] = 1.0f - 5.96e-8f * i, c[1000 + i] = -c[i];
    const auto acos = [&](auto i) { return std::acos(double(c[i])); };
    expect_ulps(check, 1.2, "math_acos(a[i])", c, {}, acos, small);
}

void floor_is_exact(Check& check) {
    const std::size_t count = check.count(full);
    auto x = uniform(-2e9f, 2e9f, count / 4, 13);
    const auto near_zero = uniform(-3.0f, 3.0f, count / 4, 14);
    x.insert(x.end(), near_zero.begin(), near_zero.end());
    x.insert(x.end(), {-1.0f, 0.0f, 1.0f, -0.0f, 0.99999994f, -1e-30f, 8388609.0f});
    const auto result = evaluate(check, "math_floor(a[i])", x);
    for (std::size_t i = 0; i < x.size(); ++i) check.equal(result[i], std::floor(x[i]), "floor of ", x[i]);
}

void not_finite_is_seen(Check& check) {
    const auto result = evaluate(check, "convert_float(math_is_finite(a[i]))",
                                 {0, 1, -3e38f, 1e-40f, INFINITY, -INFINITY, NAN, -NAN});
    check.equal(result, (std::vector<float>{1, 1, 1, 1, 0, 0, 0, 0}), "finiteness");
    for (const char* drops : {"math_min(a[i], 1.0f)", "math_max(a[i], 1.0f)"})
        check.equal(evaluate(check, drops, {NAN, -NAN}), std::vector<float>{1, 1}, drops, " of NaN");
}

void differences_of_products(Check& check) {
    // a b - c d of nearly equal products: plain arithmetic loses a thousandfold
    const auto a = uniform(0.5f, 1.0f, check.count(full / 4), 15), b = uniform(0.5f, 1.0f, a.size(), 16);
    const auto exact = [&](auto i) {
        const float c = a[i] * 1.001f, d = b[i] * 0.9991f;
        return double(a[i]) * b[i] - double(c) * d;
    };
    expect_ulps(check, 1.5, "math_difference_of_products(a[i], b[i], a[i] * 1.001f, b[i] * 0.9991f)", a, b,
                exact);
}

void no_contraction(Check& check) {
    // a b + c with its two roundings: a compiler that fuses them gives other bits
    const auto a = uniform(0.5f, 1.0f, check.count(full / 8), 17), b = uniform(0.5f, 1.0f, a.size(), 18);
    const auto result = evaluate(check, "a[i] * b[i] - 0.5f", a, b);
    std::size_t fused = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const float product = a[i] * b[i];
        fused += result[i] != product - 0.5f;
    }
    check.at_most(double(fused), 0, "results of ", a.size(), " that are fused");
}

/// Both signs of numbers of every size whose products are normal, and the odd ones.
std::vector<float> all_kinds(std::size_t count, unsigned seed) {
    auto x = uniform_bits(1e-12f, 1e12f, count, seed);
    for (std::size_t i = 0; i < x.size(); i += 2) x[i] = -x[i];
    x.insert(x.end(), {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, -0.5f, 8388607.5f, -8388607.5f, 0.99999994f});
    return x;
}

/// The bits of an expression over a and b are those of `reference`.
void expect_bits(Check& check, const std::string& expression, const std::vector<float>& a,
                 const std::vector<float>& b, const std::function<float(float, float)>& reference) {
    const auto found = evaluate(check, expression, a, b);
    for (std::size_t i = 0; i < a.size(); ++i)
        check.equal(std::bit_cast<std::uint32_t>(found[i]),
                    std::bit_cast<std::uint32_t>(reference(a[i], b[i])), expression, " of ", a[i], " and ",
                    b[i]);
}

void builtins_are_exact(Check& check) {
    const auto a = all_kinds(check.count(full / 4), 19), b = all_kinds(a.size() - 9, 20);
    expect_bits(check, "fabs(a[i])", a, b, [](float x, float) { return std::fabs(x); });
    expect_bits(check, "floor(a[i])", a, b, [](float x, float) { return std::floor(x); });
    expect_bits(check, "ceil(a[i])", a, b, [](float x, float) { return std::ceil(x); });
    expect_bits(check, "copysign(a[i], b[i])", a, b, [](float x, float y) { return std::copysign(x, y); });
    // the rounding error of a product, which fma alone gives; in lanes too, as traversal asks for it
    const auto error_of_product = [](float x, float y) { return std::fma(x, y, -(x * y)); };
    expect_bits(check, "fma(a[i], b[i], -(a[i] * b[i]))", a, b, error_of_product);
    expect_bits(check, "fma((float8)(a[i]), (float8)(b[i]), (float8)(-(a[i] * b[i]))).s5", a, b,
                error_of_product);
    expect_bits(check, "fma((float4)(a[i]), (float4)(b[i]), (float4)(-(a[i] * b[i]))).w", a, b,
                error_of_product);
    if (check.device.info().correctly_rounded)
        expect_bits(check, "sqrt(fabs(a[i]))", a, b, [](float x, float) { return std::sqrt(std::fabs(x)); });
    else
        expect_ulps(check, 3, "sqrt(fabs(a[i]))", a, b,
                    [&](std::size_t i) { return std::sqrt(std::abs(double(a[i]))); });
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

void builtins_of_integers_are_exact(Check& check) {
    const auto a = all_kinds(check.count(full / 16), 21), b = all_kinds(a.size() - 9, 22);
    expect_bits(check, "(float)clz(as_uint(a[i]))", a, b,
                [](float x, float) { return float(std::countl_zero(bits(x))); });
    expect_bits(check, "(float)clz((ulong)as_uint(a[i]) << 20)", a, b,
                [](float x, float) { return float(std::countl_zero(std::uint64_t(bits(x)) << 20)); });
    expect_bits(check, "(float)popcount((ulong)as_uint(a[i]) << 32 | as_uint(b[i]))", a, b,
                [](float x, float y) { return float(std::popcount(bits(x)) + std::popcount(bits(y))); });
    expect_bits(check, "as_float((uint)min((ulong)as_uint(a[i]), (ulong)as_uint(b[i])))", a, b,
                [](float x, float y) { return bits(x) < bits(y) ? x : y; });
    expect_bits(check, "as_float((uint)max((ulong)as_uint(a[i]), (ulong)as_uint(b[i])))", a, b,
                [](float x, float y) { return bits(x) < bits(y) ? y : x; });
    // of numbers as large as 64 bits hold
    expect_bits(check, "(float)(add_sat(as_int(a[i]) * 4294967296L, as_int(b[i]) * 4294967296L) >> 32)", a, b,
                [](float x, float y) {
                    return float(std::int32_t(std::clamp<std::int64_t>(
                        std::int64_t(std::int32_t(bits(x))) + std::int32_t(bits(y)), INT32_MIN, INT32_MAX)));
                });
}

void vectors_are_read_and_written_anywhere(Check& check) {
    const auto a = all_kinds(check.count(full / 16), 23);
    const auto same = [](float x, float) { return x; };
    for (const char* last :
         {"vload4(0, a + i - 3u).w", "vload8(0, a + i - 7u).s7", "vload16(0, a + i - 15u).sf",
          "as_float(vload4(0, (const global uint*)a + i - 3u).w)",
          "as_float(vload8(0, (const global uint*)a + i - 7u).s7)"})
        expect_bits(check, std::string("i < 15u ? a[i] : ") + last, a, a, same);
    expect_bits(check, "i < 15u ? a[i] : vload4(1, a + i - 7u).w", a, a, same);
    expect_bits(
        check,
        "(float)(i < 8u ? (ushort)as_uint(a[i]) : vload16(0, (const global ushort*)a + 2u * i - 15u).sf)", a,
        a, [](float x, float) { return float(bits(x) & 0xffff); });
    expect_bits(check, "stored4(a[i])", a, a, same);
    expect_bits(check, "stored8(a[i])", a, a, same);
}

}  // namespace

void add_maths(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"M1", "sin and cos of turns, in ulp", quick, sin_and_cos_of_turns},
            {"M2", "sin and cos of radians, in ulp", standard, sin_and_cos_of_radians},
            {"M3", "exp and exp2, in ulp", quick, exponentials},
            {"M4", "log and log2, in ulp", standard, logarithms},
            {"M5", "pow, in ulp", standard, powers},
            {"M6", "atan2 and acos, in ulp", quick, angles},
            {"M7", "floor is exact", standard, floor_is_exact},
            {"M8", "infinities and NaN are seen, and dropped by min and max", quick, not_finite_is_seen},
            {"M9", "differences of products, in ulp", quick, differences_of_products},
            {"M10", "products and sums are not fused", quick, no_contraction},
            {"M11", "fma, fabs, floor, ceil, copysign and sqrt to the bit", quick, builtins_are_exact},
            {"M12", "clz, popcount, add_sat, min and max to the bit", quick, builtins_of_integers_are_exact},
            {"M13", "vectors are read and written anywhere", quick, vectors_are_read_and_written_anywhere},
        });
}

}  // namespace triad
