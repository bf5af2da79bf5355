// The glTF material: sampling against pdf, closed forms, reciprocity, hostile input.
#include <cstring>
#include <set>

#include "check/bsdf_case.h"
#include "check/cases.h"

namespace triad {
namespace {

using namespace bsdf_case;

constexpr Case sampled_materials[] = {
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
    {.base = {0, 0, 0}, .specular = 0, .coat = 1, .coat_roughness = 0.8f, .coat_tilt = 0.3f},
    {.base = {0, 0, 0}, .specular = 0, .sheen = 1, .sheen_roughness = 0.4f},
    {.metallic = 1, .roughness = 0.5f, .anisotropy = 0.8f, .azimuth = 0.1f},
    {.metallic = 1, .roughness = 0.5f, .film = 1},
    {.roughness = 0.5f, .through = 0.6f},
    {.base = {0.5f, 0.5f, 0.5f},
     .roughness = 0.6f,
     .transmission = 0.5f,
     .solid = 1,
     .inside = 1,
     .coat = 0.5f,
     .coat_roughness = 0.5f,
     .sheen = 0.5f,
     .anisotropy = 0.6f,
     .azimuth = 0.1f,
     .film = 0.7f,
     .through = 0.4f},
    {.roughness = 0.6f, .coat = 0.8f, .coat_roughness = 0.5f, .coat_tilt = 0.3f},
    {.roughness = 0.75f,
     .ior = 1.4f,
     .transmission = 1,
     .solid = 1,
     .inside = 1,
     .anisotropy = 1,
     .azimuth = 0.1f},
    {.specular = 0, .sheen = 1, .sheen_roughness = 0.4f},
};

/// Samples over 32 x 32 cells of equal solid angle, and the pdf integrated by 64 x 32 points per cell; a
/// quarter of these where a sixteenth of the samples tells less.
void one_follows_the_pdf(Check& check, const Case& c, std::size_t m) {
    const std::size_t count = check.count(1 << 18), parts = check.level <= CheckLevel::quick ? 16 : 32;
    const auto rows = std::size_t(grid_edge(count, 32)), columns = rows;
    const Buffer buffer = check.device.upload(std::vector<Case>{c});
    const Arguments arguments = Arguments().add(buffer).add(tables(check));
    const auto samples = run_kernel<Four>(check.device, source, "draw", arguments, count);
    const auto integrals = run_kernel<float>(
        check.device, source, "integrate",
        Arguments(arguments).add(std::uint32_t(rows)).add(std::uint32_t(columns)).add(std::uint32_t(parts)),
        rows * columns * parts);
    std::vector<double> integral(rows * columns);
    for (std::size_t i = 0; i < integrals.size(); ++i) integral[i / parts] += integrals[i];
    std::vector<double> counts(rows * columns), expected;
    double total = 0, inverse = 0;
    for (double p : integral) expected.push_back(p * double(count)), total += p;
    for (const Four& s : samples) {
        if (s[3] <= 0) continue;
        const double turn = std::atan2(s[1], s[0]) / (2 * pi);
        const auto row = std::min(rows - 1, std::size_t((s[2] + 1) / 2 * rows));
        const auto column = std::min(columns - 1, std::size_t((turn < 0 ? turn + 1 : turn) * columns));
        ++counts[row * columns + column];
        inverse += 1 / double(count);
    }
    check.below(chi_square_z(counts, expected), chi_square_limit, "chi-square of material ", m, ", mu ",
                c.mu);
    // the pdf integrates to 1 less the share of samples that end in the surface
    check.also_at_most(std::abs(total - inverse), 5 * std::sqrt(0.25 / double(count)),
                       "integral of the pdf of material ", m, ", mu ", c.mu);
}

void samples_follow_the_pdf(Check& check) {
    const bool few = check.level <= CheckLevel::quick;
    // a varnish and a sheen alone, the cap of a stretched body
    const std::set<std::size_t> always = {12, 13, 19};
    for (std::size_t m = 0; m < std::size(sampled_materials); ++m) {
        if (few && m % 3 != 2 && !always.contains(m)) continue;
        for (const float mu : few ? std::vector{0.6f} : std::vector{1.0f, 0.6f, 0.15f}) {
            Case c = sampled_materials[m];
            c.mu = mu;
            one_follows_the_pdf(check, c, m);
        }
    }
}

void lambert_to_the_bit(Check& check) {
    std::vector<Case> cases;
    const int count = int(check.count(4096, 512));
    for (int i = 0; i < count; ++i)
        cases.push_back({.base = {0.8f, 0.25f, float(i) / float(count)},
                         .roughness = (i % 7) / 6.0f,
                         .specular = 0,
                         .mu = 0.01f + (i % 90) * 0.011f,
                         .u_through = (i % 64) / 64.0f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 59.0f});
    const auto general = once(check, cases), lambert = once(check, cases, {{"TRIAD_SPECULAR", "0"}});
    check.equal(std::memcmp(general.data(), lambert.data(), general.size() * sizeof(Four)), 0,
                "the specialised program");
    for (std::size_t i = 0; i < cases.size(); ++i) {
        check.equal(general[3 * i + 1][0], cases[i].base[0], "weight of a Lambert sample");
        check.near(general[3 * i][3], general[3 * i][2] / pi, 1e-7, "pdf of a Lambert sample");
    }
}

void same_bits_without_transmission(Check& check) {
    const std::vector<Case> cases = many_cases(check);
    const auto general = once(check, cases), opaque = once(check, cases, {{"TRIAD_TRANSMISSION", "0"}});
    check.equal(std::memcmp(general.data(), opaque.data(), general.size() * sizeof(Four)), 0,
                "the specialised program");
}

double interface_reflectance(double degrees, double n) {
    const double c = std::cos(degrees * pi / 180), t = std::sqrt(1 - (1 - c * c) / (n * n));
    const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (s * s + p * p) / 2;
}

void thin_wall_is_a_slab(Check& check) {
    // D4: both faces and all reflections between them, unpolarised per interface
    struct Row {
        float ior;
        double degrees, transmitted;
    };
    const double slack = check.level == CheckLevel::tiny ? 0.02 : 2e-3;
    for (const Row& row : {Row{1.5f, 0, .923076923}, Row{1.72825f, 0, .866975602}, Row{2.417f, 0, .706530024},
                           Row{1.5f, 30, .920265533}, Row{1.5f, 60, .836232463}, Row{1.5f, 80, .441229173}}) {
        const auto f = furnace(check,
                               {{.roughness = 0,
                                 .ior = row.ior,
                                 .transmission = 1,
                                 .mu = float(std::cos(row.degrees * pi / 180))}},
                               check.level == CheckLevel::tiny ? 512 : 4096)[0];
        check.near(f.transmitted, row.transmitted, slack * row.transmitted, "index ", row.ior, " at ",
                   row.degrees, " degrees");
        check.near(f.r, 1, 1e-5, "energy of a slab");
        const auto w = once(check, {{.base = {0.5f, 0.5f, 0.5f},
                                     .roughness = 0,
                                     .ior = row.ior,
                                     .transmission = 1,
                                     .mu = 0.6f,
                                     .u_through = 0.9999f}});
        check.equal(w[0][0], -0.8f, "direction through a thin wall");
        check.equal(w[0][2], -0.6f, "direction through a thin wall");
    }
}

void smooth_body_refracts(Check& check) {
    for (double degrees : {0.0, 20.0, 45.0, 70.0, 89.0}) {
        const Case c{.roughness = 0,
                     .ior = 1.5f,
                     .transmission = 1,
                     .solid = 1,
                     .mu = float(std::cos(degrees * pi / 180)),
                     .u_through = 0.99999f};
        const auto out = once(check, {c});
        const double sine = std::sin(degrees * pi / 180) / 1.5, r = interface_reflectance(degrees, 1.5);
        check.near(out[0][0], -sine, 1e-6, "sine of refraction at ", degrees);
        check.near(out[0][2], -std::sqrt(1 - sine * sine), 1e-6, "cosine of refraction at ", degrees);
        check.near(out[1][0] * 2.25f, 1, 1e-5, "(1 - F) / n^2 over its probability 1 - F");
        check.equal(int(out[1][3]), 4 | 8, "event");
        const auto f = furnace(check, {c}, check.level == CheckLevel::tiny ? 512 : 1 << 14)[0];
        check.near(f.transmitted, 1 - r, check.level == CheckLevel::tiny ? 0.02 : 1e-3, "transmission at ",
                   degrees);
    }
    // beyond the critical angle from inside everything reflects; an index of 1 is no interface
    const auto total =
        furnace(check, {{.roughness = 0, .transmission = 1, .solid = 1, .inside = 1, .mu = 0.7f}}, 256)[0];
    check.equal(total.transmitted, 0, "light beyond the critical angle");
    check.near(total.r, 1, 1e-6, "total reflection");
    const auto same = once(
        check, {{.roughness = 0.7f, .ior = 1, .transmission = 1, .solid = 1, .mu = 0.6f, .u_through = 0.3f}});
    check.equal((Four{same[0][0], same[0][1], same[0][2], same[1][0]}), (Four{-0.8f, 0, -0.6f, 1}),
                "passing an index of 1");
}

void rough_refraction_is_reciprocal(Check& check) {
    std::vector<Case> cases;
    const int count = int(check.count(4096, 512));
    for (int i = 0; i < count; ++i)
        cases.push_back({.roughness = 0.3f + (i % 8) * 0.1f,
                         .ior = i % 2 ? 1.5f : 2.2f,
                         .transmission = 1,
                         .solid = 1,
                         .mu = 0.1f + (i % 50) * 0.018f,
                         .u = (i % 61) / 61.0f,
                         .v = (i % 59) / 60.0f});
    const auto both = run_kernel<std::array<float, 2>>(
        check.device, source, "reverse", Arguments().add(check.device.upload(cases)).add(tables(check)),
        cases.size());
    int compared = 0;
    for (const auto& [there, here] : both)
        if (there > 1e-4f) {
            check.near(there / here, 1, 2e-4, "n^2 f(o, i) over f(i, o)");
            ++compared;
        }
    check.above(compared, cases.size() / 2, "pairs compared");
}

void hostile_input(Check& check) {
    std::vector<Case> cases;
    const float end = 1 - 0x1p-24f;
    const int step = check.level == CheckLevel::tiny ? 43 : 1;
    for (float mu : {1e-30f, 1e-12f, 1e-6f, 1e-3f, 0.5f, 1.0f})
        for (float roughness : {0.0f, 0.0316f, 0.032f, 0.2f, 1.0f})
            for (int k = 0; k < 216; k += step) {
                Case c{.metallic = (k % 3) / 2.0f, .roughness = roughness, .mu = mu};
                c.transmission = (k / 3 % 3) / 2.0f, c.solid = float(k / 9 % 2), c.inside = float(k / 18 % 2);
                c.ior = std::array{0.0f, 1.0f, 1.5f}[k / 36 % 3],
                c.base[0] = c.base[1] = c.base[2] = float(k / 108);
                for (const float u : {0.0f, 0.5f, end})
                    for (int ends = 0; ends < 4; ++ends) {
                        c.u = u, c.u_through = ends & 1 ? end : 0, c.v = ends & 2 ? end : 0;
                        cases.push_back(c);
                    }
            }
    for (const Four& row : once(check, cases))
        for (float x : row) check.holds(std::isfinite(x), "not finite");
}

}  // namespace

void add_bsdf(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C8", "grazing and hostile input of the material", quick, hostile_input},
                     {"C11c", "chi-square of the material", quick, samples_follow_the_pdf},
                     {"B2", "Snell and Fresnel at a smooth body", quick, smooth_body_refracts},
                     {"B3", "thin wall as its slab", standard, thin_wall_is_a_slab},
                     {"B4", "rough refraction is reciprocal", quick, rough_refraction_is_reciprocal},
                     {"B5", "Lambert to the bit without specular", standard, lambert_to_the_bit},
                     {"B6", "same bits without transmission", standard, same_bits_without_transmission},
                 });
}

}  // namespace triad
