// The glTF material: energy, sampling against pdf, eval against sample, closed forms, hostile input.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "render/albedo_tables.h"
#include "shading_fixture.h"

using namespace triad;

namespace {

/// A material and a direction wo = (sqrt(1 - mu^2), 0, mu).
struct Case {
    float base[3] = {1, 1, 1};
    float metallic = 0, roughness = 1, ior = 1.5f, specular = 1;
    float specular_colour[3] = {1, 1, 1};
    float transmission = 0, solid = 0, inside = 0;
    float mu = 1;
    float u_lobe = 0, u = 0, v = 0;  // used by `once`
    float unused[3] = {};
};
static_assert(sizeof(Case) == 80);

const char* const source = R"(#include "common/random.h"
#include "shading/bsdf.h"
typedef struct Case {
    float base[3], metallic, roughness, ior, specular, specular_colour[3], transmission, solid, inside, mu, u_lobe, u, v, unused[3];
} Case;
TRIAD_FUNCTION float3 make(const global Case* c, Bsdf* b, global const float* tables) {
    BsdfInput in;
    in.base_colour = vload3(0, c->base);
    in.metallic = c->metallic, in.roughness = c->roughness, in.ior = c->ior, in.specular = c->specular;
    in.specular_colour = vload3(0, c->specular_colour);
    in.transmission = c->transmission, in.solid = c->solid > 0.0f, in.inside = c->inside > 0.0f;
    const float3 wo = (float3)(sqrt((1.0f - c->mu) * (1.0f + c->mu)), 0.0f, c->mu);
    *b = bsdf_make(&in, wo, tables);
    return wo;
}
/* Change of radiance undone: what is left is energy. */
TRIAD_FUNCTION float energy_scale(const Bsdf* b, uint event) {
#if BSDF_TRANSMISSION
    return (event & BSDF_TRANSMIT) && b->transmits ? 1.0f / b->body_scale : 1.0f;
#else
    return 1.0f;
#endif
}
/* Mean energy over `samples` samples: out = (r, g, b, share of transmission), (largest |eval - weight pdf| / value, NaNs,
 * largest weight, samples that are not unit or on the wrong side). */
__kernel void furnace(__global float4* out, __global const Case* cases, __global const float* tables, uint samples, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const float3 wo = make(cases + i, &b, tables);
    float3 sum = (float3)(0.0f);
    float transmitted = 0.0f, difference = 0.0f, nans = 0.0f, largest = 0.0f, wrong = 0.0f;
    for (uint k = 0; k < samples; ++k) {
        const Sampler s = sampler_make(i, k, 0u, 0u, 3u);
        const BsdfSample a = bsdf_sample(&b, wo, sampler_2d(&s, 1u).x, sampler_2d(&s, 0u));
        const float3 w = a.weight * energy_scale(&b, a.event);
        sum += w;
        transmitted += a.event & BSDF_TRANSMIT ? math_average(w) : 0.0f;
        largest = math_max(math_max3(w), largest);
        nans += math_is_finite(w.x + w.y + w.z + a.pdf + a.wi.x + a.wi.y + a.wi.z) && math_min(w.x, math_min(w.y, w.z)) >= 0.0f ? 0.0f : 1.0f;
        if (a.event == BSDF_NONE) continue;
        wrong += fabs(math_dot(a.wi, a.wi) - 1.0f) < 2e-6f && (a.wi.z < 0.0f) == ((a.event & BSDF_TRANSMIT) != 0u) ? 0.0f : 1.0f;
        wrong += (a.pdf > 0.0f) == ((a.event & BSDF_DELTA) == 0u) ? 0.0f : 1.0f;
        if (a.pdf > 0.0f) {
            float pdf;
            const float3 f = bsdf_eval(&b, wo, a.wi, &pdf), d = fabs(f - a.weight * a.pdf);
            difference = math_max((math_max3(d) + fabs(pdf - a.pdf)) / (math_max3(f) + pdf), difference);
        }
    }
    out[2 * i] = (float4)(sum, transmitted) / convert_float(samples);
    out[2 * i + 1] = (float4)(difference, nans, largest, wrong);
}
/* Many samples of cases[0]: (wi, pdf). */
__kernel void draw(__global float4* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const float3 wo = make(cases, &b, tables);
    const Sampler s = sampler_make(1u, i, 0u, 0u, 9u);
    const BsdfSample a = bsdf_sample(&b, wo, sampler_2d(&s, SAMPLER_SOBOL_SETS).x, sampler_2d(&s, SAMPLER_SOBOL_SETS + 1u));
    out[i] = a.event == BSDF_NONE ? (float4)(0.0f) : (float4)(a.wi, a.pdf);
}
/* Integral of the pdf over the cells of a grid in (cos theta, phi), by 64 x 32 midpoints each. */
__kernel void integrate(__global float* out, __global const Case* cases, __global const float* tables, uint rows,
                        uint columns, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const float3 wo = make(cases, &b, tables);
    float sum = 0.0f;
    for (uint j = 0; j < 2048; ++j) {
        const float z = -1.0f + 2.0f * (convert_float(i / columns) + (convert_float(j / 32) + 0.5f) / 64) / rows;
        float s, c, pdf;
        math_sincos_turns((convert_float(i % columns) + (convert_float(j % 32) + 0.5f) / 32) / columns, &s, &c);
        const float r = sqrt((1.0f - z) * (1.0f + z));
        bsdf_eval(&b, wo, (float3)(r * c, r * s, z), &pdf);
        sum += pdf;
    }
    out[i] = sum * (4.0f * MATH_PI) / (convert_float(rows * columns) * 2048.0f);
}
/* One sample with the random numbers of the case: (wi, pdf), (weight, event). */
__kernel void once(__global float4* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const float3 wo = make(cases + i, &b, tables);
    const BsdfSample a = bsdf_sample(&b, wo, cases[i].u_lobe, (float2)(cases[i].u, cases[i].v));
    float pdf;
    const float3 f = bsdf_eval(&b, wo, math_normalize((float3)(cases[i].v - 0.5f, cases[i].u - 0.5f, 0.1f + cases[i].u_lobe)), &pdf);
    out[3 * i] = (float4)(a.wi, a.pdf);
    out[3 * i + 1] = (float4)(a.weight, convert_float(a.event));
    out[3 * i + 2] = (float4)(f, pdf);
}
#if BSDF_TRANSMISSION
/* n^2 f(o -> i) and f(i -> o) of a rough body, without the energy compensation of either side. */
__kernel void reverse(__global float2* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const float3 wo = make(cases + i, &b, tables);
    b.transmitter = (float3)(1.0f);
    const float3 wi = bsdf_sample(&b, wo, 0.999f, (float2)(cases[i].u, cases[i].v)).wi;
    float pdf;
    const float there = wi.z < 0.0f ? bsdf_eval(&b, wo, wi, &pdf).x : 0.0f;
    BsdfInput in;
    in.base_colour = in.specular_colour = (float3)(1.0f);
    in.metallic = 0.0f, in.roughness = cases[i].roughness, in.ior = cases[i].ior, in.specular = 1.0f;
    in.transmission = 1.0f, in.solid = 1u, in.inside = 1u;
    Bsdf back = bsdf_make(&in, -wi, tables);
    back.transmitter = (float3)(1.0f);
    const float here = bsdf_eval(&back, -wi, -wo, &pdf).x;
    out[i] = wi.z < 0.0f ? (float2)(there * in.ior * in.ior / -wi.z, here / wo.z) : (float2)(0.0f);
}
#endif
)";

