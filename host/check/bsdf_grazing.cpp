// The material's extensions at grazing angles and at the ends of their parameters: finite, no light made,
// reciprocal where they are meant to be, and nothing where their factors are 0.
#include "check/bsdf_case.h"
#include "check/cases.h"

namespace triad {
namespace {

using namespace bsdf_case;

const std::vector<float> grazing_cosines = {1e-30f, 1e-12f, 1e-8f, 1e-6f,  1e-5f, 1e-4f,
                                            3e-4f,  1e-3f,  3e-3f, 0.015f, 0.1f,  1.0f};

/// Everything is finite and not negative, and no channel gives back more than came, up to `slack` and the
/// noise of weights of at most `largest`.
void expect_no_gain(Check& check, const std::string& what, const std::vector<Case>& materials, double slack) {
    std::vector<Case> cases;
    for (Case c : materials)
        for (float mu : grazing_cosines) c.mu = mu, cases.push_back(c);
    const auto samples = check.level == CheckLevel::tiny ? 64u : std::uint32_t(check.count(1 << 14, 1 << 12));
    const auto results = furnace(check, cases, samples);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Furnace& f = results[i];
        expect_sound(check, f, cases[i]);
        const double noise = 0.25 / std::sqrt(samples) * f.largest;
        check.at_most(std::max({f.r, f.g, f.b}), 1 + slack + noise, "energy of ", what, " at mu ",
                      cases[i].mu, ", material ", i / grazing_cosines.size());
    }
}

const char* const swapped_source = R"(
/* Value over cosine of one lobe, there and back, without what depends on wo alone: the sheen's, the varnish's
 * or the microfacets' of a white metal. 0 where one of the directions cannot be. wi: cosine u, turns v. */
__kernel void swapped(__global Vec2* out, __global const Case* cases, __global const float* tables, uint lobe, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BsdfInput in = input_of(cases + i, tables);
    Bsdf there;
    const Vec3 wo = make(cases + i, &there, tables);
    float sine, cosine, unused;
    math_sincos_turns(cases[i].v, &sine, &cosine);
    const float z = cases[i].u, side = sqrt((1.0f - z) * (1.0f + z));
    const Vec3 wi = vec3_make(side * cosine, side * sine, z);
    Bsdf back = bsdf_make(&in, wi, tables);
    float a = 0.0f, b = 0.0f;
    if (lobe == 0u) {
        there.sheen.scale = back.sheen.scale = 1.0f;
        a = sheen_eval(&there.sheen, wo, wi) / wi.z;
        b = sheen_eval(&back.sheen, wi, wo) / wo.z;
    } else if (lobe == 1u && there.coat.weight > 0.0f && back.coat.weight > 0.0f) {
        there.coat.weight = back.coat.weight = 1.0f;
        a = coat_eval(&there.coat, wo, wi, &unused) / back.coat.wo.z;
        b = coat_eval(&back.coat, wi, wo, &unused) / there.coat.wo.z;
    } else if (lobe == 2u) {
        a = base_eval(&there.base, wo, wi, &unused).x / there.base.specular0.x / wi.z;
        b = base_eval(&back.base, wi, wo, &unused).x / back.base.specular0.x / wo.z;
    }
    out[i] = vec2_make(a, b);
}
)";

enum class Lobe : std::uint32_t { sheen, varnish, microfacets };

void expect_reciprocal(Check& check, Lobe lobe, const std::string& what, const std::vector<Case>& materials) {
    std::vector<Case> cases;
    for (Case c : materials)
        for (float mu : {1e-6f, 1e-3f, 0.03f, 0.4f, 1.0f})
            for (float z : {1e-6f, 1e-3f, 0.1f, 0.7f})
                for (float turns : {0.0f, 0.05f, 0.3f, 0.5f, 0.62f})
                    c.mu = mu, c.u = z, c.v = turns, cases.push_back(c);
    const auto both = run_kernel<std::array<float, 2>>(
        check.device, std::string(source) + swapped_source, "swapped",
        Arguments().add(check.device.upload(cases)).add(tables(check)).add(std::uint32_t(lobe)),
        cases.size());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& [there, back] = both[i];
        check.holds(std::isfinite(there) && there >= 0 && std::isfinite(back) && back >= 0, what,
                    " has a value of ", there, " or ", back);
        if (!(there > 1e-6f)) continue;
        check.near(back / there, 1, 1e-3, "f(i, o) over f(o, i) of ", what, ", cosines ", cases[i].mu,
                   " and ", cases[i].u);
        ++compared;
    }
    check.above(double(compared), double(cases.size()) / 4, "pairs compared of ", what);
}

