#pragma once
/// The glTF material as kernels: what the cases on its energy, sampling and closed forms share.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "check/kernels.h"
#include "check/measurements.h"
#include "pack/albedo_tables.h"
#include "pack/pack.h"

namespace triad::bsdf_case {

/// A material and a direction wo = (sqrt(1 - mu^2), 0, mu).
struct Case {
    float base[3] = {1, 1, 1};
    float metallic = 0, roughness = 1, ior = 1.5f, specular = 1;
    float specular_colour[3] = {1, 1, 1};
    float transmission = 0, solid = 0, inside = 0;
    float mu = 1;
    float u_through = 0, u = 0, v = 0;                  // used by `once`
    float coat = 0, coat_roughness = 0, coat_tilt = 0;  // radians from z towards x
    float sheen = 0, sheen_roughness = 0.5f;            // white
    float anisotropy = 0, azimuth = 0;                  // of wo, in turns
    float film = 0, film_ior = 1.3f, film_thickness = 400;
    float through = 0;  // white
};
static_assert(sizeof(Case) == 112);

inline const char* const source = R"(#include "common/random.h"
#include "shading/bsdf.h"
typedef struct Case {
    float base[3], metallic, roughness, ior, specular, specular_colour[3], transmission, solid, inside, mu, u_through, u, v,
        coat, coat_roughness, coat_tilt, sheen, sheen_roughness, anisotropy, azimuth, film, film_ior, film_thickness, through;
} Case;
TRIAD_FUNCTION BsdfInput input_of(const global Case* c, global const float* tables) {
    (void)tables;
    BsdfInput in = bsdf_input_plain(vec3_splat(1.0f));
    in.base_colour = VEC3_OF(c->base);
    in.metallic = c->metallic, in.roughness = c->roughness, in.ior = c->ior, in.specular = c->specular;
    in.specular_colour = VEC3_OF(c->specular_colour);
    in.transmission = c->transmission, in.solid = c->solid > 0.0f, in.inside = c->inside > 0.0f;
#if TRIAD_CLEARCOAT
    in.coat = c->coat, in.coat_roughness = c->coat_roughness;
    in.coat_normal = vec3_make(math_sin(c->coat_tilt), 0.0f, math_cos(c->coat_tilt));
#endif
#if TRIAD_SHEEN
    in.sheen = colour_splat(c->sheen), in.sheen_roughness = c->sheen_roughness;
#endif
#if BSDF_STRETCHED
    in.anisotropy = c->anisotropy;
#endif
#if BSDF_FILM
    in.film = c->film, in.film_input.ior = c->film_ior, in.film_input.thickness = c->film_thickness;
    in.film_input.responses = tables + ALBEDO_FLOATS;
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    in.through = c->through, in.through_colour = colour_splat(1.0f);
#endif
    return in;
}
TRIAD_FUNCTION Vec3 make(const global Case* c, Bsdf* b, global const float* tables) {
    const BsdfInput in = input_of(c, tables);
    const float side = sqrt((1.0f - c->mu) * (1.0f + c->mu));
    float sine, cosine;
    math_sincos_turns(c->azimuth, &sine, &cosine);
    const Vec3 wo = vec3_make(side * cosine, side * sine, c->mu);
    *b = bsdf_make(&in, wo, tables);
    return wo;
}
/* Change of radiance undone: what is left is energy. */
TRIAD_FUNCTION float energy_scale(const Bsdf* b, uint event) {
#if BSDF_TRANSMISSION
    return (event & BSDF_TRANSMIT) && !(event & BSDF_DIFFUSE) ? 1.0f / bsdf_body_scale(b) : 1.0f;
#else
    return 1.0f;
#endif
}
/* Energy of samples [part * each, min(samples, (part + 1) * each)) of a case: out = (r, g, b, transmission),
 * (largest |eval - weight pdf| / value, NaNs, largest weight, samples that are not unit or on the wrong side). */
__kernel void furnace(__global Vec4* out, __global const Case* cases, __global const float* tables, uint samples,
                      uint each, uint parts, uint first_case, uint count) {
    const uint item = get_global_id(0), i = first_case + item / parts, first = item % parts * each;
    if (item >= count) return;
    Bsdf b;
    const Vec3 wo = make(cases + i, &b, tables);
    Vec3 sum = vec3_splat(0.0f);
    float transmitted = 0.0f, difference = 0.0f, nans = 0.0f, largest = 0.0f, wrong = 0.0f;
    for (uint k = first; k < min(samples, first + each); ++k) {
        const Sampler s = sampler_make(i, k, 0u, 0u, 3u);
        const BsdfSample a = bsdf_sample(&b, wo, sampler_2d(&s, 1u).x, sampler_2d(&s, 0u));
        const Vec3 w = colour_scale(a.weight, energy_scale(&b, a.event));
        sum = vec3_add(sum, w);
        transmitted += a.event & BSDF_TRANSMIT ? vec3_average(w) : 0.0f;
        largest = math_max(vec3_largest(w), largest);
        nans += math_is_finite(w.x + w.y + w.z + a.pdf + a.wi.x + a.wi.y + a.wi.z) && math_min(w.x, math_min(w.y, w.z)) >= 0.0f ? 0.0f : 1.0f;
        if (a.event == BSDF_NONE) continue;
        wrong += fabs(vec3_dot(a.wi, a.wi) - 1.0f) < 2e-6f && (a.wi.z < 0.0f) == ((a.event & BSDF_TRANSMIT) != 0u) ? 0.0f : 1.0f;
        wrong += (a.pdf > 0.0f) == ((a.event & BSDF_DELTA) == 0u) ? 0.0f : 1.0f;
        if (a.pdf > 0.0f) {
            float pdf;
            const Vec3 f = bsdf_eval(&b, wo, a.wi, &pdf), d = vec3_abs(vec3_sub(f, vec3_scale(a.weight, a.pdf)));
            difference = math_max((vec3_largest(d) + fabs(pdf - a.pdf)) / (vec3_largest(f) + pdf), difference);
        }
    }
    out[2 * item] = vec3_with(sum, transmitted);
    out[2 * item + 1] = vec4_make(difference, nans, largest, wrong);
}
/* Many samples of cases[0]: (wi, pdf). */
__kernel void draw(__global Vec4* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const Vec3 wo = make(cases, &b, tables);
    const Sampler s = sampler_make(1u, i, 0u, 0u, 9u);
    const BsdfSample a = bsdf_sample(&b, wo, sampler_2d(&s, SAMPLER_SOBOL_SETS).x, sampler_2d(&s, SAMPLER_SOBOL_SETS + 1u));
    out[i] = a.event == BSDF_NONE ? vec4_splat(0.0f) : vec3_with(a.wi, a.pdf);
}
/* Integral of the pdf over the cells of a grid in (cos theta, phi), by 2 parts x parts midpoints each, of which an item
 * takes two rows. */
__kernel void integrate(__global float* out, __global const Case* cases, __global const float* tables, uint rows,
                        uint columns, uint parts, uint count) {
    const uint item = get_global_id(0), i = item / parts;
    if (item >= count) return;
    Bsdf b;
    const Vec3 wo = make(cases, &b, tables);
    float sum = 0.0f;
    for (uint j = item % parts * 2u * parts; j < (item % parts + 1u) * 2u * parts; ++j) {
        const float z = -1.0f + 2.0f * (convert_float(i / columns) + (convert_float(j / parts) + 0.5f) / (2u * parts)) / rows;
        float s, c, pdf;
        math_sincos_turns((convert_float(i % columns) + (convert_float(j % parts) + 0.5f) / parts) / columns, &s, &c);
        const float r = sqrt((1.0f - z) * (1.0f + z));
        bsdf_eval(&b, wo, vec3_make(r * c, r * s, z), &pdf);
        sum += pdf;
    }
    out[item] = sum * (4.0f * MATH_PI) / (convert_float(rows * columns) * convert_float(2u * parts * parts));
}
/* One sample with the random numbers of the case: (wi, pdf), (weight, event). */
__kernel void once(__global Vec4* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const Vec3 wo = make(cases + i, &b, tables);
    const BsdfSample a = bsdf_sample(&b, wo, cases[i].u_through, vec2_make(cases[i].u, cases[i].v));
    float pdf;
    const Vec3 f = bsdf_eval(&b, wo, vec3_normalize(vec3_make(cases[i].v - 0.5f, cases[i].u - 0.5f, 0.1f + cases[i].u_through)), &pdf);
    out[3 * i] = vec3_with(a.wi, a.pdf);
    out[3 * i + 1] = vec3_with(a.weight, (float)a.event);
    out[3 * i + 2] = vec3_with(f, pdf);
}
#if BSDF_TRANSMISSION
/* n^2 f(o -> i) and f(i -> o) of a rough body, without the energy compensation of either side. */
__kernel void reverse(__global Vec2* out, __global const Case* cases, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Bsdf b;
    const Vec3 wo = make(cases + i, &b, tables);
    b.base.transmitter = vec3_splat(1.0f);
    const Vec3 wi = bsdf_sample(&b, wo, 0.999f, vec2_make(cases[i].u, cases[i].v)).wi;
    float pdf;
    const float there = wi.z < 0.0f ? bsdf_eval(&b, wo, wi, &pdf).x : 0.0f;
    BsdfInput in = input_of(cases + i, tables);
    in.inside = 1u;
    Bsdf back = bsdf_make(&in, vec3_negate(wi), tables);
    back.base.transmitter = vec3_splat(1.0f);
    const float here = bsdf_eval(&back, vec3_negate(wi), vec3_negate(wo), &pdf).x;
    out[i] = wi.z < 0.0f ? vec2_make(there * in.ior * in.ior / -wi.z, here / wo.z) : vec2_splat(0.0f);
}
#endif
)";

