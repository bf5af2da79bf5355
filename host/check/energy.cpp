// Energy: furnaces, integrating spheres, slabs.
#include "check/cases.h"
#include "check/picture.h"

namespace triad {
namespace {

using namespace picture_case;

Primitive faceted_sphere(unsigned meridians, bool inward = false) {
    Primitive p = shapes::lat_long_sphere({0, 0, 0}, 1.0f, meridians, meridians / 2);
    p.normals.clear();
    if (inward)
        for (uvec3& t : p.triangles) std::swap(t.y, t.z);
    return p;
}

void furnace_of_every_lobe(Check& check) {
    struct Lobe {
        const char* name;
        Material material;
        double bias;  // error of the directional-albedo tables (docs/shading.md)
    };
    std::vector<Lobe> lobes;
    for (float roughness : {0.0f, 0.05f, 0.2f, 0.5f, 0.8f, 1.0f}) {
        if (check.level <= CheckLevel::quick && roughness != 0.2f) continue;
        Material metal;
        metal.roughness = roughness;
        lobes.push_back({"metal", metal, 0.005});
        Material dielectric;
        dielectric.metallic = 0;
        dielectric.roughness = roughness;
        lobes.push_back({"coated diffuse", dielectric, 0.005});
        Material thin = glass(1.5f, roughness);
        thin.thickness = 0;
        lobes.push_back({"thin wall", thin, 0.005});
        lobes.push_back({"solid 1.5", glass(1.5f, roughness), 0.01});
        lobes.push_back({"solid 1.05", glass(1.05f, roughness), 0.01});
        lobes.push_back({"solid 2.4", glass(2.4f, roughness), 0.01});
    }
    for (const Lobe& lobe : lobes) {
        Builder b;
        b.add(faceted_sphere(32), lobe.material).sky(1.0f);
        expect_closed_form(
            check, std::string(lobe.name) + ", roughness " + std::to_string(lobe.material.roughness),
            measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, 0, -1}, 0.9, 3), .spp = 128}), 1.0,
            lobe.bias);
    }
}

void furnace_of_mixed_materials(Check& check) {
    for (float metallic : {0.0f, 0.3f, 1.0f})
        for (float transmission : {0.0f, 0.5f, 1.0f}) {
            Material m = glass(1.5f, 0.4f);
            m.metallic = metallic;
            m.transmission = transmission;
            Builder b;
            b.add(faceted_sphere(32), m).sky(1.0f);
            const Measured r =
                measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, 0, -1}, 0.9, 3), .spp = 128});
            expect_closed_form(check,
                               "white mix " + std::to_string(metallic) + " " + std::to_string(transmission),
                               r, 1.0, 0.01);
        }
}

void no_heavy_tail(Check& check) {
    // From inside, most normals reflect totally and many into the surface: if samples that end there are made
    // up for by heavy others, their product over the bounces has no finite variance (standard errors of .022
    // and .011).
    for (float roughness : {0.7f, 1.0f}) {
        Builder b;
        b.add(faceted_sphere(32), glass(2.4f, roughness)).sky(1.0f);
        const Measured m = measure(
            check, b.scene, {.view = orthographic({0, 0, 0}, {0, 0, -1}, 0.9, 3), .spp = 256, .seeds = 12});
        const double noise = std::sqrt(256.0 / double(check.count(256, 4)));
        check.below(m.standard_error, 0.004 * noise, "standard error at roughness ", roughness);
        check.near(m.mean, 1.0, 0.02 * noise, "energy at roughness ", roughness);
    }
}

/// D3: L = 1 / (1 - rho). The camera is inside; every point of the wall emits 1.
void expect_series(Check& check, double rho) {
    Material wall = lambert(static_cast<float>(rho));
    wall.emission = vec3(1.0f);
    Builder b;
    b.add(faceted_sphere(48, true), wall);
    const View inside = look_at({0, 0, 0.3}, {0, 0, -1}, 1.0, 1.0);
    expect_closed_form(check, "rho " + std::to_string(rho),
                       measure(check, b.scene, {.view = inside, .spp = rho > 0.95 ? 32u : 128u}),
                       1.0 / (1.0 - rho), 1e-5);
}

void integrating_sphere(Check& check) {
    for (double rho : {0.5, 0.8}) expect_series(check, rho);
    if (check.level > CheckLevel::quick) expect_series(check, 0.99);
}
void roulette_keeps_the_mean(Check& check) { expect_series(check, 0.9); }

void depth_limit(Check& check) {
    // k edges after the camera's: 1 + rho + ... + rho^(max_depth - 1).
    Material wall = lambert(0.9f);
    wall.emission = vec3(1.0f);
    Builder b;
    b.add(faceted_sphere(48, true), wall);
    const Plan plan{.view = look_at({0, 0, 0.3}, {0, 0, -1}, 1.0, 1.0), .spp = 256, .max_depth = 5};
    expect_closed_form(check, "five edges", measure(check, b.scene, plan), (1 - std::pow(0.9, 5)) / (1 - 0.9),
                       1e-5);
}

