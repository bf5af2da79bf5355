// Wavelengths: the filter's mean, indices of refraction, and the angles of prism, ball lens and rainbow,
// through the functions that paths use.
#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/albedo_tables.h"
#include "pack/pack.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

using namespace picture_case;

const char* const spectral_source = R"(#include "common/frame.h"
#include "common/spectrum.h"
#include "shading/bsdf.h"
/* (filter, wavelength) of evenly spread numbers. */
__kernel void draw(__global Vec4* out, __global const Spectrum* spectrum, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Vec3 filter;
    const float nanometres = spectrum_sample(spectrum, (convert_float(i) + 0.5f) / convert_float(count), &filter);
    out[i] = vec3_with(filter, nanometres);
}
__kernel void look_up(__global float* out, __global const float* indices, __global const float* nanometres, uint glasses, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    out[i] = spectrum_index(indices, i % glasses, nanometres[i]);
}
/* The direction after a surface of clear smooth glass, normal on the side that the ray comes from. */
TRIAD_FUNCTION Vec3 cross_glass(Vec3 direction, Vec3 normal, float eta, int reflect, __global const float* tables) {
    BsdfInput in = bsdf_input_plain(vec3_splat(1.0f));
    in.roughness = 0.0f, in.transmission = 1.0f, in.solid = 1u;
    in.inside = eta < 1.0f;
    in.ior = eta < 1.0f ? 1.0f / eta : eta;
    const ShadingFrame frame = frame_make(normal);
    const Vec3 wo = frame_to_local(&frame, vec3_negate(direction));
    const Bsdf b = bsdf_make(&in, wo, tables);
    const BsdfSample s = bsdf_sample(&b, wo, reflect ? 0.0f : 0x1.fffffep-1f, vec2_splat(0.5f));
    return s.event == BSDF_NONE ? vec3_splat(NAN) : frame_to_world(&frame, s.wi);
}
/* A ray (direction, nanometres) through two planes with these outward normals, into glass 0 and out. */
__kernel void cross_prism(__global Vec4* out, __global const Vec4* rays, __global const Vec4* normals, __global const float* indices,
                          __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float n = spectrum_index(indices, 0u, rays[i].w);
    const Vec3 within = cross_glass(vec4_xyz(rays[i]), vec4_xyz(normals[0]), n, 0, tables);
    out[i] = vec3_with(cross_glass(within, vec3_negate(vec4_xyz(normals[1])), 1.0f / n, 0, tables), n);
}
/* The far side of the unit sphere from p. */
TRIAD_FUNCTION Vec3 across_sphere(Vec3 p, Vec3 d) { return vec3_normalize(vec3_add_scaled(p, d, -2.0f * vec3_dot(p, d))); }
/* A ray along +x at height h (y) that crosses the unit sphere, after `reflections` within: direction, point of exit. */
__kernel void cross_sphere(__global Vec4* out, __global const Vec2* rays, uint reflections, __global const float* indices,
                           __global const float* tables, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float h = rays[i].x, n = spectrum_index(indices, 0u, rays[i].y);
    Vec3 p = vec3_make(-sqrt((1.0f - h) * (1.0f + h)), h, 0.0f);
    Vec3 d = cross_glass(vec3_make(1.0f, 0.0f, 0.0f), p, n, 0, tables);
    p = across_sphere(p, d);
    for (uint k = 0; k < reflections; ++k) {
        d = cross_glass(d, vec3_negate(p), 1.0f / n, 1, tables);
        p = across_sphere(p, d);
    }
    out[2 * i] = vec3_with(cross_glass(d, vec3_negate(p), 1.0f / n, 0, tables), 0.0f);
    out[2 * i + 1] = vec3_with(p, 0.0f);
}
)";

using Four = std::array<float, 4>;
using Two = std::array<float, 2>;

constexpr double degree = pi / 180;

/// What pack_spectrum makes of materials of these glasses.
PackedSurfaces packed_glasses(const std::vector<Dispersion>& glasses,
                              Spectral spectral = Spectral::automatic) {
    Scene scene;
    for (const Dispersion& d : glasses) scene.materials.push_back({.dispersion = d});
    PackedSurfaces packed;
    packed.materials.resize(scene.materials.size());
    RenderSettings settings;
    settings.spectral = spectral;
    pack_spectrum(scene, settings, packed);
    return packed;
}

