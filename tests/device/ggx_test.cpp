// Fresnel factors, the GGX distribution and its albedo tables against double and closed forms.
#include <gtest/gtest.h>

#include <random>

#include "render/albedo_tables.h"
#include "shading_fixture.h"

using namespace triad;

namespace {

std::vector<float> evaluate(const std::string& expression, const std::vector<std::array<float, 4>>& inputs) {
    const std::string source = R"(#include "common/random.h"
#include "shading/albedo.h"
#include "shading/fresnel.h"
#include "shading/ggx.h"
TRIAD_FUNCTION float2 hashed(uint index) {
    const Sampler s = sampler_make(1u, index, 0u, 0u, 1u);
    return sampler_2d(&s, SAMPLER_SOBOL_SETS);
}
__kernel void evaluate(__global float* out, __global const float4* inputs, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float4 v = inputs[i];
    out[i] = )" + expression + R"(;
}
)";
    Device& device = test_device();
    return run_kernel<float>(source, "evaluate",
                             Arguments().add(device.upload(inputs)).add(device.upload(albedo_tables())),
                             inputs.size());
}

double fresnel(double c, double eta) {
    const double sine2 = (1 - c * c) / (eta * eta);
    if (sine2 >= 1) return 1;
    const double t = std::sqrt(1 - sine2), s = (c - eta * t) / (c + eta * t),
                 p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

TEST(Fresnel, agrees_with_double) {
    // C12: indices near 1 and total reflection
    std::vector<std::array<float, 4>> inputs;
    for (float n : {1.01f, 1.1f, 1.33f, 1.5f, 1.72825f, 2.417f, 4.0f})
        for (float eta : {n, 1 / n})
            for (int i = 0; i <= 4096; ++i) inputs.push_back({i / 4096.0f, eta});
    const auto result = evaluate("fresnel_dielectric(v.x, v.y)", inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i)
        worst = std::max(worst, std::abs(result[i] - fresnel(inputs[i][0], inputs[i][1])));
    EXPECT_LE(worst, 3e-4);  // beside the critical angle, where the slope is infinite
    // normal incidence keeps its digits down to tiny differences of index
    for (float eta : {1.001f, 1.01f, 1.5f, 1 / 1.5f}) {
        const double r = std::pow((double(eta) - 1) / (double(eta) + 1), 2);
        EXPECT_NEAR(evaluate("fresnel_dielectric(v.x, v.y)", {{1, eta}})[0] / r, 1, 2e-6) << eta;
    }
    EXPECT_EQ(evaluate("fresnel_dielectric(v.x, v.y)", {{0.3f, 1}, {0, 1}, {0, 1.5f}}),
              (std::vector<float>{0, 0, 1}));
}

TEST(Fresnel, is_the_same_from_both_sides) {
    std::vector<std::array<float, 4>> outside, inside;
    for (float eta : {1.1f, 1.5f, 2.4f})
        for (int i = 10; i <= 100; ++i) {  // below, the rounding of the other side's cosine shows
            const double c = i / 100.0;
            outside.push_back({float(c), eta});
            inside.push_back({float(std::sqrt(1 - (1 - c * c) / (double(eta) * eta))), 1 / eta});
        }
    const auto a = evaluate("fresnel_dielectric(v.x, v.y)", outside),
               b = evaluate("fresnel_dielectric(v.x, v.y)", inside);
    const auto cosine = evaluate("fresnel_refracted_cosine(v.x, v.y)", outside);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i], b[i], 1e-5);
        EXPECT_NEAR(cosine[i], inside[i][0], 1e-6);
    }
}

TEST(Fresnel, total_reflection_begins_at_the_critical_angle) {
    for (const auto& [n, degrees] : {std::pair{1.5f, 41.810315}, std::pair{1.72825f, 35.353539}})
        for (double offset : {-1e-3, 1e-3}) {
            const float c = float(std::cos((degrees + offset) * pi / 180));
            EXPECT_EQ(evaluate("fresnel_dielectric(v.x, v.y)", {{c, 1 / n}})[0] == 1, offset > 0) << n;
        }
}

TEST(Ggx, distribution_keeps_its_digits_at_every_alpha) {
    // C10, over visible slopes: tan(theta_h) from 0 to 30 alpha
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (double alpha : {1e-4, 3e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0}) {
        std::vector<std::array<float, 4>> inputs;
        for (int i = 0; i < 100000; ++i) {
            const double t = 30 * alpha * unit(generator) * unit(generator), phi = 2 * pi * unit(generator);
            const double z = 1 / std::sqrt(1 + t * t);
            inputs.push_back(
                {float(t * z * std::cos(phi)), float(t * z * std::sin(phi)), float(z), float(alpha)});
        }
        const auto result = evaluate("ggx_distribution(v.xyz, v.w)", inputs);
        double worst = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const auto& [x, y, z, a] = inputs[i];
            const double xy = double(x) * x + double(y) * y, k = xy / (double(a) * a) + double(z) * z;
            const double l2 = xy + double(z) * z;  // of the rounded vector
            worst = std::max(worst, std::abs(result[i] * (pi * double(a) * a * k * k) / (l2 * l2) - 1));
        }
        EXPECT_LE(worst, 1e-5) << alpha;
    }
}

