#pragma once
/// Scenes with a known answer: a few primitives, a camera, and statistics of the picture.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/measurements.h"
#include "render/renderer.h"
#include "scene/shapes.h"

namespace triad::picture_case {

/// Lambert with this albedo and nothing else: KHR_materials_specular with factor 0.
Material lambert(float albedo);
/// A black body that emits `radiance`.
Material emitter(float radiance, bool double_sided = false);
/// White solid glass.
Material glass(float ior, float roughness = 0.0f);

struct Builder {
    Scene scene;

    Builder& add(Primitive primitive, const Material& material, const dmat4& to_world = dmat4(1.0));
    Builder& sky(float radiance);
};

/// A square about the y axis in the plane y = height, with its front up or down.
Primitive square(double height, bool up, double half = 0.5);

/// Sees [-half, half]^2 around `centre` from `distance` away, orthographically, against `towards` (unit).
View orthographic(const dvec3& centre, const dvec3& towards, double half, double distance);

/// A small room with everything in it: textures, alpha, glass, metal, an area light, a point light, an
/// environment; and a small picture of it.
Scene varied_scene();
RenderSettings varied_settings();

/// What is compiled in besides what a scene needs: nothing at the full level; below it what the varied scene
/// and spheres that glow need, so that few programs are compiled and none that takes a slow compiler minutes.
std::optional<Features> features_at(CheckLevel level);

/// The film of these sample ranges. `features` are compiled in besides those of the scene.
Film render(Device& device, const Scene& scene, const RenderSettings& settings,
            const std::vector<SampleRange>& ranges, const std::optional<Features>& features = {});

/// A kernel over the scene's arrays, with `body` computing Vec4 w from i, s and u (sampler of item i and a
/// block of its numbers) and scene.
std::vector<std::array<float, 4>> draw_lights(Check& check, const PackedScene& packed,
                                              const std::string& body, std::size_t count);

/// Mean of a channel over the picture, and the standard error of that mean from independent seeds.
struct Measured {
    double mean = 0, standard_error = 0;
    std::uint64_t not_finite = 0;
};

struct Plan {
    View view;
    unsigned size = 16, spp = 64, seeds = 8, max_depth = 0;
    int channel = 1;
};

Measured measure(Device& device, const Scene& scene, const Plan& plan,
                 const std::optional<Features>& features = {});

/// The same with the samples and the features of the check's level.
Measured measure(Check& check, const Scene& scene, Plan plan);

/// Student's t quantile at which 8 seeds (7 degrees of freedom) are wrong once in 1e5, two-sided; the family
/// of all comparisons stays below 1e-3 and seeds are fixed.
inline constexpr double t_limit = 10.1;

/// Measures the closed form within the statistical error and `bias`: what the case's own geometry or a table
/// leaves.
void expect_closed_form(Check& check, const std::string& what, const Measured& m, double expected,
                        double bias);

}  // namespace triad::picture_case