using Four = std::array<float, 4>;

struct Furnace {
    float r, g, b, transmitted, difference, nans, largest, wrong;
};

Buffer tables() {
    static const Buffer buffer = test_device().upload(albedo_tables());
    return buffer;
}

std::vector<Furnace> furnace(const std::vector<Case>& cases, std::uint32_t samples,
                             const Options& options = {}) {
    return run_kernel<Furnace>(source, "furnace",
                               Arguments().add(test_device().upload(cases)).add(tables()).add(samples),
                               cases.size(), 1, options);
}

void expect_sound(const Furnace& f, const Case& c) {
    const std::string what = " roughness " + std::to_string(c.roughness) + " mu " + std::to_string(c.mu) +
                             " ior " + std::to_string(c.ior) + " transmission " +
                             std::to_string(c.transmission);
    EXPECT_EQ(f.nans, 0) << what;
    EXPECT_EQ(f.wrong, 0) << what;
    EXPECT_LE(f.difference, 1e-4) << what;
}

const std::vector<float> roughnesses = {0.001f, 0.02f, 0.04f, 0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.75f, 0.9f, 1};
const std::vector<float> cosines = {0.02f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1};

/// Furnace of a white material over roughness x mu: the energy may be off by `worst` anywhere and by `mean`
/// in the cosine-weighted mean over all directions of each roughness.
void expect_furnace(Case c, double worst, double mean, std::uint32_t samples = 1 << 13) {
    std::vector<Case> cases;
    for (float roughness : roughnesses)
        for (float mu : cosines) c.roughness = roughness, c.mu = mu, cases.push_back(c);
    const auto results = furnace(cases, samples);
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        expect_sound(results[i], cases[i]);
        EXPECT_NEAR(results[i].r, 1, worst) << "roughness " << cases[i].roughness << ", mu " << cases[i].mu;
        sum += (results[i].r - 1) * cases[i].mu, weight += cases[i].mu;
        if (cases[i].mu < 1) continue;
        EXPECT_NEAR(sum / weight, 0, mean) << "roughness " << cases[i].roughness;
        sum = weight = 0;
    }
}