void filter_has_mean_one(Check& check) {
    for (const Spectral spectral : {Spectral::automatic, Spectral::classic}) {
        const PackedSurfaces packed = packed_glasses({*find_glass("F2")}, spectral);
        const std::size_t count = std::size_t(1) << 18;
        const auto drawn = run_kernel<Four>(check.device, spectral_source, "draw",
                                            Arguments().add(check.device.upload(packed.spectrum)), count);
        dvec3 sum(0.0), squares(0.0);
        float last = 0;
        for (const Four& f : drawn) {
            const dvec3 filter(f[0], f[1], f[2]);
            sum += filter, squares += filter * filter;
            check.holds(f[3] >= last && f[3] >= 380 && f[3] <= 780, "wavelength ", f[3], " after ", last);
            last = f[3];
        }
        for (int c = 0; c < 3; ++c)
            check.near(sum[c] / double(count), 1, 1e-5, "mean of channel ", c, " of filter ", int(spectral));
        // What a single wavelength costs in noise (docs/spectral.md): the mean square over the channels.
        const double moment = (squares.x + squares.y + squares.z) / (3.0 * double(count));
        check.holds(moment < (spectral == Spectral::classic ? 2.8 : 4.25), "mean square ", moment);
    }
}

void indices_are_the_formulas(Check& check) {
    std::vector<Dispersion> glasses;
    for (const Glass& g : glass_catalogue()) glasses.push_back(g.dispersion);
    const PackedSurfaces packed = packed_glasses(glasses);
    std::vector<float> wavelengths;
    for (std::size_t i = 0; i < check.count(1 << 16, 4096); ++i)
        wavelengths.push_back(static_cast<float>(380 + 400 * std::fmod(0.6180339887 * double(i), 1.0)));
    const auto found = run_kernel<float>(check.device, spectral_source, "look_up",
                                         Arguments()
                                             .add(check.device.upload(packed.indices))
                                             .add(check.device.upload(wavelengths))
                                             .add(std::uint32_t(glasses.size())),
                                         wavelengths.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::size_t glass = i % glasses.size();
        check.near(found[i], glasses[glass].index(wavelengths[i]), 4e-7, "index of ",
                   glass_catalogue()[glass].name, " at ", wavelengths[i], " nm");
    }
}