TEST(Ggx, masking_and_distribution_are_reciprocal) {
    std::mt19937 generator(4);
    std::uniform_real_distribution<float> unit(1e-3f, 1);
    std::vector<std::array<float, 4>> inputs(20000), swapped;
    for (auto& v : inputs) v = {unit(generator), unit(generator), unit(generator), 0};
    for (const auto& v : inputs) swapped.push_back({v[1], v[0], v[2], 0});
    const std::string f =
        "ggx_masking(v.x, ggx_stretch((float3)(0.0f, sqrt(1.0f - v.x * v.x), v.x), v.z), v.y, "
        "ggx_stretch((float3)(sqrt(1.0f - v.y * v.y), 0.0f, v.y), v.z)) / v.y";
    const auto a = evaluate(f, inputs), b = evaluate(f, swapped);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i] / b[i], 1, 1e-5);
}

TEST(Ggx, visible_normals_never_point_away) {
    // C11 with u at its ends, alpha 1e-4 .. 1, mu 1e-7 .. 1: (length error, NaN or back-facing marked by 1)
    std::vector<std::array<float, 4>> inputs;
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> unit(0, 1);
    const float end = 1 - 0x1p-24f;
    for (int i = 0; i < 200000; ++i) {
        const auto pick = [&](int bit) {
            return i & bit ? float(std::min(unit(generator), double(end))) : (i & bit * 2 ? end : 0.0f);
        };
        inputs.push_back({float(std::pow(10, -4 * unit(generator))),
                          float(std::pow(10, -7 * unit(generator))), pick(1), pick(4)});
    }
    const std::string wo = "(float3)(sqrt((1.0f - v.y) * (1.0f + v.y)), 0.0f, v.y)";
    for (const char* cap : {"1.0f", "ggx_cap(WO, v.x)"}) {
        std::string f = "ggx_sample(WO, v.x, ggx_stretch(WO, v.x), CAP, v.zw)", h = f;
        f = "math_dot(H, H) - 1.0f + (math_dot(H, WO) >= -1e-6f && H.z > 0.0f ? 0.0f : 1.0f)";
        const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
            for (std::size_t at; (at = text.find(from)) != std::string::npos;)
                text.replace(at, from.size(), to);
        };
        replace(f, "H", h), replace(f, "CAP", cap), replace(f, "WO", wo);
        for (float error : evaluate(f, inputs)) ASSERT_LE(std::abs(error), 1e-6) << cap;
    }
}

TEST(Ggx, share_of_reflections_below_the_horizon_is_the_closed_form) {
    // C11: at alpha 1 and without the bound it is mu / (1 + mu); with the bound nothing is wasted at mu 1,
    // alpha .7
    const int n = 1 << 17;
    for (float mu : {1.0f, 0.5f, 0.1f}) {
        std::vector<std::array<float, 4>> inputs;
        for (int i = 0; i < n; ++i) inputs.push_back({float(i), mu, 0, 0});
        const std::string wo = "(float3)(sqrt(1.0f - v.y * v.y), 0.0f, v.y)";
        const std::string u = "hashed(convert_uint(v.x))";
        const auto below = [&](const std::string& alpha, const std::string& cap) {
            double share = 0;
            for (float x :
                 evaluate("math_reflect(" + wo + ", ggx_sample(" + wo + ", " + alpha + ", ggx_stretch(" + wo +
                              ", " + alpha + "), " + cap + ", " + u + ")).z < 0.0f ? 1.0f : 0.0f",
                          inputs))
                share += x / n;
            return share;
        };
        const double expected = mu / (1 + mu);
        EXPECT_NEAR(below("1.0f", "1.0f"), expected, 5 * std::sqrt(expected * (1 - expected) / n)) << mu;
        if (mu == 1) {
            EXPECT_EQ(below("0.7f", "ggx_cap(" + wo + ", 0.7f)"), 0);
        }
        if (mu == 0.5f) {
            EXPECT_NEAR(below("0.7f", "ggx_cap(" + wo + ", 0.7f)"), 0.042, 0.004);
        }
    }
}

TEST(Albedo, tables_hold_the_known_values) {
    // D7: single-scattering albedo E(1), E(.2) and its cosine-weighted mean
    struct Row {
        float alpha, mean, one, fifth;
    };
    for (const Row& row : {Row{0.1f, 0.97165f, 0.98849f, 0.90468f}, Row{0.3f, 0.84687f, 0.87737f, 0.83852f},
                           Row{0.5f, 0.70026f, 0.68785f, 0.78993f}, Row{0.7f, 0.56632f, 0.50371f, 0.73072f},
                           Row{1, 0.40920f, 0.30685f, 0.64165f}}) {
        std::vector<std::array<float, 4>> inputs;
        const int n = 2000;
        for (int i = 0; i < n; ++i) inputs.push_back({(i + 0.5f) / n, std::sqrt(row.alpha), 0, 0});
        inputs.push_back({1, std::sqrt(row.alpha), 0, 0}),
            inputs.push_back({0.2f, std::sqrt(row.alpha), 0, 0});
        const auto e = evaluate("albedo_ggx(tables, sqrt(v.x), v.y).x", inputs);
        double mean = 0;
        for (int i = 0; i < n; ++i) mean += 2.0 * e[i] * inputs[i][0] / n;
        EXPECT_NEAR(mean / row.mean, 1, 0.0015) << row.alpha;
        EXPECT_NEAR(e[n] / row.one, 1, 0.004) << row.alpha;
        EXPECT_NEAR(e[n + 1] / row.fifth, 1, 0.004) << row.alpha;
    }
}

}  // namespace