TEST(Bsdf, furnace_white_metal) { expect_furnace({.metallic = 1}, 0.006, 0.0015); }
TEST(Bsdf, furnace_white_coated_diffuse) {
    for (float ior : {0.0f, 1.0f, 1.5f, 2.5f}) expect_furnace({.ior = ior}, 0.006, 0.0015);
}
TEST(Bsdf, furnace_half_metal_half_transmission) {
    expect_furnace({.metallic = 0.5f, .specular = 0.6f, .transmission = 0.5f}, 0.006, 0.0015, 1 << 15);
}
TEST(Bsdf, furnace_thin_wall) {
    for (float ior : {1.0f, 1.5f, 2.5f}) expect_furnace({.ior = ior, .transmission = 1}, 0.006, 0.0015);
}
TEST(Bsdf, furnace_solid_body) {
    for (float ior : {1.0f, 1.009f, 1.1f, 1.33f, 1.5f, 1.8f, 2.417f, 3.5f})
        for (float inside : {0.0f, 1.0f})
            expect_furnace({.ior = ior, .transmission = 1, .solid = 1, .inside = inside}, 0.025, 0.005);
}
TEST(Bsdf, furnace_solid_body_of_nearly_the_same_index) {
    // grazing total reflection of an index just above the smooth ones is the worst of the tables
    for (float inside : {0.0f, 1.0f})
        expect_furnace({.ior = 1.011f, .transmission = 1, .solid = 1, .inside = inside}, 0.15, 0.01);
}
TEST(Bsdf, furnace_solid_body_with_another_reflectance) {
    for (float inside : {0.0f, 1.0f})
        expect_furnace({.specular = 0, .transmission = 1, .solid = 1, .inside = inside}, 0.025, 0.004);
}

TEST(Bsdf, random_materials_never_gain_energy) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto number = [&] {
        return std::min(std::max(1.4f * unit(generator) - 0.2f, 0.0f), 1.0f);
    };  // 0 and 1 often
    std::vector<Case> cases;
    for (int i = 0; i < 3000; ++i) {
        Case c;
        for (float& x : c.base) x = number();
        for (float& x : c.specular_colour) x = number();
        c.metallic = number(), c.roughness = number(), c.specular = number(), c.transmission = number();
        c.ior = i % 10 ? 1 + 2 * number() : 0;
        c.solid = float(i % 2), c.inside = float(i % 4 == 3);
        c.mu = i % 3 ? number() * 0.999f + 0.001f : std::pow(10.0f, -7 * unit(generator));
        cases.push_back(c);
    }
    const auto results = furnace(cases, 1 << 10);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Furnace& f = results[i];
        expect_sound(f, cases[i]);
        // table error, and 1024 samples of weights of at most `largest`
        EXPECT_LE(std::max({f.r, f.g, f.b}), 1.02 + 0.03 * f.largest) << i;
    }
}

