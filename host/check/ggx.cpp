// Fresnel factors, the GGX distribution and its albedo tables against double and closed forms.
#include <random>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/measurements.h"
#include "pack/albedo_tables.h"

namespace triad {
namespace {

std::vector<float> evaluate(Check& check, const std::string& expression,
                            const std::vector<std::array<float, 4>>& inputs) {
    const std::string source = R"(#include "common/random.h"
#include "shading/albedo.h"
#include "shading/fresnel.h"
#include "shading/ggx.h"
TRIAD_FUNCTION Vec2 hashed(uint index) {
    const Sampler s = sampler_make(1u, index, 0u, 0u, 1u);
    return sampler_2d(&s, SAMPLER_SOBOL_SETS);
}
__kernel void evaluate(__global float* out, __global const Vec4* inputs, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Vec4 v = inputs[i];
    out[i] = )" + expression + R"(;
}
)";
    return run_kernel<float>(
        check.device, source, "evaluate",
        Arguments().add(check.device.upload(inputs)).add(check.device.upload(albedo_tables())),
        inputs.size());
}

double fresnel(double c, double eta) {
    const double sine2 = (1 - c * c) / (eta * eta);
    if (sine2 >= 1) return 1;
    const double t = std::sqrt(1 - sine2), s = (c - eta * t) / (c + eta * t),
                 p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
}

void fresnel_agrees_with_double(Check& check) {
    // C12: indices near 1 and total reflection
    std::vector<std::array<float, 4>> inputs;
    for (float n : {1.01f, 1.1f, 1.33f, 1.5f, 1.72825f, 2.417f, 4.0f})
        for (float eta : {n, 1 / n})
            for (int i = 0; i <= 4096; ++i) inputs.push_back({i / 4096.0f, eta});
    const auto result = evaluate(check, "fresnel_dielectric(v.x, v.y)", inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i)
        worst = std::max(worst, std::abs(result[i] - fresnel(inputs[i][0], inputs[i][1])));
    check.at_most(worst, 3e-4, "Fresnel factor");  // beside the critical angle, where the slope is infinite
    // normal incidence keeps its digits down to tiny differences of index
    for (float eta : {1.001f, 1.01f, 1.5f, 1 / 1.5f}) {
        const double r = std::pow((double(eta) - 1) / (double(eta) + 1), 2);
        check.near(evaluate(check, "fresnel_dielectric(v.x, v.y)", {{1, eta}})[0] / r, 1, 2e-6,
                   "normal incidence, index ", eta);
    }
    check.equal(evaluate(check, "fresnel_dielectric(v.x, v.y)", {{0.3f, 1}, {0, 1}, {0, 1.5f}}),
                (std::vector<float>{0, 0, 1}), "Fresnel factor of index 1 or at grazing");
}

void fresnel_from_both_sides(Check& check) {
    std::vector<std::array<float, 4>> outside, inside;
    for (float eta : {1.1f, 1.5f, 2.4f})
        for (int i = 10; i <= 100; ++i) {  // below, the rounding of the other side's cosine shows
            const double c = i / 100.0;
            outside.push_back({float(c), eta});
            inside.push_back({float(std::sqrt(1 - (1 - c * c) / (double(eta) * eta))), 1 / eta});
        }
    const auto a = evaluate(check, "fresnel_dielectric(v.x, v.y)", outside),
               b = evaluate(check, "fresnel_dielectric(v.x, v.y)", inside);
    const auto cosine = evaluate(check, "fresnel_refracted_cosine(v.x, v.y)", outside);
    for (std::size_t i = 0; i < a.size(); ++i) {
        check.near(a[i], b[i], 1e-5, "Fresnel factor from the other side");
        check.near(cosine[i], inside[i][0], 1e-6, "refracted cosine");
    }
}

void critical_angle(Check& check) {
    for (const auto& [n, degrees] : {std::pair{1.5f, 41.810315}, std::pair{1.72825f, 35.353539}})
        for (double offset : {-1e-3, 1e-3}) {
            const float c = float(std::cos((degrees + offset) * pi / 180));
            check.equal(evaluate(check, "fresnel_dielectric(v.x, v.y)", {{c, 1 / n}})[0] == 1, offset > 0,
                        "total reflection beside the critical angle of ", n);
        }
}

void diffuse_fresnel(Check& check) {
    // D6: 2 times the integral of F(c) c over the cosine, by midpoints, from outside and inside
    struct Row {
        float n;
        double outside, inside;
    };
    for (const Row& row : {Row{1.5f, .091777959, .596345760}, Row{1.33f, .065930849, .471949149}})
        for (const auto& [eta, expected] : {std::pair{row.n, row.outside}, {1 / row.n, row.inside}}) {
            const int n = 1 << 16;
            std::vector<std::array<float, 4>> inputs;
            for (int i = 0; i < n; ++i) inputs.push_back({(i + 0.5f) / n, eta});
            const auto f = evaluate(check, "fresnel_dielectric(v.x, v.y)", inputs);
            double mean = 0;
            for (int i = 0; i < n; ++i) mean += 2.0 * f[i] * inputs[i][0] / n;
            check.near(mean, expected, 1e-5, "diffuse reflectance, index ", eta);
        }
}

void distribution_keeps_its_digits(Check& check) {
    // C10, over visible slopes: tan(theta_h) from 0 to 30 alpha
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> unit(0, 1);
    const int count = int(check.count(100000));
    for (double alpha : {1e-4, 3e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0}) {
        std::vector<std::array<float, 4>> inputs;
        for (int i = 0; i < count; ++i) {
            const double t = 30 * alpha * unit(generator) * unit(generator), phi = 2 * pi * unit(generator);
            const double z = 1 / std::sqrt(1 + t * t);
            inputs.push_back(
                {float(t * z * std::cos(phi)), float(t * z * std::sin(phi)), float(z), float(alpha)});
        }
        const auto result = evaluate(check, "ggx_distribution(vec4_xyz(v), v.w)", inputs);
        double worst = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const auto& [x, y, z, a] = inputs[i];
            const double xy = double(x) * x + double(y) * y, k = xy / (double(a) * a) + double(z) * z;
            const double l2 = xy + double(z) * z;  // of the rounded vector
            worst = std::max(worst, std::abs(result[i] * (pi * double(a) * a * k * k) / (l2 * l2) - 1));
        }
        check.at_most(worst, 1e-5, "D of alpha ", alpha);
    }
}

