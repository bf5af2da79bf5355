#include "pack/features.h"

#include <algorithm>

#include "pack/pack.h"

namespace triad {
namespace {

constexpr FeatureOption table[] = {
    {"INSTANCES", &Features::instances},
    {"ALPHA_TEST", &Features::alpha_test},
    {"TEXTURES", &Features::textures},
    {"TEXTURE_LEVELS", &Features::texture_levels},
    {"NORMAL_MAPS", &Features::normal_maps},
    {"VERTEX_COLOURS", &Features::vertex_colours},
    {"SPECULAR", &Features::specular},
    {"TRANSMISSION", &Features::transmission},
    {"DISPERSION", &Features::dispersion},
    {"LIGHT_SPECTRA", &Features::light_spectra},
    {"PRIORITIES", &Features::priorities},
    {"CLEARCOAT", &Features::clearcoat},
    {"SHEEN", &Features::sheen},
    {"ANISOTROPY", &Features::anisotropy},
    {"IRIDESCENCE", &Features::iridescence},
    {"DIFFUSE_TRANSMISSION", &Features::diffuse_transmission},
    {"UNLIT", &Features::unlit},
    {"TRIANGLE_LIGHTS", &Features::triangle_lights},
    {"NEAR_LIGHTS", &Features::near_lights},
    {"PUNCTUAL_LIGHTS", &Features::punctual_lights},
    {"ENVIRONMENT_MAP", &Features::environment_map},
    {"LIGHT_TREE", &Features::light_tree},
    {"LENS", &Features::lens},
    {"INDEPENDENT_SAMPLES", &Features::independent_samples},
    {"RAY_STARTS", &Features::ray_starts},
    {"PHOTONS", &Features::photons},
    {"GATHER", &Features::gather},
    {"BINS", &Features::bins},
};

bool textured(const Material& m) { return !texture_uses_of(m).empty(); }

}  // namespace

std::span<const FeatureOption> feature_options() { return table; }

std::string FeatureOption::words() const {
    std::string words = name;
    std::transform(words.begin(), words.end(), words.begin(),
                   [](char c) { return c == '_' ? ' ' : char(std::tolower(c)); });
    return words;
}

Features facts_of(const Scene& scene) {
    std::vector<bool> used(scene.materials.size());
    Features f;
    f.vertex_colours = false;
    for (const MeshInstance& i : scene.instances)
        for (const Primitive& p : scene.meshes[i.mesh].primitives) {
            used[p.material] = true;
            f.vertex_colours |= !p.colours.empty();
        }
    auto any = [&](auto&& fact) {
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i] && fact(scene.materials[i])) return true;
        return false;
    };
    f.alpha_test = any([](const Material& m) { return m.alpha_mode != AlphaMode::opaque; });
    f.textures = any(textured);
    f.normal_maps = any(
        [](const Material& m) { return m.normal_texture || (m.clearcoat && m.clearcoat->normal_texture); });
    f.specular =
        any([](const Material& m) { return m.specular > 0 || m.metallic > 0 || m.transmission > 0; });
    f.transmission = any([](const Material& m) { return m.transmission > 0 || is_solid(m); });
    f.dispersion = any([](const Material& m) { return m.dispersion.has_value(); });
    f.priorities = any([](const Material& m) { return m.priority != 0; });
    f.clearcoat = any([](const Material& m) { return m.clearcoat.has_value(); });
    f.sheen = any([](const Material& m) { return m.sheen.has_value(); });
    f.anisotropy = any([](const Material& m) { return m.anisotropy.has_value(); });
    f.iridescence = any([](const Material& m) { return m.iridescence.has_value(); });
    f.diffuse_transmission = any([](const Material& m) { return m.diffuse_transmission.has_value(); });
    f.unlit = any([](const Material& m) { return m.unlit; });
    f.triangle_lights = any([](const Material& m) { return m.emission != vec3(0.0f); });
    f.punctual_lights = !scene.lights.empty();
    f.environment_map = scene.environment.has_value();
    return f;
}

Features features_of(const PackedScene& packed, const RenderSettings& settings) {
    Features f = packed.facts;
    f.instances = packed.instances;
    f.texture_levels = has_levels(*packed.surfaces);
    f.dispersion =
        settings.spectral == Spectral::classic || (settings.spectral != Spectral::off && f.dispersion);
    f.light_spectra = packed.spectrum.size() > 1;
    f.near_lights = std::any_of(packed.lights.begin(), packed.lights.end(),
                                [](const dev::Light& l) { return l.type == LIGHT_TRIANGLE && l.range > 0; });
    f.light_tree = !packed.light_tree.nodes.empty();
    f.lens = settings.view.lens_radius > 0;
    f.independent_samples = settings.independent;
    f.ray_starts = settings.ray_start != RayStart::jitter;
    const Integrator integrator = integrator_of(packed, settings);
    f.photons = integrator != Integrator::path;
    f.gather = integrator == Integrator::photons || integrator == Integrator::photon_map;
    f.bins = settings.bins_x * settings.bins_y > 1;
    return f;
}

Features united(const Features& a, const Features& b) {
    Features both = a;
    for (const FeatureOption& o : table) both.*o.member |= b.*o.member;
    return both;
}

std::map<std::string, std::string> options_of(const Features& features) {
    std::map<std::string, std::string> options;
    for (const FeatureOption& o : table)
        options[std::string("TRIAD_") + o.name] = features.*o.member ? "1" : "0";
    return options;
}

std::vector<std::string> left_out(const Features& features) {
    std::vector<std::string> names;
    for (const FeatureOption& o : table)
        if (!(features.*o.member)) names.push_back(o.words());
    return names;
}

}  // namespace triad