void grazing_sheen(Check& check) {
    std::vector<Case> materials, lobes;
    for (float roughness : {0.0f, 0.07f, 0.1f, 0.2f, 0.4f, 0.7f, 1.0f})
        for (float base : {0.0f, 1.0f}) {
            const Case c{.base = {base, base, base}, .specular = 0, .sheen = 1, .sheen_roughness = roughness};
            materials.push_back(c);
            Case over = c;
            over.specular = 1, over.sheen = 0.5f;
            materials.push_back(over);
            lobes.push_back(c);
        }
    expect_no_gain(check, "sheen", materials, 0.01);
    expect_reciprocal(check, Lobe::sheen, "sheen", lobes);
}

void grazing_varnish(Check& check) {
    std::vector<Case> materials, lobes;
    for (float roughness : {0.0f, 0.03f, 0.2f, 1.0f})
        for (float tilt : {0.0f, 0.3f, -0.3f})
            for (float base : {0.0f, 1.0f}) {
                const Case c{.base = {base, base, base},
                             .specular = 0,
                             .coat = 1,
                             .coat_roughness = roughness,
                             .coat_tilt = tilt};
                materials.push_back(c);
                if (roughness >= 0.2f) lobes.push_back(c);
            }
    expect_no_gain(check, "varnish", materials, 0.01);
    expect_reciprocal(check, Lobe::varnish, "varnish", lobes);
}

void grazing_stretched_metal(Check& check) {
    std::vector<Case> materials, lobes;
    for (float roughness : {0.0f, 0.032f, 0.1f, 0.4f, 1.0f})
        for (float strength : {0.1f, 0.5f, 1.0f})
            for (float azimuth : {0.0f, 0.1f, 0.25f}) {
                const Case c{
                    .metallic = 1, .roughness = roughness, .anisotropy = strength, .azimuth = azimuth};
                materials.push_back(c);
                if (roughness >= 0.1f) lobes.push_back(c);
            }
    expect_no_gain(check, "stretched metal", materials, 0.02);
    expect_reciprocal(check, Lobe::microfacets, "stretched metal", lobes);
}

void grazing_film(Check& check) {
    std::vector<Case> materials;
    for (float thickness : {0.0f, 1e-3f, 300.0f, 1e4f, 1e30f})
        for (float ior : {1.0f, 1.3f, 3.0f, 1e6f})
            for (float roughness : {0.0f, 0.2f, 1.0f})
                for (int base = 0; base < 6; ++base) {
                    Case c{.roughness = roughness, .film = 1, .film_ior = ior, .film_thickness = thickness};
                    c.base[0] = c.base[1] = c.base[2] = base == 0 ? 0.0f : 1.0f;
                    c.metallic = base < 2;            // F0 0 and 1
                    c.ior = base == 3 ? 1.0f : 1.5f;  // as outside
                    c.transmission = base > 3, c.solid = base > 4;
                    materials.push_back(c);
                    if (base < 5) continue;
                    c.inside = 1;
                    materials.push_back(c);
                }
    expect_no_gain(check, "a film", materials, 0.015);
}