void point_light_in_a_sphere(Check& check) {
    // D3: flux 1 at the centre of a sphere of radius 1: L = rho E / (pi (1 - rho)), E = 1 / 4 pi; .101321 for
    // rho .8.
    Builder b;
    b.add(faceted_sphere(256, true), lambert(0.8f));
    b.scene.lights.push_back(
        {.type = PunctualLight::Type::point, .colour = vec3(static_cast<float>(0.25 / pi))});
    expect_closed_form(
        check, "L", measure(check, b.scene, {.view = look_at({0, 0, 0.3}, {0, 0, -1}, 1.0, 1.0), .spp = 512}),
        0.101321, 5e-4);
}

/// A slab of glass between the camera and a large emitter of radiance 1; everything else is black.
Measured slab(Check& check, const Material& material, double thickness, double degrees) {
    Builder b;
    const float h = 200.0f, t = static_cast<float>(thickness);
    b.add(shapes::box({-h, -t, -h}, {h, 0, h}), material);
    b.add(shapes::quad({-1000, -2.0f - t, 1000}, {2000, 0, 0}, {0, 0, -2000}), emitter(1.0f));
    const double a = degrees * pi / 180;
    return measure(
        check, b.scene,
        {.view = orthographic({0, 0, 0}, {std::sin(a), -std::cos(a), 0}, 0.1, 5), .spp = 1024, .seeds = 8});
}

void slab_at_normal_incidence(Check& check) {
    // D4: T = 2 n / (n^2 + 1), all internal reflections summed.
    expect_closed_form(check, "1.5", slab(check, glass(1.5f), 1, 0), 0.923076923, 2e-5);
    expect_closed_form(check, "SF10", slab(check, glass(1.72825f), 1, 0), 0.866975602, 2e-5);
    expect_closed_form(check, "diamond", slab(check, glass(2.417f), 1, 0), 0.706530024, 2e-5);
}

void slab_at_30_degrees(Check& check) {
    // Unpolarised: the mean reflectance is taken per interface (docs/shading.md has the gap to polarised
    // light).
    expect_closed_form(check, "30", slab(check, glass(1.5f), 1, 30), 0.920265533, 5e-5);
}
void slab_at_60_and_80_degrees(Check& check) {
    expect_closed_form(check, "60", slab(check, glass(1.5f), 1, 60), 0.836232463, 5e-5);
    expect_closed_form(check, "80", slab(check, glass(1.5f), 1, 80), 0.441229173, 2e-4);
}

void absorbing_slab(Check& check) {
    // D5: sigma .5, one unit thick: T = .559307869 at 0, .450738834 at 60 degrees; sigma 5: .006209692.
    auto absorbing = [](double sigma) {
        Material m = glass(1.5f);
        m.attenuation_distance = 1.0f;
        m.attenuation_colour = vec3(static_cast<float>(std::exp(-sigma)));
        return m;
    };
    expect_closed_form(check, "sigma .5", slab(check, absorbing(0.5), 1, 0), 0.559307869, 2e-5);
    expect_closed_form(check, "sigma .5 at 60", slab(check, absorbing(0.5), 1, 60), 0.450738834, 1e-4);
    expect_closed_form(check, "sigma 5", slab(check, absorbing(5), 1, 0), 0.006209692, 1e-4);
}

void thin_wall(Check& check) {
    Material thin = glass(1.5f);
    thin.thickness = 0;
    Builder b;
    b.add(shapes::quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}), thin);
    b.add(shapes::quad({-100, -2, 100}, {200, 0, 0}, {0, 0, -200}), emitter(1.0f));
    expect_closed_form(
        check, "T",
        measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.1, 5), .spp = 1024}),
        0.923076923, 2e-5);
}

}  // namespace

void add_energy(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"F9", "furnace of every lobe in whole pictures", quick, furnace_of_every_lobe},
            {"F10", "furnace of mixed materials in whole pictures", standard, furnace_of_mixed_materials},
            {"F11", "rough body of high index has no heavy tail", full, no_heavy_tail},
            {"C20", "roulette keeps the mean, albedo .9", quick, roulette_keeps_the_mean},
            {"D3", "integrating sphere", quick, integrating_sphere},
            {"D3b", "depth limit cuts the series", standard, depth_limit},
            {"D3c", "point light in a sphere", standard, point_light_in_a_sphere},
            {"D4", "slab 30 degrees", quick, slab_at_30_degrees},
            {"D4b", "slab normal incidence", standard, slab_at_normal_incidence},
            {"D4c", "slab 60 and 80 degrees", standard, slab_at_60_and_80_degrees},
            {"D4d", "thin wall as a slab", standard, thin_wall},
            {"D5", "absorbing slab", quick, absorbing_slab},
        });
}

}  // namespace triad
