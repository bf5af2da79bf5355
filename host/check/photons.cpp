// Photons: the hash grid against all photons looked at one by one, what lands of what is emitted, and what
// splats and gathering make of a light and its images in mirrors.
#include <random>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/features.h"
#include "trace/photon_map.h"

namespace triad {
namespace {

using namespace picture_case;

const char* const photons_source = R"(#include "common/language.h"
#include "shading/photon_map.h"
/* What a white Lambertian surface gathers at each point: from the grid, and from all photons. */
kernel void gather(global const Frame* frame, global const PhotonMap* map, global const Photon* photons,
                   global const uint* ends, global const Photon* landed, uint count, global const float* points,
                   uint point_count, global float* from_grid, global float* from_all) {
    const uint i = get_global_id(0);
    if (i >= point_count) return;
    Scene scene;
    scene.frame = frame, scene.photon_map = map, scene.photons = photons, scene.photon_ends = ends;
    PhotonQuery q;
    q.position = vec3_load(points, i);
    q.normal = vec3_make(0.0f, 0.0f, 1.0f);
    q.most_edges = 0u;
    q.which = PHOTON_ANY;
    q.radius = map->radius;
    q.wavelength = 0.0f;
    VertexBsdf v;
    v.frame = frame_make(q.normal);
    v.wo = q.normal;
    BsdfInput input = bsdf_input_plain(vec3_splat(1.0f));
    input.specular = 0.0f;
    v.bsdf = bsdf_make(&input, v.wo, 0);
    vec3_store(photon_gather(&scene, &q, &v), from_grid, i);
    long sums[3] = {0, 0, 0};
    const PhotonMap m = *map;
    for (uint k = 0u; k < count; ++k) photon_add(&scene, &m, &q, &v, landed + k, sums);
    for (uint c = 0u; c < 3u; ++c) from_all[3 * i + c] = convert_float(sums[c]) * (1.0f / frame->quanta);
}
/* Photons as a path would leave them. */
kernel void land(global const float* places, uint count, global Photon* landed) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Vec3 from = vec3_normalize(vec3_make(0.3f, -0.2f, 1.0f));
    landed[i] = photon_make(vec3_load(places, i), vec3_make(1.0f, 0.5f, 0.25f), from, vec3_make(0.0f, 0.0f, 1.0f), 3u,
                            1, 0.0f);
    if (i % 7u == 0u) landed[i].direction = 0u; /* landed nowhere */
}
)";

/// Photons in clusters on planes around the origin and far from it, and points among them.
void expect_grid_finds_all(Check& check, double extent, double radius, unsigned seed) {
    const auto photons = std::uint32_t(check.count(20000, 2000)), points = photons / 50;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<float> places, queries;
    for (std::uint32_t i = 0; i < photons + points; ++i) {
        const float cluster = float(i % 5) / 5, size = i % 3 == 0 ? 1.0f : 0.05f;
        std::vector<float>& to = i < photons ? places : queries;
        to.push_back(float(extent) * (cluster + size * unit(random)));
        to.push_back(float(extent) * (-cluster + size * unit(random)));
        to.push_back(float(extent) * (i % 2 ? 0.5f : -0.25f));
    }
    // Points where no photon is, or that are none: counted cell by cell, the way between two would not end.
    for (std::uint32_t i = 0; const float far : {INFINITY, -INFINITY, NAN, 3e38f, -3e38f, 1e10f, 1e8f})
        queries[3 * i] = far, queries[3 * i + 1] = i % 2 ? -far : 0.0f, queries[3 * i + 2] = far, ++i;
    Device& device = check.device;
    const Options plain = {{"TRIAD_SPECULAR", "0"}, {"TRIAD_TRANSMISSION", "0"}, {"TRIAD_DISPERSION", "0"}};
    const Program program = device.build_source("photon_grid.cl", photons_source, plain);
    PhotonMap map(device, photons);
    map.compile(plain);
    dev::Frame frame{};
    frame.quanta = 0x1p20f;
    device.run(program.kernel("land"), Arguments().add(device.upload(places)).add(photons).add(map.landed()),
               photons);
    dev::PhotonMap shape{};
    shape.radius = float(radius);
    map.sort(shape, photons);
    const Buffer from_grid = device.allocate(points * 3 * sizeof(float)),
                 from_all = device.allocate(points * 3 * sizeof(float));
    device.run(program.kernel("gather"),
               Arguments()
                   .add(device.upload(std::vector<dev::Frame>{frame}))
                   .add(map.buffers().map)
                   .add(map.buffers().photons)
                   .add(map.buffers().ends)
                   .add(map.landed())
                   .add(photons)
                   .add(device.upload(queries))
                   .add(points)
                   .add(from_grid)
                   .add(from_all),
               points);
    const auto grid = device.download<float>(from_grid), all = device.download<float>(from_all);
    std::size_t lit = 0, differ = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) lit += all[i] > 0, differ += grid[i] != all[i];
    check.at_most(double(differ), 0, "sums that differ, extent ", extent, ", radius ", radius);
    check.above(double(lit), points / 10.0, "sums that find photons");
}

void grid_finds_all(Check& check) {
    expect_grid_finds_all(check, 1, 0.02, 1);
    expect_grid_finds_all(check, 1, 0.6, 2);  // few cells, many photons in each
    expect_grid_finds_all(check, 1000, 4, 3);
    expect_grid_finds_all(check, 1e-3, 2e-5, 4);
}