const char* const film_source = R"(#include "shading/thin_film.h"
#if TRIAD_HERO
#define FILM_LAST(colour) ((colour).w)
#else
#define FILM_LAST(colour) ((colour).z)
#endif
/* Largest and least of a film's channels; rows: index, thickness, F0, cosine. */
__kernel void film(__global Vec2* out, __global const Vec4* rows, __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    FilmInput film;
    film.ior = rows[i].x, film.thickness = rows[i].y;
#if TRIAD_HERO
    film.wavelengths = vec4_make(380.0f, 480.0f, 600.0f, 780.0f);
#else
    film.responses = tables + ALBEDO_FLOATS;
#endif
    const Colour r = film_reflectance(&film, colour_splat(rows[i].z), rows[i].w);
    out[i] = vec2_make(math_min(math_min(r.x, r.y), math_min(r.z, FILM_LAST(r))) +
                       0.0f * (r.x + r.y + r.z + FILM_LAST(r)),
                       math_max(math_max(r.x, r.y), math_max(r.z, FILM_LAST(r))));
}
)";

/// With colours and with wavelengths; and a film between two of air reflects nothing, the thinner the less.
void film_at_its_ends(Check& check) {
    std::vector<std::array<float, 4>> rows;
    for (float ior : {1.0f, 1.0001f, 1.3f, 10.0f, 1e6f})
        for (float thickness : {0.0f, 1e-30f, 1e-3f, 300.0f, 1e4f, 1e8f, 1e30f})
            for (float f0 : {0.0f, 0.04f, 0.5f, 1.0f})
                for (float mu : grazing_cosines) rows.push_back({ior, thickness, f0, mu});
    for (const char* hero : {"0", "1"}) {
        const auto out = run_kernel<std::array<float, 2>>(
            check.device, film_source, "film", Arguments().add(check.device.upload(rows)).add(tables(check)),
            rows.size(), 1, {{"TRIAD_HERO", hero}});
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto& [ior, thickness, f0, mu] = rows[i];
            const auto& [least, most] = out[i];
            check.holds(least >= 0 && most <= 1, "a film of index ", ior, ", ", thickness, " nm, on ", f0,
                        " at mu ", mu, " reflects ", least, " to ", most);
            if (ior == 1 && f0 == 0)
                check.at_most(most, 1e-6, "reflectance of air on air, ", thickness, " nm at mu ", mu);
            if (f0 == 1 && ior <= 1.3f && mu >= 0.1f)
                check.near(least, 1, 3e-3, "reflectance of a film of ", thickness, " nm on a mirror at mu ",
                           mu);
        }
    }
}

/// What is left where a factor is almost 0 is almost the material without it.
void factors_fade_to_none(Check& check) {
    struct Row {
        const char* what;
        Case c;
    };
    const float little = 1e-6f;
    for (const Row& row : {Row{"varnish", {.coat = little, .coat_roughness = 0.5f}},
                           Row{"sheen", {.sheen = little, .sheen_roughness = 0.3f}},
                           Row{"anisotropy", {.anisotropy = std::sqrt(little), .azimuth = 0.1f}},
                           Row{"film", {.film = little}}, Row{"diffuse transmission", {.through = little}}}) {
        std::vector<Case> with, without;
        for (Case plain : many_cases(check)) {
            plain.azimuth = row.c.azimuth;
            Case c = row.c;
            std::copy_n(plain.base, 3, c.base);
            c.metallic = plain.metallic, c.roughness = plain.roughness, c.mu = plain.mu;
            c.u_through = plain.u_through, c.u = plain.u, c.v = plain.v;
            with.push_back(c), without.push_back(plain);
        }
        const auto a = once(check, with), b = once(check, without);
        for (std::size_t i = 0; i < with.size(); ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                const double expected = b[3 * i + 2][k];
                check.near(a[3 * i + 2][k] / (0.01 + expected), expected / (0.01 + expected), 1e-3,
                           k < 3 ? "value with almost no " : "pdf with almost no ", row.what, ", roughness ",
                           with[i].roughness, ", mu ", with[i].mu);
            }
    }
}

}  // namespace

void add_bsdf_grazing(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C8g", "grazing sheen", standard, grazing_sheen},
                     {"C8c", "grazing varnish", standard, grazing_varnish},
                     {"C8d", "grazing stretched metal", standard, grazing_stretched_metal},
                     {"C8e", "grazing thin films", standard, grazing_film},
                     {"C8f", "thin films at the ends of their parameters", standard, film_at_its_ends},
                     {"B10", "extensions fade to none", standard, factors_fade_to_none},
                 });
}

}  // namespace triad
