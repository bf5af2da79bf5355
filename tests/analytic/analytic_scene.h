#pragma once
/// Scenes with a known answer: a few primitives, a camera, and statistics of the picture.
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "../device/device_fixture.h"
#include "render/renderer.h"
#include "scene/shapes.h"

namespace triad::analytic {

/// Lambert with this albedo and nothing else: KHR_materials_specular with factor 0.
inline Material lambert(float albedo) {
    Material m;
    m.base_colour = {albedo, albedo, albedo, 1.0f};
    m.metallic = 0.0f;
    m.roughness = 1.0f;
    m.specular = 0.0f;
    return m;
}

/// A black body that emits `radiance`.
inline Material emitter(float radiance, bool double_sided = false) {
    Material m = lambert(0.0f);
    m.emission = vec3(radiance);
    m.double_sided = double_sided;
    return m;
}

/// White solid glass.
inline Material glass(float ior, float roughness = 0.0f) {
    Material m;
    m.metallic = 0.0f;
    m.roughness = roughness;
    m.ior = ior;
    m.transmission = 1.0f;
    m.thickness = 1.0f;
    return m;
}

struct Builder {
    Scene scene;

    Builder& add(Primitive primitive, const Material& material, const dmat4& to_world = dmat4(1.0)) {
        primitive.material = scene.materials.size();
        scene.materials.push_back(material);
        scene.meshes.push_back({"mesh " + std::to_string(scene.meshes.size()), {std::move(primitive)}});
        scene.instances.push_back({"node", scene.meshes.size() - 1, to_world});
        return *this;
    }
    Builder& sky(float radiance) {
        scene.sky = vec3(radiance);
        return *this;
    }
};

/// Sees [-half, half]^2 around `centre` from `distance` away, orthographically, against `towards` (unit).
inline View orthographic(const dvec3& centre, const dvec3& towards, double half, double distance) {
    View v = look_at(centre - towards * distance, centre, 1.0, 1.0);
    v.orthographic = true;
    v.extent = {half, half};
    return v;
}

/// Mean of one channel over the picture, and the standard error of that mean from independent seeds.
struct Measured {
    double mean = 0, standard_error = 0;
    std::uint64_t not_finite = 0;
};

struct Plan {
    View view;
    unsigned size = 16, spp = 64, seeds = 8, max_depth = 0;
};

inline Measured measure(const Scene& scene, const Plan& plan) {
    double sum = 0, squares = 0;
    Measured out;
    for (unsigned seed = 0; seed < plan.seeds; ++seed) {
        RenderSettings settings;
        settings.width = settings.height = plan.size;
        settings.view = plan.view;
        settings.seed = seed + 1;
        settings.max_depth = plan.max_depth;
        Scene copy = scene;
        validate(copy);
        Renderer renderer(test_device(), copy, settings);
        renderer.render({0, plan.spp}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        double mean = 0;
        for (std::size_t p = 0; p < film.pixels(); ++p) mean += pixel_mean(film, p)[1];
        mean /= static_cast<double>(film.pixels());
        sum += mean;
        squares += mean * mean;
        out.not_finite += film.counters[1];
    }
    const double n = plan.seeds;
    out.mean = sum / n;
    out.standard_error = std::sqrt(std::max(0.0, (squares / n - out.mean * out.mean) / (n - 1)));
    return out;
}

/// Student's t quantile at which 8 seeds (7 degrees of freedom) are wrong once in 1e5, two-sided; the family
/// of all comparisons here stays below 1e-3 and seeds are fixed.
inline constexpr double t_limit = 10.1;

/// Expects the closed form within the statistical error and `bias`: what the test's own geometry or a table
/// leaves.
inline void expect_closed_form(const std::string& what, const Measured& m, double expected, double bias) {
    EXPECT_EQ(m.not_finite, 0u) << what;
    EXPECT_NEAR(m.mean, expected, t_limit * m.standard_error + bias * std::abs(expected)) << what;
    EXPECT_LT(m.standard_error, 0.01 * std::abs(expected)) << what << ": too noisy to prove anything";
}

}  // namespace triad::analytic