void masking_is_reciprocal(Check& check) {
    std::mt19937 generator(4);
    std::uniform_real_distribution<float> unit(1e-3f, 1);
    std::vector<std::array<float, 4>> inputs(check.count(20000)), swapped;
    for (auto& v : inputs) v = {unit(generator), unit(generator), unit(generator), 0};
    for (const auto& v : inputs) swapped.push_back({v[1], v[0], v[2], 0});
    const std::string f =
        "ggx_masking(v.x, ggx_stretch(vec3_make(0.0f, sqrt(1.0f - v.x * v.x), v.x), v.z), v.y, "
        "ggx_stretch(vec3_make(sqrt(1.0f - v.y * v.y), 0.0f, v.y), v.z)) / v.y";
    const auto a = evaluate(check, f, inputs), b = evaluate(check, f, swapped);
    for (std::size_t i = 0; i < a.size(); ++i) check.near(a[i] / b[i], 1, 1e-5, "masking swapped");
}

void visible_normals(Check& check) {
    // C11 with u at its ends, alpha 1e-4 .. 1, mu 1e-7 .. 1: (length error, NaN or back-facing marked by 1)
    std::vector<std::array<float, 4>> inputs;
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> unit(0, 1);
    const float end = 1 - 0x1p-24f;
    for (int i = 0, count = int(check.count(200000)); i < count; ++i) {
        const auto pick = [&](int bit) {
            return i & bit ? float(std::min(unit(generator), double(end))) : (i & bit * 2 ? end : 0.0f);
        };
        inputs.push_back({float(std::pow(10, -4 * unit(generator))),
                          float(std::pow(10, -7 * unit(generator))), pick(1), pick(4)});
    }
    const std::string wo = "vec3_make(sqrt((1.0f - v.y) * (1.0f + v.y)), 0.0f, v.y)";
    for (const char* cap : {"1.0f", "ggx_cap(WO, v.x)"}) {
        std::string f = "ggx_sample(WO, v.x, ggx_stretch(WO, v.x), CAP, vec2_make(v.z, v.w))", h = f;
        f = "vec3_dot(H, H) - 1.0f + (vec3_dot(H, WO) >= -1e-6f && H.z > 0.0f ? 0.0f : 1.0f)";
        const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
            for (std::size_t at; (at = text.find(from)) != std::string::npos;)
                text.replace(at, from.size(), to);
        };
        replace(f, "H", h), replace(f, "CAP", cap), replace(f, "WO", wo);
        for (float error : evaluate(check, f, inputs))
            check.at_most(std::abs(error), 1e-6, "length of a normal, cap ", cap);
    }
}