/// Traces photons through a scene without a camera's help, and returns those that landed.
std::vector<dev::Photon> landed_in(Device& device, Scene scene, std::uint64_t photons) {
    validate(scene);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.integrator = Integrator::photon_map;
    settings.photons = photons;
    settings.view = look_at({0, 0, 0}, {0, 0, 1}, 1.0, 1.0);
    const PackedScene packed = pack(scene, settings);
    const dev::Frame frame = frame_of(packed, settings);
    PhotonMap map(device, photons);
    const Arguments on_device = scene_arguments(device, packed, settings, map.buffers());
    const Kernel trace =
        device.build("path/photons.cl", options_of(features_of(packed, settings))).kernel("trace_photons");
    const dev::TracePhotonsArguments own{
        .sums = {},
        .half_sums = {},
        .counters = device.allocate_array<std::uint32_t>(2 * COUNTERS),
        .photon_frame =
            device.upload(std::vector<dev::PhotonFrame>{photon_frame_of(packed, settings, frame)}),
        .photon_lights = device.upload(packed.photon_lights),
        .casters = {},
        .sample_low = 0,
        .sample_high = 0,
        .first_photon = 0,
        .photon_count = std::uint32_t(photons),
        .share = 1.0f / float(photons),
        .landed = map.landed(),
        .tiles = {},
        .first_pixel = 0,
        .pixels = 0};
    device.fill_zero(own.counters);
    device.run(trace, Arguments(on_device).add(arguments_of(own)), photons);
    return device.download<dev::Photon>(map.landed());
}

/// Unit vector of octahedral coordinates with so many bits each.
dvec3 unpacked(std::uint32_t packed, unsigned bits) {
    const double most = (1u << bits) - 1;
    const double x = (packed & ((1u << bits) - 1)) / most * 2 - 1, y = (packed >> bits) / most * 2 - 1;
    dvec3 v(x, y, 1 - std::abs(x) - std::abs(y));
    if (v.z < 0) v = {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), v.z};
    return glm::normalize(v);
}

/// Flux that lands within 4 sigma; of the first landings alone, or of all.
void expect_landed(Check& check, const char* what, const Scene& scene, bool first_alone, double expected) {
    const std::uint64_t n = check.count(60000, 4000);
    double sum = 0, squares = 0;
    for (const dev::Photon& p : landed_in(check.device, scene, n)) {
        const unsigned edges = p.direction & 127;
        if (edges == 0 || (first_alone && edges > 1)) continue;
        const double cosine = std::abs(glm::dot(unpacked(p.direction >> 8, 12), unpacked(p.normal >> 16, 8)));
        const double flux = double(p.power[1]) * double(n) * cosine;
        sum += flux, squares += flux * flux;
    }
    const double mean = sum / double(n), sigma = std::sqrt((squares / double(n) - mean * mean) / double(n));
    check.near(mean, expected, 4 * sigma + 1e-3 * expected, what);  // directions are kept to .1 degrees
    check.also_at_most(sigma, 0.01 * expected * std::sqrt(60000.0 / double(n)), "noise of ", what);
}

/// A closed diffuse box around the origin.
Builder room() {
    Builder b;
    Material wall = lambert(0.6f);
    wall.double_sided = true;
    b.add(shapes::box({-1, -1, -1}, {1, 1, 1}), wall);
    return b;
}

void what_is_emitted_lands(Check& check) {
    Builder point = room();
    PunctualLight light;
    light.position = {0.2, 0.1, -0.3};
    light.colour = vec3(2.0f);
    point.scene.lights.push_back(light);
    expect_landed(check, "first landings", point.scene, true, 4 * pi * 2);
    expect_landed(check, "all landings at albedo .6", point.scene, false, 4 * pi * 2 / (1 - 0.6));
    Builder lamp = room();
    lamp.add(shapes::quad({-0.3f, 0.5f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}), emitter(3.0f));
    expect_landed(check, "a lamp's", lamp.scene, true, pi * 3 * 0.36);
}

Material mirror() {
    Material m;
    m.metallic = 1, m.roughness = 0;
    m.base_colour = {1, 1, 1, 1};
    return m;
}

/// A floor that is lit by a point light and its three images in two mirrors, and seen in one of them: paths
/// find the light alone, photons the images.
void light_and_its_images(Check& check) {
    Builder b;
    b.add(shapes::quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), lambert(0.002f));  // dark: no light goes round
    b.add(shapes::quad({1, -1, 2}, {0, 0, -4}, {0, 4, 0}), mirror());
    b.add(shapes::quad({-3, 2, -2}, {4, 0, 0}, {0, 0, 4}), mirror());
    PunctualLight light;
    light.position = {0.3, 1.5, 0.2};
    light.colour = vec3(5.0f);
    b.scene.lights.push_back(light);
    double expected = 0;
    for (const double x : {0.3, 1.7})
        for (const double y : {1.5, 2.5})
            expected += 0.002 / pi * 5 * y / std::pow(x * x + y * y + 0.2 * 0.2, 1.5);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.integrator = Integrator::automatic;
    settings.photons = 1 << 15;
    settings.view = look_at({0, 1, 0}, {0, 2, 0}, 0.02, 1.0);
    const unsigned seeds = 4, samples = unsigned(check.count(64, 8));
    double sum = 0;
    for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
        const Film film = render(check.device, b.scene, settings, {{0, samples}});
        for (std::size_t p = 0; p < film.pixels(); ++p) sum += pixel_mean(film, p)[1];
    }
    check.near(sum / (seeds * 64) / expected, 1, 0.003 * std::sqrt(64.0 / samples),
               "radiance over the closed form");
}

}  // namespace

void add_photons(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"P1", "photon grid finds what a search of all finds", quick, grid_finds_all},
                     {"P2", "photons land as energy says", standard, what_is_emitted_lands},
                 });
}

void add_photon_pictures(std::vector<CheckCase>& cases) {
    cases.push_back({"P3", "a light and its images in mirrors", CheckLevel::standard, light_and_its_images});
}

}  // namespace triad