using Four = std::array<float, 4>;

/// Some thousand plain materials, directions and random numbers, for comparing programs to the bit.
inline std::vector<Case> many_cases(const Check& check) {
    std::vector<Case> cases;
    const int count = int(check.count(4096, 512));
    for (int i = 0; i < count; ++i)
        cases.push_back({.base = {0.8f, 0.25f, float(i) / float(count)},
                         .metallic = (i % 3) / 2.0f,
                         .roughness = (i % 12) / 11.0f,
                         .mu = 0.01f + (i % 90) * 0.011f,
                         .u_through = (i % 64) / 64.0f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 59.0f});
    return cases;
}

struct Furnace {
    float r = 0, g = 0, b = 0, transmitted = 0, difference = 0, nans = 0, largest = 0, wrong = 0;
};

/// The albedo tables and, behind them, the responses of thin films.
inline Buffer tables(Check& check) {
    std::vector<float> all = albedo_tables();
    const std::vector<float> films = film_responses();
    all.insert(all.end(), films.begin(), films.end());
    return check.device.upload(all);
}

/// Of one item: llvmpipe ends an item's loops after 65,535 rounds in all, and a GPU has other items to run.
constexpr std::uint32_t furnace_samples_of_an_item = 256;
/// A device that answers late is taken for one that hangs.
constexpr std::size_t furnace_samples_of_a_launch = 1u << 20;

