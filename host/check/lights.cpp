// Light sampling: the environment's directions, which light is picked, and what a sample weighs.
#include "check/any_bits.h"
#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/pack.h"

namespace triad {
namespace {

using namespace picture_case;

const char* const lights_source = R"(#include "common/random.h"
#include "shading/light.h"
/* Samples seen from the origin: (direction, 1 / pdf), (pdf of that direction, weight, map coordinates). */
__kernel void draw(__global Vec4* out, SCENE_PARAMETERS, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Sampler s = sampler_make(3u, i, 0u, 0u, 11u);
    LightSample l;
    l.uv = vec2_splat(0.0f);
    const Receiver receiver = {vec3_splat(0.0f), vec3_splat(0.0f)};
    const int lit = light_sample(&scene, receiver, sampler_2d_bits(&s, SAMPLER_SOBOL_SETS + 1u), &l) &&
                    light_complete(&scene, &l);
    float pdf = 0.0f;
    if (lit && l.distant) environment_radiance(&scene, l.direction, receiver.facing, &pdf);
    out[2 * i] = lit ? vec3_with(l.direction, l.inverse_pdf) : vec4_splat(0.0f);
    out[2 * i + 1] = lit ? vec4_make(pdf, l.weight.y, l.uv.x, l.uv.y) : vec4_splat(0.0f);
}
/* Irradiance of a surface (its place, its normal) by one sample: of the map, of the other lights. */
__kernel void irradiance(__global Vec2* out, SCENE_PARAMETERS, __global const float* surface, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Sampler s = sampler_make(5u, i, 0u, 0u, 12u);
    const Vec3 n = vec3_load(surface, 1u);
    const Receiver receiver = {vec3_load(surface, 0u), n, facing_of(n)};
    LightSample l;
    const int lit = light_sample(&scene, receiver, sampler_2d_bits(&s, 0u), &l) && light_complete(&scene, &l);
    const float from = lit ? l.weight.y * math_max(vec3_dot(n, l.direction), 0.0f) : 0.0f;
    out[i] = lit && l.distant ? vec2_make(from, 0.0f) : vec2_make(0.0f, from);
}
/* The map's radiance from a direction. */
__kernel void look(__global Vec4* out, SCENE_PARAMETERS, __global const float* directions, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    float pdf;
    const Vec3 radiance = environment_radiance(&scene, vec3_load(directions, i), 0u, &pdf);
    out[i] = vec3_with(radiance, pdf);
}
)";

using Four = std::array<float, 4>;

/// A scene on the device as the renderer packs it, seen from above.
struct OnDevice {
    PackedScene packed;
    Arguments arguments;
};
OnDevice on_device(Device& device, Scene scene) {
    validate(scene);
    RenderSettings settings;
    settings.view = look_at({0, 0, 0}, {0, -1, 0}, 1.0, 1.0);
    OnDevice result{pack(scene, settings), {}};
    result.arguments = scene_arguments(device, result.packed, settings);
    return result;
}

void environment_samples(Check& check) {
    // Bright and dim patches, a sun in one texel, and black rows that must never be drawn.
    const unsigned w = 32, h = 16;
    EnvironmentMap map{w, h, std::vector<float>(w * h * 3)};
    const auto texel = [&](unsigned x, unsigned y) -> float {
        if (y >= 4 && y < 8) return 0.0f;
        return x == 20 && y == 9 ? 1e3f : 1.0f + float((x * 7 + y * 3) % 11);
    };
    for (unsigned i = 0; i < w * h; ++i)
        for (int c = 0; c < 3; ++c) map.rgb[i * 3 + c] = texel(i % w, i / w);
    Builder b;
    b.add(square(-1, true), lambert(0.5f)).scene.environment = map;
    const OnDevice world = on_device(check.device, b.scene);

    const std::size_t count = check.count(1 << 18, 1024);
    const auto samples = run_kernel<Four>(check.device, lights_source, "draw", world.arguments, count, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const Four &a = samples[2 * i], &s = samples[2 * i + 1];
        const dvec3 d(a[0], a[1], a[2]);
        check.also_at_most(std::abs(glm::length(d) - 1), 2e-6, "length of a direction");
        const double u = 0.5 + std::atan2(d.z, d.x) / (2 * pi),
                     v = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi;
        check.holds(v * h < 5.01 || v * h > 6.99, "a direction to a black row");
        check.holds(std::isfinite(s[1]) && s[1] >= 0, "weight of a sample");
        // Beside the border of a texel either density is right.
        const double x = u * w - std::floor(u * w), y = v * h - std::floor(v * h);
        if (std::min({x, y, 1 - x, 1 - y}) > 1e-3)
            check.near(double(s[0]) * a[3], 1, 1e-5, "pdf against its inverse");
    }
}

/// Irradiance of a surface that faces n by the map, its radiance asked for at many directions.
double irradiance_by_map(Check& check, const OnDevice& world, dvec3 n) {
    const std::size_t down = check.level == CheckLevel::tiny ? 32 : 256, across = 2 * down;
    std::vector<float> directions;
    std::vector<double> weights;
    for (std::size_t i = 0; i < across * down; ++i) {
        const double phi = 2 * pi * (double(i % across) + 0.5) / double(across),
                     theta = pi * (double(i / across) + 0.5) / double(down);
        const dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        for (const double x : {d.x, d.y, d.z}) directions.push_back(float(x));
        weights.push_back(std::max(glm::dot(n, d), 0.0) * std::sin(theta) * 2 * pi * pi /
                          double(across * down));
    }
    const auto seen = run_kernel<Four>(check.device, lights_source, "look",
                                       Arguments().add(world.arguments).add(check.device.upload(directions)),
                                       weights.size());
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) sum += seen[i][1] * weights[i];
    return sum;
}

