#include "bench/kernel_bench_cases.h"

namespace triad {
namespace {

/// Inputs: 0 to 3 and 10 to 13 are uniform in [0, 1), 4 to 6 a unit vector with z > 0, 7 to 9 any unit
/// vector.
const std::string before = R"(#include "common/frame.h"
#include "common/random.h"
#include "shading/bsdf.h"
#include "shading/camera.h"
#include "shading/coverage.h"
#include "shading/light.h"
#include "shading/surface.h"
#define IN(k) in[(size_t)(k) * count + i]
#define OUT(k, value) out[(size_t)(k) * count + i] = (value)
#define OUT3(k, v) OUT(k, (v).x), OUT(k + 1, (v).y), OUT(k + 2, (v).z)
kernel void measured(SCENE_PARAMETERS, global const float* in, global float* restrict out, uint triangle_count, uint count) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    (void)triangle_count;
    TRIAD_ITEMS(i, count) {
)";

/// The material of a lobe, by lines that set what is special of it.
std::string make(const std::string& lines) {
    return R"(
    BsdfInput input = bsdf_input_plain(vec3_make(IN(0), IN(1), IN(2)));
    input.roughness = IN(3);
)" + lines +
           R"(
    const Vec3 wo = vec3_make(IN(4), IN(5), IN(6));
    const Bsdf b = bsdf_make(&input, wo, scene.albedo);
)";
}

const char* const made_diffuse = "    OUT3(0, b.base.diffuse);\n";
const char* const made = R"(
    OUT3(0, b.base.diffuse);
    OUT3(3, b.base.specular0);
    OUT3(6, b.base.specular1);
    OUT(9, b.base.p_specular);
)";
const char* const evaluated = R"(
    float pdf;
    const Colour f = bsdf_eval(&b, wo, vec3_make(IN(7), IN(8), IN(9)), &pdf);
    OUT3(0, f);
    OUT(3, pdf);
)";
const char* const sampled = R"(
    const BsdfSample s = bsdf_sample(&b, wo, IN(10), vec2_make(IN(11), IN(12)));
    OUT3(0, s.wi);
    OUT3(3, s.weight);
    OUT(6, s.pdf);
    OUT(7, (float)s.event);
)";
const char* const camera = R"(
    const Camera camera = frame->camera;
    const Ray ray =
        camera_ray(&camera, IN(0) * camera.pixels[0], IN(1) * camera.pixels[1], vec2_make(IN(2), IN(3)));
    OUT3(0, VEC3_OF(ray.origin));
    OUT3(3, VEC3_OF(ray.direction));
)";
const char* const random_block = R"(
    const Sampler sampler = sampler_make((uint)i, 5u, 0u, 0u, 1u);
    const SamplerBlock u = sampler_block(&sampler, 1u + ((uint)i & 7u));
    OUT(0, random_float(u.set[0].x)), OUT(1, random_float(u.set[0].y));
    OUT(2, random_float(u.set[1].x)), OUT(3, random_float(u.set[1].y));
    OUT(4, random_float(u.set[2].x)), OUT(5, random_float(u.set[2].y));
    OUT(6, random_float(u.set[3].x)), OUT(7, random_float(u.set[3].y));
)";
const char* const radiance = R"(
    float pdf;
    const Vec3 found = environment_radiance(&scene, vec3_make(IN(7), IN(8), IN(9)), 0u, &pdf);
    OUT3(0, found);
    OUT(3, pdf);
)";
const char* const environment_drawn = R"(
    const Environment e = frame->environment;
    Vec2 uv;
    const Vec3 d = environment_sample(
        &scene, &e, uvec2_make((uint)(IN(0) * 4294967040.0f), (uint)(IN(1) * 4294967040.0f)), &uv);
    OUT3(0, d);
    OUT(3, uv.x);
    OUT(4, uv.y);
)";
const char* const light_drawn = R"(
    LightSample light;
    light.direction = light.weight = vec3_splat(0.0f);
    light.inverse_pdf = 0.0f;
    const Receiver receiver = {vec3_make(IN(0) - 0.5f, IN(1) - 0.5f, IN(2) - 0.5f), vec3_splat(0.0f)};
    const int lit = light_sample(
        &scene, receiver, uvec2_make((uint)(IN(10) * 4294967040.0f), (uint)(IN(11) * 4294967040.0f)), &light);
    OUT3(0, light.direction);
    OUT3(3, light.weight);
    OUT(6, light.inverse_pdf);
    OUT(7, (float)lit);
)";
const char* const texture = R"(
    const Vec2 uv = vec2_make(8.0f * IN(0) - 4.0f, 8.0f * IN(1) - 4.0f);
    const Vec4 texel = texture_use_sample(&scene, 0u, uv, uv, vec4_splat(1.0f));
    OUT3(0, texel);
    OUT(3, texel.w);
)";
const char* const alpha = R"(
    Coverage coverage;
    coverage.scene = &scene;
    coverage.ray = (uint)i;
    const uint primitive = (uint)(IN(0) * (float)triangle_count);
    OUT(0, (float)coverage_accept(&coverage, 0u, primitive, 0.5f * IN(1), 0.5f * IN(2)));
)";

}  // namespace

std::vector<KernelBenchCase> kernel_bench_cases() {
    std::vector<KernelBenchCase> cases = {{"camera_ray", "LENS", camera},
                                          {"random_numbers", "SPECULAR", random_block}};
    struct Lobe {
        const char *name, *feature, *lines;
    };
    for (const Lobe& lobe :
         {Lobe{"diffuse", "TRIANGLE_LIGHTS", ""},
          {"metal", "SPECULAR", "    input.metallic = 1.0f;\n"},
          {"glossy", "SPECULAR", ""},
          {"glass", "TRANSMISSION",
           "    input.transmission = 1.0f, input.solid = 1u, input.inside = IN(13) < 0.5f;\n"}}) {
        const std::string name = lobe.name, make_it = make(lobe.lines);
        cases.push_back(
            {"bsdf_make_" + name, lobe.feature, make_it + (name == "diffuse" ? made_diffuse : made)});
        cases.push_back({"bsdf_eval_" + name, lobe.feature, make_it + evaluated});
        cases.push_back({"bsdf_sample_" + name, lobe.feature, make_it + sampled});
    }
    cases.push_back({"environment_radiance", "ENVIRONMENT_MAP", radiance});
    cases.push_back({"environment_sample", "ENVIRONMENT_MAP", environment_drawn});
    cases.push_back({"light_sample_triangle", "TRIANGLE_LIGHTS", light_drawn});
    cases.push_back({"light_sample_punctual", "PUNCTUAL_LIGHTS", light_drawn});
    cases.push_back({"texture_sample", "TEXTURES", texture});
    cases.push_back({"alpha_coverage", "ALPHA_TEST", alpha});
    return cases;
}

std::string kernel_bench_source(const KernelBenchCase& c) { return before + c.body + "    }\n}\n"; }

}  // namespace triad