void share_below_the_horizon(Check& check) {
    // C11: at alpha 1 and without the bound it is mu / (1 + mu); with the bound nothing is wasted at mu 1,
    // alpha .7
    const int n = int(check.count(1 << 17));
    for (float mu : {1.0f, 0.5f, 0.1f}) {
        std::vector<std::array<float, 4>> inputs;
        for (int i = 0; i < n; ++i) inputs.push_back({float(i), mu, 0, 0});
        const std::string wo = "vec3_make(sqrt(1.0f - v.y * v.y), 0.0f, v.y)";
        const std::string u = "hashed(convert_uint(v.x))";
        const auto below = [&](const std::string& alpha, const std::string& cap) {
            double share = 0;
            for (float x :
                 evaluate(check,
                          "vec3_reflect(" + wo + ", ggx_sample(" + wo + ", " + alpha + ", ggx_stretch(" + wo +
                              ", " + alpha + "), " + cap + ", " + u + ")).z < 0.0f ? 1.0f : 0.0f",
                          inputs))
                share += x / n;
            return share;
        };
        const double expected = mu / (1 + mu);
        check.near(below("1.0f", "1.0f"), expected, 5 * std::sqrt(expected * (1 - expected) / n),
                   "share below the horizon at ", mu);
        if (mu == 1) {
            check.equal(below("0.7f", "ggx_cap(" + wo + ", 0.7f)"), 0, "share wasted at normal incidence");
        }
        if (mu == 0.5f) {
            check.near(below("0.7f", "ggx_cap(" + wo + ", 0.7f)"), 0.042, 5 * std::sqrt(0.042 / n),
                       "share wasted at 60 degrees");
        }
    }
}

void albedo_tables_hold_the_known_values(Check& check) {
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
        const auto e = evaluate(check, "albedo_ggx(tables, v.x, v.y).x", inputs);
        double mean = 0;
        for (int i = 0; i < n; ++i) mean += 2.0 * e[i] * inputs[i][0] / n;
        check.near(mean / row.mean, 1, 0.0015, "mean albedo of alpha ", row.alpha);
        check.near(e[n] / row.one, 1, 0.004, "albedo at 1 of alpha ", row.alpha);
        check.near(e[n + 1] / row.fifth, 1, 0.004, "albedo at .2 of alpha ", row.alpha);
    }
}

}  // namespace

void add_ggx(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C10", "GGX distribution at every alpha", quick, distribution_keeps_its_digits},
                     {"C11", "visible normals at grazing", quick, visible_normals},
                     {"C11b", "share of reflections below the horizon", standard, share_below_the_horizon},
                     {"C12", "Fresnel factor against double", quick, fresnel_agrees_with_double},
                     {"C12b", "Fresnel factor from both sides", quick, fresnel_from_both_sides},
                     {"C12c", "critical angle", standard, critical_angle},
                     {"B1", "masking is reciprocal", standard, masking_is_reciprocal},
                     {"D6", "diffuse Fresnel reflectance", quick, diffuse_fresnel},
                     {"D7", "albedo of GGX", quick, albedo_tables_hold_the_known_values},
                 });
}

}  // namespace triad
