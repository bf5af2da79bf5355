// The photon map: the hash grid against all photons looked at one by one, and what lands of what is emitted.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analytic/analytic_scene.h"
#include "render/features.h"
#include "render/photon_map.h"

namespace triad {
namespace {

const char* const source = R"(#include "common/language.h"
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
    q.position = vload3(i, points);
    q.normal = (float3)(0.0f, 0.0f, 1.0f);
    q.most_edges = 0u;
    q.which = PHOTON_ANY;
    q.radius = map->radius;
    q.wavelength = 0.0f;
    VertexBsdf v;
    v.frame = frame_make(q.normal);
    v.wo = q.normal;
    v.bsdf.diffuse = (float3)(1.0f);
    vstore3(photon_gather(&scene, &q, &v), i, from_grid);
    long sums[3] = {0, 0, 0};
    const PhotonMap m = *map;
    for (uint k = 0u; k < count; ++k) photon_add(&scene, &m, &q, &v, landed + k, sums);
    for (uint c = 0u; c < 3u; ++c) from_all[3 * i + c] = convert_float(sums[c]) * (1.0f / frame->quanta);
}
/* Photons as a path would leave them. */
kernel void land(global const float* places, uint count, global Photon* landed) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 from = math_normalize((float3)(0.3f, -0.2f, 1.0f));
    landed[i] = photon_make(vload3(i, places), (float3)(1.0f, 0.5f, 0.25f), from, (float3)(0.0f, 0.0f, 1.0f), 3u,
                            1, 0.0f);
    if (i % 7u == 0u) landed[i].direction = 0u; /* landed nowhere */
}
)";

/// Photons in clusters on planes around the origin and far from it, and points among them.
void expect_grid_finds_all(double extent, double radius, unsigned seed) {
    const std::uint32_t photons = 20000, points = 400;
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
    Device& device = test_device();
    const Options plain = {{"TRIAD_SPECULAR", "0"}, {"TRIAD_TRANSMISSION", "0"}, {"TRIAD_DISPERSION", "0"}};
    const Program program = device.build_source("photon_map_test", source, plain);
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
    std::size_t lit = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) lit += all[i] > 0;
    EXPECT_EQ(grid, all) << "extent " << extent << ", radius " << radius;
    EXPECT_GT(lit, points / 2) << "too few points find photons";
}

TEST(PhotonMap, the_grid_finds_exactly_the_photons_that_a_search_of_all_finds) {
    expect_grid_finds_all(1, 0.02, 1);
    expect_grid_finds_all(1, 0.6, 2);  // few cells, many photons in each
    expect_grid_finds_all(1000, 4, 3);
    expect_grid_finds_all(1e-3, 2e-5, 4);
}

/// Traces photons through a scene without a camera's help, and returns those that landed.
std::vector<dev::Photon> landed_in(Scene scene, std::uint64_t photons) {
    validate(scene);
    RenderSettings settings;
    settings.width = settings.height = 8;
    settings.integrator = Integrator::photon_map;
    settings.photons = photons;
    settings.view = look_at({0, 0, 0}, {0, 0, 1}, 1.0, 1.0);
    const PackedScene packed = pack(scene, settings);
    const dev::Frame frame = frame_of(packed, settings);
    Device& device = test_device();
    PhotonMap map(device, photons);
    const DeviceScene on_device = upload(device, packed, settings, map.buffers());
    const Kernel trace = device.build("photon/photon.cl", options_of(features_of(scene, settings, packed)))
                             .kernel("trace_photons");
    const Buffer counters = device.allocate(2 * COUNTERS * sizeof(std::uint32_t));
    device.fill_zero(counters);
    device.run(
        trace,
        Arguments()
            .add(on_device.arguments)
            .add(Buffer{})
            .add(Buffer{})
            .add(counters)
            .add(device.upload(std::vector<dev::PhotonFrame>{photon_frame_of(packed, settings, frame)}))
            .add(device.upload(packed.photon_lights))
            .add(Buffer{})
            .add(0u)
            .add(0u)
            .add(0u)
            .add(std::uint32_t(photons))
            .add(1.0f / float(photons))
            .add(map.landed())
            .add(Buffer{})
            .add(0u)
            .add(0u),
        photons);
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
void expect_landed(const Scene& scene, bool first_alone, double expected) {
    const std::uint64_t n = 60000;
    double sum = 0, squares = 0;
    for (const dev::Photon& p : landed_in(scene, n)) {
        const unsigned edges = p.direction & 127;
        if (edges == 0 || (first_alone && edges > 1)) continue;
        const double cosine = std::abs(glm::dot(unpacked(p.direction >> 8, 12), unpacked(p.normal >> 16, 8)));
        const double flux = double(p.power[1]) * double(n) * cosine;
        sum += flux, squares += flux * flux;
    }
    const double mean = sum / double(n), sigma = std::sqrt((squares / double(n) - mean * mean) / double(n));
    EXPECT_NEAR(mean, expected, 4 * sigma + 1e-3 * expected);  // directions are kept to .1 degrees
    EXPECT_LT(sigma, 0.01 * expected);
}

/// A closed diffuse box around the origin.
analytic::Builder room() {
    analytic::Builder b;
    Material wall = analytic::lambert(0.6f);
    wall.double_sided = true;
    b.add(shapes::box({-1, -1, -1}, {1, 1, 1}), wall);
    return b;
}

TEST(PhotonMap, all_that_is_emitted_in_a_closed_box_lands_as_often_as_its_albedo_says) {
    analytic::Builder b = room();
    PunctualLight light;
    light.position = {0.2, 0.1, -0.3};
    light.colour = vec3(2.0f);
    b.scene.lights.push_back(light);
    expect_landed(b.scene, true, 4 * pi * 2);
    expect_landed(b.scene, false, 4 * pi * 2 / (1 - 0.6));
}

TEST(PhotonMap, a_lamp_emits_what_its_radiance_and_area_say) {
    analytic::Builder b = room();
    b.add(shapes::quad({-0.3f, 0.5f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}), analytic::emitter(3.0f));
    expect_landed(b.scene, true, pi * 3 * 0.36);
}

}  // namespace
}  // namespace triad
