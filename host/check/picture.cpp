#include "check/picture.h"

#include <algorithm>

#include "check/kernels.h"

namespace triad::picture_case {

Material lambert(float albedo) {
    Material m;
    m.base_colour = {albedo, albedo, albedo, 1.0f};
    m.metallic = 0.0f;
    m.roughness = 1.0f;
    m.specular = 0.0f;
    return m;
}

Material emitter(float radiance, bool double_sided) {
    Material m = lambert(0.0f);
    m.emission = vec3(radiance);
    m.double_sided = double_sided;
    return m;
}

Material glass(float ior, float roughness) {
    Material m;
    m.metallic = 0.0f;
    m.roughness = roughness;
    m.ior = ior;
    m.transmission = 1.0f;
    m.thickness = 1.0f;
    return m;
}

Builder& Builder::add(Primitive primitive, const Material& material, const dmat4& to_world) {
    primitive.material = scene.materials.size();
    scene.materials.push_back(material);
    scene.meshes.push_back({"mesh " + std::to_string(scene.meshes.size()), {std::move(primitive)}});
    scene.instances.push_back({"node", scene.meshes.size() - 1, to_world});
    return *this;
}

Builder& Builder::sky(float radiance) {
    scene.sky = vec3(radiance);
    return *this;
}

Primitive square(double height, bool up, double half) {
    const float h = static_cast<float>(half), y = static_cast<float>(height);
    return up ? shapes::quad({-h, y, h}, {2 * h, 0, 0}, {0, 0, -2 * h})
              : shapes::quad({-h, y, -h}, {2 * h, 0, 0}, {0, 0, 2 * h});
}

View orthographic(const dvec3& centre, const dvec3& towards, double half, double distance) {
    View v = look_at(centre - towards * distance, centre, 1.0, 1.0);
    v.orthographic = true;
    v.extent = {half, half};
    return v;
}

Scene varied_scene() {
    Builder b;
    Material wall = lambert(0.7f);
    wall.base_colour_texture = TextureUse{};
    b.scene.images.push_back(
        {"checks", 2, 2, 8, {255, 255, 255, 255, 90, 60, 40, 255, 90, 60, 40, 255, 255, 255, 255, 255}});
    b.scene.textures.push_back({});
    Material metal;
    metal.base_colour = {0.9f, 0.7f, 0.4f, 1.0f};
    metal.roughness = 0.3f;
    Material leaf = lambert(0.5f);
    leaf.alpha_mode = AlphaMode::blend;
    leaf.base_colour.w = 0.6f;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 4, 4), wall);
    b.add(shapes::lat_long_sphere({-0.7f, 0.5f, 0}, 0.5f, 32, 16), glass(1.5f));
    b.add(shapes::lat_long_sphere({0.7f, 0.5f, 0}, 0.5f, 32, 16), metal);
    b.add(shapes::quad({-1, 0, 0.8f}, {2, 0, 0}, {0, 1, 0}), leaf);
    b.add(shapes::quad({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}), emitter(5.0f));
    b.scene.lights.push_back({.position = {1, 2, 1}, .colour = vec3(2.0f)});
    std::vector<float> sky(16 * 8 * 3);
    for (std::size_t i = 0; i < sky.size(); ++i) sky[i] = 0.1f + 0.01f * static_cast<float>(i % 37);
    b.scene.environment = EnvironmentMap{16, 8, sky};
    return b.scene;
}

RenderSettings varied_settings() {
    RenderSettings s;
    s.width = 37;
    s.height = 29;
    s.seed = 5;
    s.view = look_at({0.3, 1.2, 3.5}, {0, 0.5, 0}, 0.8, 37.0 / 29.0);
    return s;
}

std::optional<Features> features_at(CheckLevel level) {
    if (level == CheckLevel::full) return {};
    static const Features varied = [] {
        Scene scene = varied_scene();
        validate(scene);
        Features f = features_of(pack(scene, varied_settings()), varied_settings());
        f.light_tree = true;   // spheres that glow are many lights
        f.near_lights = true;  // squares above what they light: one program less to compile
        return f;
    }();
    return varied;
}

Film render(Device& device, const Scene& scene, const RenderSettings& settings,
            const std::vector<SampleRange>& ranges, const std::optional<Features>& features) {
    Scene copy = scene;
    validate(copy);
    Renderer renderer(device, copy, settings, features);
    for (const SampleRange& r : ranges) renderer.render(r, [](const Progress&) { return true; });
    return renderer.film();
}

Measured measure(Device& device, const Scene& scene, const Plan& plan,
                 const std::optional<Features>& features) {
    double sum = 0, squares = 0;
    Measured out;
    for (unsigned seed = 0; seed < plan.seeds; ++seed) {
        RenderSettings settings;
        settings.width = settings.height = plan.size;
        settings.view = plan.view;
        settings.seed = seed + 1;
        settings.max_depth = plan.max_depth;
        const Film film = render(device, scene, settings, {{0, plan.spp}}, features);
        double mean = 0;
        for (std::size_t p = 0; p < film.pixels(); ++p)
            mean += pixel_mean(film, p)[std::size_t(plan.channel)];
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

Measured measure(Check& check, const Scene& scene, Plan plan) {
    const unsigned cut = check.level == CheckLevel::full || check.level == CheckLevel::tiny ? 1
                         : check.level == CheckLevel::standard                              ? 2
                                                                                            : 4;
    plan.spp = std::max(4u, plan.spp / cut);
    if (check.level == CheckLevel::tiny) plan.spp = 4, plan.size = std::min(plan.size, 4u);
    return measure(check.device, scene, plan, features_at(check.level));
}

std::vector<std::array<float, 4>> draw_lights(Check& check, const PackedScene& packed,
                                              const std::string& body, std::size_t count) {
    const std::string source = R"(#include "shading/light.h"
__kernel void draw(__global Vec4* out, SCENE_PARAMETERS, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Sampler s = sampler_make(0u, i, 0u, 0u, 5u);
    const SamplerBlock u = sampler_block(&s, SAMPLER_SOBOL_BLOCKS);
    Vec4 w;
    )" + body + R"(
    out[i] = w;
}
)";
    return run_kernel<std::array<float, 4>>(check.device, source, "draw",
                                            scene_arguments(check.device, packed, RenderSettings{}), count);
}

void expect_closed_form(Check& check, const std::string& what, const Measured& m, double expected,
                        double bias) {
    check.at_most(double(m.not_finite), 0, "samples that are not finite, ", what);
    check.near(m.mean, expected, t_limit * m.standard_error + bias * std::abs(expected), what);
    // Else it would prove nothing; fewer samples are noisier.
    if (check.level > CheckLevel::tiny)
        check.holds(m.standard_error < (check.level == CheckLevel::full ? 0.01 : 0.02) * std::abs(expected),
                    what, " is too noisy: ", m.standard_error);
}

}  // namespace triad::picture_case