void a_map_beside_lamps(Check& check) {
    // The number that picks among map and lamps goes on to say where in the map: the map's share of it must
    // reach all of the map. Few lamps are picked by their power, many by a tree.
    const unsigned w = 32, h = 16;
    EnvironmentMap map{w, h, std::vector<float>(w * h * 3)};
    for (unsigned i = 0; i < w * h; ++i)
        for (int c = 0; c < 3; ++c)
            map.rgb[i * 3 + c] = 30 * (0.5f + float(i % w * 7 % 11) + float(i % w) / 4);
    const dvec3 n = glm::normalize(dvec3(0.3, 0.8, -0.5));
    for (const int lamps : {3, 40}) {
        Builder b;
        b.add(square(-1, true), lambert(0.5f)).scene.environment = map;
        double by_lamps = 0;
        for (int i = 0; i < lamps; ++i) {
            const dvec3 to(std::cos(i * 2.4), 1.0 + i % 3, std::sin(i * 2.4));
            const double power = 60.0 / lamps * (1 + i % 4), distance = glm::length(to);
            PunctualLight lamp{.type = PunctualLight::Type::point, .colour = vec3(float(power))};
            lamp.position = to;
            b.scene.lights.push_back(lamp);
            by_lamps += power * std::max(glm::dot(n, to), 0.0) / (distance * distance * distance);
        }
        const OnDevice world = on_device(check.device, b.scene);
        const double by_map = irradiance_by_map(check, world, n);
        std::vector<float> surface;
        for (const dvec3& v : {-world.packed.origin, n})
            for (const double x : {v.x, v.y, v.z}) surface.push_back(float(x));
        const std::size_t count = check.count(1 << 18, 1 << 12);
        const auto drawn = run_kernel<std::array<float, 2>>(
            check.device, lights_source, "irradiance",
            Arguments().add(world.arguments).add(check.device.upload(surface)), count);
        for (const bool lamp : {false, true}) {
            double sum = 0, square = 0;
            for (const auto& d : drawn) sum += d[lamp], square += double(d[lamp]) * d[lamp];
            const double mean = sum / double(count), truth = lamp ? by_lamps : by_map;
            const double deviation = std::sqrt((square / double(count) - mean * mean) / double(count));
            check.near(mean / truth, 1,
                       5 * deviation / truth + (check.level == CheckLevel::tiny ? 0.02 : 1e-3),
                       "irradiance by ", lamp ? "lamps" : "the map", ", lamps: ", lamps);
        }
    }
}