TEST(Bsdf, samples_follow_the_pdf) {
    // 2^18 samples over 32 x 32 cells of equal solid angle and the pdf integrated by 64 x 32 points per cell
    const std::size_t rows = 32, columns = 32, count = 1 << 18;
    std::vector<Case> materials = {
        {.specular = 0},
        {.metallic = 1, .roughness = 0.3f},
        {.metallic = 1, .roughness = 0.6f},
        {.metallic = 1, .roughness = 1},
        {.base = {0.5f, 0.3f, 0.1f}, .roughness = 0.5f},
        {.base = {0.2f, 0.9f, 0.5f}, .metallic = 0.3f, .roughness = 0.7f, .transmission = 0.4f},
        {.roughness = 0.5f, .transmission = 1},
        {.roughness = 1, .ior = 2.5f, .transmission = 1},
        {.roughness = 0.6f, .transmission = 1, .solid = 1},
        {.roughness = 0.6f, .transmission = 1, .solid = 1, .inside = 1},
        {.roughness = 1, .ior = 2.2f, .transmission = 0.8f, .solid = 1},
        {.roughness = 1, .ior = 2.2f, .transmission = 1, .solid = 1, .inside = 1},
    };
    for (std::size_t m = 0; m < materials.size(); ++m)
        for (float mu : {1.0f, 0.6f, 0.15f}) {
            Case c = materials[m];
            c.mu = mu;
            const Buffer buffer = test_device().upload(std::vector<Case>{c});
            const Arguments arguments = Arguments().add(buffer).add(tables());
            const auto samples = run_kernel<Four>(source, "draw", arguments, count);
            const auto integral = run_kernel<float>(
                source, "integrate",
                Arguments(arguments).add(std::uint32_t(rows)).add(std::uint32_t(columns)), rows * columns);
            std::vector<double> counts(rows * columns), expected;
            double total = 0, inverse = 0;
            for (float p : integral) expected.push_back(p * double(count)), total += p;
            for (const Four& s : samples) {
                if (s[3] <= 0) continue;
                const double turn = std::atan2(s[1], s[0]) / (2 * pi);
                const auto row = std::min(rows - 1, std::size_t((s[2] + 1) / 2 * rows));
                const auto column =
                    std::min(columns - 1, std::size_t((turn < 0 ? turn + 1 : turn) * columns));
                ++counts[row * columns + column];
                inverse += 1 / double(count);
            }
            EXPECT_LT(chi_square_z(counts, expected), chi_square_limit) << "material " << m << ", mu " << mu;
            // the pdf integrates to 1 less the share of samples that end in the surface
            EXPECT_NEAR(total, inverse, 5 * std::sqrt(0.25 / count)) << "material " << m << ", mu " << mu;
        }
}

std::vector<Four> once(const std::vector<Case>& cases, const Options& options = {}) {
    return run_kernel<Four>(source, "once", Arguments().add(test_device().upload(cases)).add(tables()),
                            cases.size(), 3, options);
}

TEST(Bsdf, without_specular_it_is_lambert_to_the_bit) {
    std::vector<Case> cases;
    for (int i = 0; i < 4096; ++i)
        cases.push_back({.base = {0.8f, 0.25f, i / 4096.0f},
                         .roughness = (i % 7) / 6.0f,
                         .specular = 0,
                         .mu = 0.01f + (i % 90) * 0.011f,
                         .u_lobe = (i % 64) / 64.0f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 59.0f});
    const auto general = once(cases), lambert = once(cases, {{"TRIAD_SPECULAR", "0"}});
    ASSERT_EQ(std::memcmp(general.data(), lambert.data(), general.size() * sizeof(Four)), 0);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(general[3 * i + 1][0], cases[i].base[0]);  // the weight is the albedo
        EXPECT_NEAR(general[3 * i][3], general[3 * i][2] / pi, 1e-7);
    }
}

TEST(Bsdf, without_transmission_the_specialised_program_gives_the_same_bits) {
    std::vector<Case> cases;
    for (int i = 0; i < 8192; ++i)
        cases.push_back({.base = {0.8f, 0.25f, i / 8192.0f},
                         .metallic = (i % 3) / 2.0f,
                         .roughness = (i % 12) / 11.0f,
                         .mu = 0.01f + (i % 90) * 0.011f,
                         .u_lobe = (i % 64) / 64.0f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 59.0f});
    const auto general = once(cases), opaque = once(cases, {{"TRIAD_TRANSMISSION", "0"}});
    ASSERT_EQ(std::memcmp(general.data(), opaque.data(), general.size() * sizeof(Four)), 0);
}

double interface_reflectance(double degrees, double n) {
    const double c = std::cos(degrees * pi / 180), t = std::sqrt(1 - (1 - c * c) / (n * n));
    const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (s * s + p * p) / 2;
}

