// What extensions lay over the material's core, or change of it: furnaces, and the film against Airy's sum.
#include <complex>

#include "check/bsdf_case.h"
#include "check/cases.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

using namespace bsdf_case;

/// All light comes back, in every channel, to `slack` of each direction and to `mean` of their
/// cosine-weighted mean.
void expect_white(Check& check, const std::string& what, Case c, double slack, double mean,
                  std::initializer_list<float> azimuths = {0.0f}) {
    const bool tiny = check.level == CheckLevel::tiny;
    if (tiny) slack = mean = 0.3;
    std::vector<Case> cases;
    for (float azimuth : azimuths)
        for (float mu : {0.03f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f})
            c.azimuth = azimuth, c.mu = mu, cases.push_back(c);
    const auto results = furnace(check, cases, tiny ? 64 : 1 << 14);
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Furnace& f = results[i];
        expect_sound(check, f, cases[i]);
        for (float energy : {f.r, f.g, f.b})
            check.near(energy, 1, slack, "energy of ", what, " at mu ", cases[i].mu, ", azimuth ",
                       cases[i].azimuth);
        sum += (f.g - 1) * cases[i].mu, weight += cases[i].mu;
    }
    check.at_most(std::abs(sum / weight), mean, "mean energy of ", what);
}

void furnace_of_varnish(Check& check) {
    for (float roughness : {0.0f, 0.3f, 0.8f}) {
        expect_white(check, "varnish on Lambert", {.specular = 0, .coat = 1, .coat_roughness = roughness},
                     0.01, 0.003);
        expect_white(check, "varnish on metal",
                     {.metallic = 1, .roughness = 0.5f, .coat = 0.7f, .coat_roughness = roughness}, 0.01,
                     0.003);
    }
}

void furnace_of_sheen(Check& check) {
    for (float roughness : {0.1f, 0.3f, 0.6f, 1.0f})
        expect_white(check, "sheen on Lambert", {.specular = 0, .sheen = 1, .sheen_roughness = roughness},
                     0.01, 0.003);
}

void furnace_of_stretched_metal(Check& check) {
    for (float roughness : {0.05f, 0.2f, 0.5f, 0.8f})
        for (float strength : {0.3f, 0.7f, 1.0f})
            expect_white(check, "stretched metal",
                         {.metallic = 1, .roughness = roughness, .anisotropy = strength}, 0.0085, 0.0025,
                         {0.0f, 0.06f, 0.125f, 0.2f, 0.25f});
}

void furnace_of_diffuse_transmission(Check& check) {
    for (float through : {0.3f, 1.0f})
        expect_white(check, "a leaf", {.roughness = 0.5f, .through = through}, 0.006, 0.002);
}

void furnace_of_a_stack(Check& check) {
    expect_white(check, "varnish on sheen on rough metal",
                 {.metallic = 1,
                  .roughness = 0.6f,
                  .coat = 1,
                  .coat_roughness = 0.2f,
                  .sheen = 1,
                  .sheen_roughness = 0.4f},
                 0.01, 0.004);
    expect_white(check, "varnish on sheen on glass",
                 {.roughness = 0.4f,
                  .transmission = 1,
                  .coat = 1,
                  .coat_roughness = 0.2f,
                  .sheen = 1,
                  .sheen_roughness = 0.4f},
                 0.01, 0.004);
}

/// The base of a film lets through by what the film's brightest channel leaves: that one is white, the others
/// lose. A body below a film lets through what the film does not reflect: all are white.
void film_never_gains_energy(Check& check) {
    const bool tiny = check.level == CheckLevel::tiny;
    std::vector<Case> cases;
    for (float roughness : {0.0f, 0.2f, 0.5f, 1.0f})
        for (float metallic : {0.0f, 1.0f})
            for (float thickness : {150.0f, 400.0f, 900.0f})
                for (float mu : {0.05f, 0.2f, 0.5f, 1.0f})
                    cases.push_back({.metallic = metallic,
                                     .roughness = roughness,
                                     .mu = mu,
                                     .film = 1,
                                     .film_thickness = thickness});
    for (float roughness : {0.2f, 0.5f, 1.0f})
        for (float inside : {0.0f, 1.0f})
            for (float mu : {0.05f, 0.2f, 0.5f, 1.0f})
                cases.push_back({.roughness = roughness,
                                 .transmission = 1,
                                 .solid = 1,
                                 .inside = inside,
                                 .mu = mu,
                                 .film = 1});
    const auto results = furnace(check, cases, tiny ? 64 : 1 << 13);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Furnace& f = results[i];
        expect_sound(check, f, cases[i]);
        const double most = std::max({f.r, f.g, f.b});
        check.at_most(most, tiny ? 1.3 : 1.01, "energy of a film of ", cases[i].film_thickness, " nm at mu ",
                      cases[i].mu, ", roughness ", cases[i].roughness);
        if (cases[i].metallic == 0)
            check.above(most, tiny ? 0.7 : 0.985, "energy of a film of ", cases[i].film_thickness,
                        " nm at mu ", cases[i].mu, ", roughness ", cases[i].roughness);
    }
}