void any_direction(Check& check) {
    const unsigned w = 8, h = 4;
    Builder b;
    b.add(square(-1, true), lambert(0.5f)).scene.environment =
        EnvironmentMap{w, h, std::vector<float>(w * h * 3, 2.0f)};
    const OnDevice world = on_device(check.device, b.scene);
    const std::size_t count = check.count(1 << 18, 1024);
    any_bits::Words words(16);
    std::vector<float> directions(count * 3);
    for (float& d : directions) d = words.number();
    const auto seen =
        run_kernel<Four>(check.device, lights_source, "look",
                         Arguments().add(world.arguments).add(check.device.upload(directions)), count);
    std::size_t wrong = 0, numbers = 0;
    for (const Four& s : seen) numbers += s[0] == s[0], wrong += s[0] == s[0] && s[0] != 2.0f;
    check.at_most(double(wrong), 0, "radiances that are not in the map, of ", numbers);
    check.above(double(numbers), double(count) / 4, "radiances");
}

void tiny_far_light(Check& check) {
    // C15: a square of area 1e-12 at a distance of 1e6 gives E = L A / d^2 = 1e-24, from any of its samples.
    Builder b;
    b.add(shapes::quad({-5e-7f, 1e6f, -5e-7f}, {1e-6f, 0, 0}, {0, 0, 1e-6f}), emitter(1.0f));
    b.add(square(-1, true), lambert(1.0f));
    const OnDevice world = on_device(check.device, b.scene);
    const std::size_t count = check.count(4096);
    double mean = 0;
    for (std::size_t i = 0;
         const Four& s : run_kernel<Four>(check.device, lights_source, "draw", world.arguments, count, 2))
        if (i++ % 2) mean += s[1] / double(count);
    check.near(mean * 1e24, 1, 1e-4, "irradiance over 1e-24");
}

void heuristics_at_their_ends(Check& check) {
    const char* const text = R"(#include "shading/light.h"
__kernel void weigh(__global float* out, __global const float* ratio, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[2u * i] = power_heuristic(ratio[i]), out[2u * i + 1u] = map_heuristic(ratio[i]);
}
)";
    using Weights = std::array<float, 2>;  // of lights, of maps
    const std::vector<float> ratios{0.0f, 1.0f, 3.0f, 1e24f, 3e38f, INFINITY, 1e-30f};
    const std::vector<Weights> expected{{1.0f, 1.0f}, {0.5f, 0.5f}, {0.1f, 0.1613905f}, {0.0f, 0.0f},
                                        {0.0f, 0.0f}, {0.0f, 0.0f}, {1.0f, 1.0f}};
    const auto w = run_kernel<Weights>(check.device, text, "weigh",
                                       Arguments().add(check.device.upload(ratios)), ratios.size());
    for (std::size_t i = 0; i < w.size(); ++i)
        for (const int map : {0, 1})
            check.near(w[i][map], expected[i][map], 1e-7, map ? "map" : "light", " at ratio ", ratios[i]);
}

}  // namespace

void add_lights(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C15", "tiny far light", quick, tiny_far_light},
                     {"C15b", "weights of two samplings at their ends", quick, heuristics_at_their_ends},
                     {"C16e", "samples of the environment and their density", quick, environment_samples},
                     {"C16h", "a map beside lamps", quick, a_map_beside_lamps},
                     {"C16f", "the environment from any bits", quick, any_direction},
                 });
}

}  // namespace triad