TEST(Bsdf, smooth_thin_wall_transmits_like_a_slab) {
    // D4: both faces and all reflections between them, unpolarised per interface
    struct Row {
        float ior;
        double degrees, transmitted;
    };
    for (const Row& row : {Row{1.5f, 0, .923076923}, Row{1.72825f, 0, .866975602}, Row{2.417f, 0, .706530024},
                           Row{1.5f, 30, .920265533}, Row{1.5f, 60, .836232463}, Row{1.5f, 80, .441229173}}) {
        const auto f = furnace({{.roughness = 0,
                                 .ior = row.ior,
                                 .transmission = 1,
                                 .mu = float(std::cos(row.degrees * pi / 180))}},
                               4096)[0];
        EXPECT_NEAR(f.transmitted, row.transmitted, 2e-3 * row.transmitted)
            << row.ior << " at " << row.degrees;
        EXPECT_NEAR(f.r, 1, 1e-5);
        const auto w = once({{.base = {0.5f, 0.5f, 0.5f},
                              .roughness = 0,
                              .ior = row.ior,
                              .transmission = 1,
                              .mu = 0.6f,
                              .u_lobe = 0.9999f}});
        EXPECT_EQ(w[0][0], -0.8f);
        EXPECT_EQ(w[0][2], -0.6f);
    }
}

TEST(Bsdf, smooth_body_refracts_by_snell_and_fresnel) {
    for (double degrees : {0.0, 20.0, 45.0, 70.0, 89.0}) {
        const Case c{.roughness = 0,
                     .ior = 1.5f,
                     .transmission = 1,
                     .solid = 1,
                     .mu = float(std::cos(degrees * pi / 180)),
                     .u_lobe = 0.99999f};
        const auto out = once({c});
        const double sine = std::sin(degrees * pi / 180) / 1.5, r = interface_reflectance(degrees, 1.5);
        EXPECT_NEAR(out[0][0], -sine, 1e-6);
        EXPECT_NEAR(out[0][2], -std::sqrt(1 - sine * sine), 1e-6);
        EXPECT_NEAR(out[1][0] * 2.25f, 1, 1e-5);  // (1 - F) / n^2 over its probability 1 - F
        EXPECT_EQ(int(out[1][3]), 4 | 8);
        const auto f = furnace({c}, 1 << 14)[0];
        EXPECT_NEAR(f.transmitted, 1 - r, 1e-3);
    }
    // beyond the critical angle from inside everything reflects; an index of 1 is no interface
    const auto total =
        furnace({{.roughness = 0, .transmission = 1, .solid = 1, .inside = 1, .mu = 0.7f}}, 256)[0];
    EXPECT_EQ(total.transmitted, 0);
    EXPECT_NEAR(total.r, 1, 1e-6);
    const auto same =
        once({{.roughness = 0.7f, .ior = 1, .transmission = 1, .solid = 1, .mu = 0.6f, .u_lobe = 0.3f}});
    EXPECT_EQ((Four{same[0][0], same[0][1], same[0][2], same[1][0]}), (Four{-0.8f, 0, -0.6f, 1}));
}

TEST(Bsdf, rough_refraction_is_reciprocal_up_to_the_index_squared) {
    std::vector<Case> cases;
    for (int i = 0; i < 4000; ++i)
        cases.push_back({.roughness = 0.3f + (i % 8) * 0.1f,
                         .ior = i % 2 ? 1.5f : 2.2f,
                         .transmission = 1,
                         .solid = 1,
                         .mu = 0.1f + (i % 50) * 0.018f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 60.0f});
    const auto both = run_kernel<std::array<float, 2>>(
        source, "reverse", Arguments().add(test_device().upload(cases)).add(tables()), cases.size());
    int compared = 0;
    for (const auto& [there, here] : both)
        if (there > 1e-4f) {
            EXPECT_NEAR(there / here, 1, 2e-4);
            ++compared;
        }
    EXPECT_GT(compared, 2000);
}

TEST(Bsdf, degenerate_input_gives_no_nan) {
    std::vector<Case> cases;
    const float end = 1 - 0x1p-24f;
    for (float mu : {1e-30f, 1e-12f, 1e-6f, 1e-3f, 0.5f, 1.0f})
        for (float roughness : {0.0f, 0.0316f, 0.032f, 0.2f, 1.0f})
            for (int k = 0; k < 216; ++k) {
                Case c{.metallic = (k % 3) / 2.0f, .roughness = roughness, .mu = mu};
                c.transmission = (k / 3 % 3) / 2.0f, c.solid = float(k / 9 % 2), c.inside = float(k / 18 % 2);
                c.ior = std::array{0.0f, 1.0f, 1.5f}[k / 36 % 3],
                c.base[0] = c.base[1] = c.base[2] = float(k / 108);
                for (int u = 0; u < 8; ++u) {
                    c.u_lobe = u & 1 ? end : 0, c.u = u & 2 ? end : 0.5f, c.v = u & 4 ? end : 0;
                    cases.push_back(c);
                }
            }
    for (const Four& row : once(cases))
        for (float x : row) ASSERT_TRUE(std::isfinite(x));
}

}  // namespace
