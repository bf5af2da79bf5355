#include "pack/pack.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pack/near_lights.h"
#include "pack/ray_filter.h"

namespace triad {
namespace {

std::shared_ptr<const PackedSurfaces> pack_surfaces(const Scene& scene, const RenderSettings& settings) {
    auto surfaces = std::make_shared<PackedSurfaces>();
    pack_materials(scene, settings, *surfaces);
    pack_film_responses(scene, *surfaces);
    pack_spectrum(scene, settings, *surfaces);
    pack_environment(scene, settings, *surfaces);
    return surfaces;
}

/// After pack_lights().
void name_light_sources(const Scene& scene, PackedScene& packed) {
    std::vector<std::string>& names = packed.light_sources;
    const auto add = [&](const char* kind, const auto& things) {
        for (std::size_t i = 0; i < things.size(); ++i)
            names.push_back(std::string(kind) + " " +
                            (things[i].name.empty() ? std::to_string(i) : '"' + things[i].name + '"'));
    };
    add("material", scene.materials);
    auto punctual = static_cast<std::uint32_t>(names.size());
    add("light", scene.lights);
    const auto sky = static_cast<std::uint32_t>(names.size());
    names.push_back("environment");
    for (const dev::Light& l : packed.lights)
        packed.source_of_light.push_back(
            l.type == LIGHT_TRIANGLE      ? packed.geometries[packed.triangles[l.primitive].geometry].material
            : l.type == LIGHT_ENVIRONMENT ? sky
                                          : punctual++);
}

}  // namespace

void set_surfaces(PackedScene& packed, std::shared_ptr<const PackedSurfaces> surfaces) {
    packed.surfaces = std::move(surfaces);
    packed.environment = packed.surfaces->environment;
    packed.spectrum = packed.surfaces->spectrum;
}

PackedScene pack(const Scene& scene, const RenderSettings& settings,
                 std::shared_ptr<const PackedSurfaces> surfaces, const BvhFormats& formats) {
    PackedScene packed;
    packed.bvh.formats = formats;
    packed.scene = hash_of(scene);
    packed.settings = settings;
    packed.facts = facts_of(scene);
    pack_geometry(scene, settings, packed);
    set_surfaces(packed, surfaces ? std::move(surfaces) : pack_surfaces(scene, settings));
    pack_lights(scene, packed);
    mark_near_lights(scene, packed);
    pack_wavelengths(packed);
    pack_photons(scene, settings, packed);
    name_light_sources(scene, packed);
    packed.emitters = std::vector<BvhTriangle>();  // {} would keep the memory
    return packed;
}

dev::Frame frame_of(const PackedScene& packed, const RenderSettings& settings) {
    dev::Frame frame{};
    dev::Camera& c = frame.camera;
    const View& view = settings.view;
    to_floats(c.origin, view.eye - packed.origin);
    to_floats(c.right, view.right);
    to_floats(c.up, view.up);
    to_floats(c.forward, view.forward);
    c.lens_radius = static_cast<float>(view.lens_radius);
    c.focus_distance = static_cast<float>(view.focus_distance);
    c.projection = view.orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    c.extent[0] = static_cast<float>(view.extent.x);
    c.extent[1] = static_cast<float>(view.extent.y);
    c.pixels[0] = static_cast<float>(settings.width);
    c.pixels[1] = static_cast<float>(settings.height);
    c.pixel_area = 4 * c.extent[0] * c.extent[1] / (c.pixels[0] * c.pixels[1]);
    frame.environment = packed.environment;
    const std::array<unsigned, 4> crop =
        settings.crop[2] ? settings.crop : std::array<unsigned, 4>{0, 0, settings.width, settings.height};
    std::copy(crop.begin(), crop.end(), frame.crop);
    frame.bins[0] = settings.bins_x;
    frame.bins[1] = settings.bins_y;
    frame.seed = settings.seed;
    frame.max_depth = settings.max_depth;
    frame.roulette = static_cast<float>(1.0 / settings.roulette);
    frame.transparent = settings.transparent;
    frame.light_count = static_cast<std::uint32_t>(packed.lights.size());
    frame.quanta = std::ldexp(1.0f, packed.quanta_log2);
    std::copy(packed.roots.begin(), packed.roots.end(), frame.root);
    frame.first_block = settings.independent ? SAMPLER_SOBOL_BLOCKS : 0;
    frame.wavelength_from_camera = settings.spectral == Spectral::classic;
    frame.lights = packed.light_shape;
    frame.light_first = packed.light_tree.first_share, frame.light_range = packed.light_tree.shares;
    frame.ray_start = settings.ray_start == RayStart::centre   ? RAY_START_CENTRE
                      : settings.ray_start == RayStart::filter ? RAY_START_FILTER
                                                               : RAY_START_JITTER;
    const Integrator integrator = integrator_of(packed, settings);
    frame.photons = integrator != Integrator::path;
    if (integrator == Integrator::photons) frame.photon_map = PHOTON_MAP_PROGRESSIVE;
    if (integrator == Integrator::photon_map)
        frame.photon_map = settings.final_gather ? PHOTON_MAP_FINAL_GATHER : PHOTON_MAP_VISUALISED;
    if (settings.ray_start == RayStart::filter) frame.ray_filter = ray_filter_shape(settings);
    return frame;
}

}  // namespace triad
