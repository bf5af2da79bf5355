// The glTF material gives back all light and no more.
#include <cmath>
#include <random>

#include "check/bsdf_case.h"
#include "check/cases.h"

namespace triad {
namespace {

using namespace bsdf_case;

const std::vector<float> roughnesses = {0.001f, 0.02f, 0.04f, 0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.75f, 0.9f, 1};
const std::vector<float> cosines = {0.02f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1};

/// Furnace of a white material over roughness x mu: the energy may be off by `worst` anywhere and by `mean`
/// in the cosine-weighted mean over all directions of each roughness.
void expect_furnace(Check& check, Case c, double worst, double mean, std::uint32_t samples = 1 << 13) {
    if (check.level == CheckLevel::tiny) samples = 64, worst = mean = 0.25;
    std::vector<Case> cases;
    for (float roughness : roughnesses)
        for (float mu : cosines) c.roughness = roughness, c.mu = mu, cases.push_back(c);
    const auto results = furnace(check, cases, samples);
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        expect_sound(check, results[i], cases[i]);
        check.near(results[i].r, 1, worst, "energy at roughness ", cases[i].roughness, ", mu ", cases[i].mu);
        sum += (results[i].r - 1) * cases[i].mu, weight += cases[i].mu;
        if (cases[i].mu < 1) continue;
        check.at_most(std::abs(sum / weight), mean, "mean energy of roughness ", cases[i].roughness);
        sum = weight = 0;
    }
}

void furnace_white_metal(Check& check) { expect_furnace(check, {.metallic = 1}, 0.003, 0.0015); }
void furnace_white_coated_diffuse(Check& check) {
    for (float ior : {0.0f, 1.0f, 1.5f, 2.5f}) expect_furnace(check, {.ior = ior}, 0.006, 0.0015);
}
void furnace_half_metal_half_transmission(Check& check) {
    expect_furnace(check, {.metallic = 0.5f, .specular = 0.6f, .transmission = 0.5f}, 0.006, 0.0015, 1 << 15);
}
void furnace_thin_wall(Check& check) {
    for (float ior : {1.0f, 1.5f, 2.5f})
        expect_furnace(check, {.ior = ior, .transmission = 1}, 0.006, 0.0015);
}
void furnace_solid_body(Check& check) {
    for (float ior : {1.0f, 1.009f, 1.1f, 1.33f, 1.5f, 1.8f, 2.417f, 3.5f})
        for (float inside : {0.0f, 1.0f})
            expect_furnace(check, {.ior = ior, .transmission = 1, .solid = 1, .inside = inside}, 0.01, 0.003);
}
void furnace_solid_body_of_nearly_the_same_index(Check& check) {
    // an index just above the smooth ones is the worst of the tables
    for (float inside : {0.0f, 1.0f})
        expect_furnace(check, {.ior = 1.011f, .transmission = 1, .solid = 1, .inside = inside}, 0.01, 0.003);
}
void furnace_solid_body_with_another_reflectance(Check& check) {
    for (float inside : {0.0f, 1.0f})
        expect_furnace(check, {.specular = 0, .transmission = 1, .solid = 1, .inside = inside}, 0.01, 0.003);
}

/// A white material of two parameters in [0, 1], and what it may give back at least, and at most, in its
/// brightest channel, seen at any angle.
struct WhiteLobe {
    const char* name;
    double least, most;
    Case (*at)(float x, float y);
};
Case body(float ior, float inside) { return {.ior = ior, .transmission = 1, .solid = 1, .inside = inside}; }
Case filmed(Case c, float ior, float y) {
    c.film = 1, c.film_ior = ior, c.film_thickness = 1000 * y;
    return c;
}
/// A third number out of one of two.
float another(float x) { return 64 * x - std::floor(64 * x); }
const WhiteLobe white_lobes[] = {
    {"metal", 0.998, 1.001, [](float, float) { return Case{.metallic = 1}; }},
    {"dielectric on Lambert", 0.997, 1.0015, [](float x, float) { return Case{.ior = 1 + 2 * x}; }},
    {"thin wall", 0.998, 1.001, [](float x, float) { return Case{.ior = 1 + 2 * x, .transmission = 1}; }},
    {"body from outside", 0.996, 1.0015, [](float x, float) { return body(1.1f + 2 * x, 0); }},
    {"body from inside", 0.992, 1.0025, [](float x, float) { return body(1.1f + 2 * x, 1); }},
    {"body of nearly the same index from outside", 0.993, 1.0015,
     [](float x, float) { return body(1.0101f + 0.1f * x * x, 0); }},
    {"body of nearly the same index from inside", 0.99, 1.003,
     [](float x, float) { return body(1.0101f + 0.1f * x * x, 1); }},
    {"body without specular", 0.99, 1.002,
     [](float x, float y) {
         Case c = body(1.0101f + 2 * x * x, float(y < 0.5f));
         c.specular = 0;
         return c;
     }},
    {"stretched metal", 0.993, 1.0025,
     [](float x, float y) { return Case{.metallic = 1, .anisotropy = x, .azimuth = 0.25f * y}; }},
    {"sheen on Lambert", 0.993, 1.0015,
     [](float x, float) { return Case{.specular = 0, .sheen = 1, .sheen_roughness = x}; }},
    {"varnish on Lambert", 0.995, 1.0015,
     [](float x, float) { return Case{.specular = 0, .coat = 1, .coat_roughness = x * x * x}; }},
    {"varnish on metal", 0.997, 1.0015,
     [](float x, float) { return Case{.metallic = 1, .coat = 1, .coat_roughness = x}; }},
    {"varnish on sheen on metal", 0.99, 1.0025,
     [](float x, float y) {
         return Case{.metallic = 1, .coat = 1, .coat_roughness = x, .sheen = 1, .sheen_roughness = y};
     }},
    {"film on a dielectric on Lambert", 0.993, 1.0015,
     [](float x, float y) { return filmed({}, 1.1f + 2 * x, y); }},
    {"film on metal", 0.9975, 1.001,
     [](float x, float y) { return filmed({.metallic = 1}, 1.1f + 2 * x, y); }},
    {"film on a body from outside", 0.996, 1.0015,
     [](float x, float y) { return filmed(body(1.1f + 2 * another(y), 0), 1.1f + 2 * x, y); }},
    {"film on a body from inside", 0.99, 1.0015,
     [](float x, float y) { return filmed(body(1.5f, 1), 1.1f + 2 * x, y); }},
    {"film of low index on a dielectric on Lambert", 0.993, 1.0015,
     [](float x, float y) { return filmed({}, 1 + 0.1f * x, y); }},
    // Below a film metal has a real index, whose parallel part dips near grazing angles (Brewster).
    {"film of low index on metal", 0.97, 1.001,
     [](float x, float y) { return filmed({.metallic = 1}, 1 + 0.1f * x, y); }},
    {"film of low index on a body", 0.99, 1.0015,
     [](float x, float y) { return filmed(body(1.1f + 2 * another(y), float(y < 0.5f)), 1 + 0.1f * x, y); }},
    {"diffuse transmission", 0.997, 1.0015,
     [](float x, float y) { return Case{.ior = 1 + 2 * x, .through = y}; }},
};

/// At any roughness, half of the angles down to 1e-6. What is a little outside, by noise or by fault, is
/// looked at for longer.
void judge(Check& check, const WhiteLobe& lobe, std::mt19937& generator) {
    const bool tiny = check.level == CheckLevel::tiny;
    const auto excess = [&](const Furnace& f) {
        const double energy = std::max({f.r, f.g, f.b});
        return tiny ? std::max(energy - 1.3, 0.7 - energy)
                    : std::max(energy - lobe.most, lobe.least - energy);
    };
    const auto decide = [&](const Case& c, const Furnace& f) {
        check.at_most(excess(f), 0, lobe.name, " gives ", f.r, " ", f.g, " ", f.b, ", roughness ",
                      c.roughness, ", mu ", c.mu, ", index ", c.ior, ", inside ", c.inside, ", anisotropy ",
                      c.anisotropy, ", azimuth ", c.azimuth, ", sheen roughness ", c.sheen_roughness,
                      ", varnish's ", c.coat_roughness, ", film of index ", c.film_ior, ", ",
                      c.film_thickness, " nm");
    };
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Case> cases;
    for (int i = 0; i < int(check.count(1000, 100)); ++i) {
        const float x = unit(generator), y = unit(generator);
        Case c = lobe.at(x, y);
        c.roughness = i % 2 ? unit(generator) : std::pow(10.0f, -1.5f * unit(generator));
        c.mu = i % 4 < 2 ? unit(generator) : std::pow(10.0f, -6 * unit(generator));
        cases.push_back(c);
    }
    for (int bits : {13, 16, 21}) {
        const bool last = tiny || bits == 21;
        const double within = bits == 16 ? -0.001 : 0;  // what was doubted must be clearly right
        const auto results = furnace(check, cases, tiny ? 64 : 1 << bits);
        std::vector<Case> doubted;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            expect_sound(check, results[i], cases[i]);
            if (!last && excess(results[i]) > within && excess(results[i]) < 0.1)
                doubted.push_back(cases[i]);
            else
                decide(cases[i], results[i]);
        }
        if (doubted.empty()) return;
        cases = doubted;
    }
}