/// Means over samples.
inline std::vector<Furnace> furnace(Check& check, const std::vector<Case>& cases, std::uint32_t samples,
                                    const Options& options = {}) {
    const std::uint32_t each = furnace_samples_of_an_item, parts = (samples + each - 1) / each;
    const std::size_t most = std::max<std::size_t>(1, furnace_samples_of_a_launch / samples);
    const Buffer all_cases = check.device.upload(cases), all_tables = tables(check);
    std::vector<Furnace> all;
    for (std::size_t first = 0; first < cases.size(); first += most) {
        const std::size_t count = std::min(most, cases.size() - first);
        const auto some = run_kernel<Furnace>(check.device, source, "furnace",
                                              Arguments()
                                                  .add(all_cases)
                                                  .add(all_tables)
                                                  .add(samples)
                                                  .add(each)
                                                  .add(parts)
                                                  .add(std::uint32_t(first)),
                                              count * parts, 1, options);
        all.insert(all.end(), some.begin(), some.end());
    }
    std::vector<Furnace> means;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        double sums[4] = {};
        Furnace& of = means.emplace_back();
        for (std::size_t part = 0; part < parts; ++part) {
            const Furnace& f = all[i * parts + part];
            sums[0] += f.r, sums[1] += f.g, sums[2] += f.b, sums[3] += f.transmitted;
            of.difference = std::max(of.difference, f.difference), of.nans += f.nans;
            of.largest = std::max(of.largest, f.largest), of.wrong += f.wrong;
        }
        of.r = float(sums[0] / samples), of.g = float(sums[1] / samples), of.b = float(sums[2] / samples);
        of.transmitted = float(sums[3] / samples);
    }
    return means;
}

inline void expect_sound(Check& check, const Furnace& f, const Case& c) {
    const std::string what = " roughness " + std::to_string(c.roughness) + " mu " + std::to_string(c.mu) +
                             " ior " + std::to_string(c.ior) + " transmission " +
                             std::to_string(c.transmission);
    check.at_most(f.nans, 0, "NaNs,", what);
    check.at_most(f.wrong, 0, "directions that cannot be,", what);
    check.at_most(f.difference, 1e-4, "eval against sample,", what);
}

inline std::vector<Four> once(Check& check, const std::vector<Case>& cases, const Options& options = {}) {
    return run_kernel<Four>(check.device, source, "once",
                            Arguments().add(check.device.upload(cases)).add(tables(check)), cases.size(), 3,
                            options);
}

}  // namespace triad::bsdf_case