double angle_between(const dvec3& a, const dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

void prism_minimum_deviation(Check& check) {
    // D = 2 asin(n / 2) - 60 degrees, of an equilateral prism; to either side of that incidence it is larger.
    const struct {
        const char* glass;
        double deviation[3];  // at F, d, C
    } prisms[] = {{"SF10", {61.6748, 59.5659, 58.7284}},
                  {"N-BK7", {39.1381, 38.6467, 38.4291}},
                  {"cubo", {45.8041, 40.6930, 38.6903}}};
    const double lines[] = {line_F, line_d, line_C};
    const Buffer tables = check.device.upload(albedo_tables());
    const std::vector<Four> normals = {{-std::sqrt(0.75f), 0.5f, 0, 0}, {std::sqrt(0.75f), 0.5f, 0, 0}};
    for (const auto& prism : prisms) {
        const Dispersion glass = *find_glass(prism.glass);
        std::vector<Four> rays;
        std::vector<dvec3> directions;
        for (const double line : lines)
            for (const double aside : {0.0, -1.0, 1.0}) {
                // the direction at incidence i meets n0 from below the normal
                const double i = std::asin(glass.index(line) / 2) + aside * degree, turn = i - 30 * degree;
                const vec3 d(std::cos(turn), std::sin(turn), 0);
                directions.push_back(glm::normalize(dvec3(d)));
                rays.push_back({d.x, d.y, d.z, static_cast<float>(line)});
            }
        const PackedSurfaces packed = packed_glasses({glass});
        const auto out = run_kernel<Four>(check.device, spectral_source, "cross_prism",
                                          Arguments()
                                              .add(check.device.upload(rays))
                                              .add(check.device.upload(normals))
                                              .add(check.device.upload(packed.indices))
                                              .add(tables),
                                          rays.size());
        const auto deviation = [&](std::size_t i) {
            return angle_between(directions[i], dvec3(out[i][0], out[i][1], out[i][2]));
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const double least = deviation(3 * k);
            const double exact = 2 * std::asin(glass.index(lines[k]) / 2) / degree - 60;
            check.near(least, exact, 1e-4, "deviation by ", prism.glass, " at ", lines[k], " nm");
            check.near(least, prism.deviation[k], 1e-4, "published deviation by ", prism.glass, " at ",
                       lines[k], " nm");
            check.above(deviation(3 * k + 1), least + 0.005, "deviation before the minimum");
            check.above(deviation(3 * k + 2), least + 0.005, "deviation beyond the minimum");
        }
    }
}

/// Direction and point of exit from the unit sphere of rays (height, wavelength) along +x.
std::vector<Four> through_sphere(Check& check, const char* glass, const std::vector<Two>& rays,
                                 std::uint32_t reflections) {
    const PackedSurfaces packed = packed_glasses({*find_glass(glass)});
    return run_kernel<Four>(check.device, spectral_source, "cross_sphere",
                            Arguments()
                                .add(check.device.upload(rays))
                                .add(reflections)
                                .add(check.device.upload(packed.indices))
                                .add(check.device.upload(albedo_tables())),
                            rays.size(), 2);
}

void ball_lens_focus(Check& check) {
    // Where rays of height h cross the axis: sin i / sin(2 (i - r)), sin i = h, sin r = h / n; n / (2 (n -
    // 1)) near the axis.
    const std::vector<Two> rays = {
        {0.01f, 587.56f}, {0.1f, 587.56f}, {0.3f, 587.56f}, {0.5f, 587.56f}, {0.7f, 587.56f}};
    const struct {
        const char* glass;
        double focus[5];
    } balls[] = {{"N-BK7", {1.46749, 1.46350, 1.43114, 1.36389, 1.25550}}, {"SF10", {1.18658, 0, 0, 0, 0}}};
    for (const auto& ball : balls) {
        const auto out = through_sphere(check, ball.glass, rays, 0);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (ball.focus[i] == 0) continue;
            const Four &d = out[2 * i], &p = out[2 * i + 1];
            check.near(p[0] - double(d[0]) * p[1] / d[1], ball.focus[i], 1e-4, "focus of ", ball.glass,
                       " for height ", rays[i][0]);
        }
    }
}

void rainbow_angles(Check& check) {
    // The angle between sun and bow has its extreme at cos^2 i = (n^2 - 1) / (k (k + 2)) for k reflections.
    const struct {
        double wavelength, primary, secondary;
    } bows[] = {{400, 40.5674, 53.6198},
                {486.13, 41.4294, 52.0612},
                {587.56, 42.0195, 50.9964},
                {656.27, 42.2949, 50.5001}};
    for (const auto& bow : bows) {
        std::vector<Two> rays;
        for (int i = 0; i < 2000; ++i) rays.push_back({0.7f + 0.00015f * float(i), float(bow.wavelength)});
        for (const std::uint32_t reflections : {1u, 2u}) {
            const auto out = through_sphere(check, "water", rays, reflections);
            double extreme = reflections == 1 ? 0 : 180;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const double angle =
                    angle_between(dvec3(-1, 0, 0), dvec3(out[2 * i][0], out[2 * i][1], out[2 * i][2]));
                extreme = reflections == 1 ? std::max(extreme, angle) : std::min(extreme, angle);
            }
            check.near(extreme, reflections == 1 ? bow.primary : bow.secondary, 0.01, "bow ", reflections,
                       " at ", bow.wavelength, " nm");
        }
    }
}

}  // namespace

void add_spectral(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"W1", "filter of wavelengths has mean 1", quick, filter_has_mean_one},
                     {"W2", "indices of refraction over the wavelength", quick, indices_are_the_formulas},
                     {"W3", "prism minimum deviation", quick, prism_minimum_deviation},
                     {"W4", "ball lens", quick, ball_lens_focus},
                     {"W5", "rainbow", quick, rainbow_angles},
                 });
}

}  // namespace triad