void white_lobes_at_any_angle(Check& check) {
    std::mt19937 generator(19);
    for (const WhiteLobe& lobe : white_lobes) judge(check, lobe, generator);
}

void random_materials_gain_no_energy(Check& check, bool layered) {
    std::mt19937 generator(layered ? 12 : 11);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto number = [&] {
        return std::min(std::max(1.4f * unit(generator) - 0.2f, 0.0f), 1.0f);
    };  // 0 and 1 often
    std::vector<Case> cases;
    const int count = int(check.count(3000, 1000));
    for (int i = 0; i < count; ++i) {
        Case c;
        for (float& x : c.base) x = number();
        for (float& x : c.specular_colour) x = number();
        c.metallic = number(), c.roughness = number(), c.specular = number(), c.transmission = number();
        c.ior = i % 10 ? 1 + 2 * number() : 0;
        c.solid = float(i % 2), c.inside = float(i % 4 == 3);
        c.mu = i % 3 ? number() * 0.999f + 0.001f : std::pow(10.0f, -7 * unit(generator));
        if (layered) {
            c.coat = number(), c.coat_roughness = number(), c.coat_tilt = i % 2 ? 0.5f * number() : 0.0f;
            c.sheen = number(), c.sheen_roughness = number();
            c.anisotropy = number(), c.azimuth = unit(generator);
            c.film = number(), c.film_ior = 1 + 2 * number(), c.film_thickness = 1000 * number();
            // not where a body refracts too: what a sample is scaled by to be energy is that of one lobe
            c.through = c.solid > 0 ? 0 : number();
        }
        cases.push_back(c);
    }
    const std::uint32_t samples = check.level == CheckLevel::tiny ? 64 : 1024;
    const auto results = furnace(check, cases, samples);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Furnace& f = results[i];
        expect_sound(check, f, cases[i]);
        // table error, and the noise of samples of weights of at most `largest`
        check.at_most(std::max({f.r, f.g, f.b}), 1.02 + 0.96 / std::sqrt(samples) * f.largest,
                      "energy of material ", i, ", roughness ", cases[i].roughness, ", mu ", cases[i].mu);
    }
}

void random_materials_never_gain_energy(Check& check) { random_materials_gain_no_energy(check, false); }
void random_layers_never_gain_energy(Check& check) { random_materials_gain_no_energy(check, true); }

}  // namespace

void add_bsdf_energy(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"F1", "furnace of white metal", quick, furnace_white_metal},
            {"F2", "furnace of coated diffuse", quick, furnace_white_coated_diffuse},
            {"F3", "furnace of half metal, half glass", standard, furnace_half_metal_half_transmission},
            {"F4", "furnace of thin walls", standard, furnace_thin_wall},
            {"F5", "furnace of solid bodies", quick, furnace_solid_body},
            {"F6", "furnace of bodies of nearly the same index", standard,
             furnace_solid_body_of_nearly_the_same_index},
            {"F7", "furnace of bodies with another reflectance", standard,
             furnace_solid_body_with_another_reflectance},
            {"F8", "random materials never gain energy", standard, random_materials_never_gain_energy},
            {"F19", "white lobes at any angle", standard, white_lobes_at_any_angle},
            {"F18", "random layers never gain energy", standard, random_layers_never_gain_energy},
        });
}

}  // namespace triad