/// Reflectance of air, film and base for one wavelength: Airy's sum of amplitudes, unpolarised.
double airy(double mu, double film, double base, double thickness, double wavelength) {
    const double c2 = std::sqrt(1 - (1 - mu * mu) / (film * film)),
                 c3 = std::sqrt(1 - (1 - mu * mu) / (base * base));
    const std::complex<double> turn = std::polar(1.0, 4 * pi * film * thickness * c2 / wavelength);
    double sum = 0;
    for (const auto& [r12, r23] :
         {std::pair{(mu - film * c2) / (mu + film * c2), (film * c2 - base * c3) / (film * c2 + base * c3)},
          std::pair{(film * mu - c2) / (film * mu + c2), (base * c2 - film * c3) / (base * c2 + film * c3)}})
        sum += std::norm((r12 + r23 * turn) / (1.0 + r12 * r23 * turn));
    return 0.5 * sum;
}

void film_is_airys_sum(Check& check) {
    std::vector<Case> cases;
    for (float f0 : {0.04f, 0.17f, 0.5f, 0.9f})
        for (float ior : {1.2f, 1.33f, 1.8f})
            for (float thickness : {1e-3f, 100.0f, 250.0f, 400.0f, 800.0f})  // 0: no film
                for (float mu : {1.0f, 0.7f, 0.3f, 0.1f})
                    cases.push_back({.base = {f0, f0, f0},
                                     .metallic = 1,
                                     .roughness = 0,
                                     .mu = mu,
                                     .film = 1,
                                     .film_ior = ior,
                                     .film_thickness = thickness});
    const auto out = once(check, cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Case& c = cases[i];
        const double root = std::sqrt(double(c.base[0])), base = (1 + root) / (1 - root);
        dvec3 sum(0.0), whole(0.0);
        for (int row = 0; row + 1 < spectral_rows; ++row)
            for (int part = 0; part < 5; ++part) {
                const double t = (part + 0.5) / 5;
                const dvec3 response = glm::mix(d65_response(row), d65_response(row + 1), t);
                sum += response * airy(c.mu, c.film_ior, base, c.film_thickness,
                                       shortest_wavelength + spectral_step * (row + t));
                whole += response;
            }
        for (int channel = 0; channel < 3; ++channel)
            check.near(out[3 * i + 1][std::size_t(channel)],
                       std::clamp(sum[channel] / whole[channel], 0.0, 1.0), 0.01, "channel ", channel,
                       " of a film of ", c.film_thickness, " nm, index ", c.film_ior, ", on ", c.base[0],
                       " at mu ", c.mu);
    }
}

void no_extension_changes_no_bit(Check& check) {
    std::vector<Case> cases = many_cases(check);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Case& c = cases[i];
        c.transmission = float(i % 5) / 4.0f;
        // what belongs to an extension whose factor is 0 counts for nothing, and a film has a thickness
        c.coat_roughness = float(i % 2), c.coat_tilt = 0.1f * float(i % 7),
        c.sheen_roughness = float(i % 3) / 2;
        c.film = float(i % 2), c.film_ior = 1.0f + float(i % 4), c.film_thickness = i % 2 ? 0.0f : 300.0f;
    }
    const Options none{{"TRIAD_CLEARCOAT", "0"},
                       {"TRIAD_SHEEN", "0"},
                       {"TRIAD_ANISOTROPY", "0"},
                       {"TRIAD_IRIDESCENCE", "0"},
                       {"TRIAD_DIFFUSE_TRANSMISSION", "0"}};
    check.equal(once(check, cases), once(check, cases, none), "the program without extensions");
}

}  // namespace

void add_bsdf_layers(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"F17", "furnace of varnish", standard, furnace_of_varnish},
            {"F12", "furnace of sheen", standard, furnace_of_sheen},
            {"F13", "furnace of stretched metal", standard, furnace_of_stretched_metal},
            {"F14", "furnace of diffuse transmission", standard, furnace_of_diffuse_transmission},
            {"F15", "furnace of varnish on sheen on metal and glass", standard, furnace_of_a_stack},
            {"F16", "thin films never gain energy", standard, film_never_gains_energy},
            {"B8", "thin films against Airy's sum", standard, film_is_airys_sum},
            {"B9", "the material without extensions, to the bit", standard, no_extension_changes_no_bit},
        });
}

}  // namespace triad
