#include "render/pack.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/albedo_tables.h"
#include "render/ray_filter.h"

namespace triad {
namespace {

void copy(float out[3], const dvec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

}  // namespace

PackedScene pack(const Scene& scene, const RenderSettings& settings) {
    PackedScene packed;
    pack_geometry(scene, settings, packed);
    pack_materials(scene, packed);
    pack_spectrum(scene, settings, packed);
    pack_environment(scene, settings, packed);
    pack_lights(scene, packed);
    pack_wavelengths(packed);
    pack_photons(scene, settings, packed);
    packed.flattened = {};
    return packed;
}

dev::Frame frame_of(const PackedScene& packed, const RenderSettings& settings) {
    dev::Frame frame{};
    dev::Camera& c = frame.camera;
    const View& view = settings.view;
    copy(c.origin, view.eye - packed.origin);
    copy(c.right, view.right);
    copy(c.up, view.up);
    copy(c.forward, view.forward);
    c.lens_radius = static_cast<float>(view.lens_radius);
    c.focus_distance = static_cast<float>(view.focus_distance);
    c.projection = view.orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    c.extent[0] = static_cast<float>(view.extent.x);
    c.extent[1] = static_cast<float>(view.extent.y);
    c.pixels[0] = static_cast<float>(settings.width);
    c.pixels[1] = static_cast<float>(settings.height);
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
    frame.root = packed.root;
    frame.first_block = settings.independent ? SAMPLER_SOBOL_BLOCKS : 0;
    frame.wavelength_from_camera = settings.spectral == Spectral::classic;
    frame.lights = packed.light_shape;
    frame.ray_start = settings.ray_start == RayStart::centre   ? RAY_START_CENTRE
                      : settings.ray_start == RayStart::filter ? RAY_START_FILTER
                                                               : RAY_START_JITTER;
    if (packed.chosen == Integrator::photons) frame.photon_map = PHOTON_MAP_PROGRESSIVE;
    if (packed.chosen == Integrator::photon_map)
        frame.photon_map = settings.final_gather ? PHOTON_MAP_FINAL_GATHER : PHOTON_MAP_VISUALISED;
    if (settings.ray_start == RayStart::filter) frame.ray_filter = ray_filter_shape(settings);
    return frame;
}

DeviceScene upload(Device& device, const PackedScene& packed, const RenderSettings& settings,
                   const PhotonMapBuffers& photon_map) {
    DeviceScene scene;
    auto add = [&](const auto& values) {
        const Buffer buffer = device.upload(values);
        scene.bytes += buffer.bytes();
        scene.arguments.add(buffer);
        return buffer;
    };
    std::vector<float> srgb(256);
    for (int i = 0; i < 256; ++i)
        srgb[static_cast<std::size_t>(i)] = static_cast<float>(srgb_decode(i / 255.0));
    // The order of SCENE_PARAMETERS in kernels/shading/scene.h.
    scene.frame = add(std::vector<dev::Frame>{frame_of(packed, settings)});
    add(packed.bvh.nodes);
    add(packed.bvh.blocks);
    add(packed.instance_table);
    add(packed.triangles);
    add(packed.geometries);
    add(packed.normals);
    add(packed.tangents);
    add(packed.uvs);
    add(packed.colours);
    add(packed.materials);
    add(packed.texture_uses);
    add(packed.textures);
    add(packed.texels);
    add(srgb);
    add(albedo_tables());
    add(packed.lights);
    add(packed.light_cdf);
    add(packed.env_texels);
    add(packed.env_rows);
    add(packed.env_columns);
    add(packed.env_cosines);
    add(packed.spectrum);
    add(packed.indices);
    add(ray_filter_tables(settings));
    scene.arguments.add(photon_map.map).add(photon_map.photons).add(photon_map.ends);
    return scene;
}

}  // namespace triad
