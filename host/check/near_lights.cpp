// Triangle lights by solid angle: the angle itself, and where in it samples lie.
#include <random>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"

namespace triad {
namespace {

using Corners = std::array<dvec3, 3>;
using Four = std::array<float, 4>;

/// From the origin (Van Oosterom and Strackee 1983, eq. 8); the product of edges keeps small ones exact.
double solid_angle(const Corners& t) {
    const double a = glm::length(t[0]), b = glm::length(t[1]), c = glm::length(t[2]);
    const double volume = std::abs(glm::dot(t[0], glm::cross(t[1] - t[0], t[2] - t[0])));
    return 2 * std::atan2(volume, a * b * c + glm::dot(t[0], t[1]) * c + glm::dot(t[1], t[2]) * a +
                                      glm::dot(t[2], t[0]) * b);
}

dvec3 vector_of(const float v[3]) { return {v[0], v[1], v[2]}; }

dev::Light light_of(const Corners& t) {
    dev::Light l{};
    l.type = LIGHT_TRIANGLE;
    to_floats(l.position, t[0]), to_floats(l.edge1, t[1] - t[0]), to_floats(l.edge2, t[2] - t[0]);
    const dvec3 cross = glm::cross(vector_of(l.edge1), vector_of(l.edge2));
    to_floats(l.axis, glm::normalize(cross));
    l.area = float(glm::length(cross) / 2);
    return l;
}

/// As the light's floats say it.
Corners corners_of(const dev::Light& l) {
    const dvec3 a = vector_of(l.position);
    return {a, a + vector_of(l.edge1), a + vector_of(l.edge2)};
}

const char* const near_light_source = R"(#include "common/random.h"
#include "shading/near_light.h"
__kernel void measure(__global float* out, __global const Light* lights, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Light l = lights[i];
    out[i] = near_light_angle(VEC3_OF(l.position), VEC3_OF(l.edge1), VEC3_OF(l.edge2), VEC3_OF(l.axis),
                              l.area);
}
/* Weights of corners 1 and 2, sine of the angle between the direction and that point, solid angle. */
__kernel void draw(__global Vec4* out, __global const Light* lights, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Light l = lights[0];
    const Vec3 a = VEC3_OF(l.position), e1 = VEC3_OF(l.edge1), e2 = VEC3_OF(l.edge2), n = VEC3_OF(l.axis);
    const Sampler s = sampler_make(3u, i, 0u, 0u, 12u);
    const Vec2 u = random_point(sampler_2d_bits(&s, SAMPLER_SOBOL_SETS));
    Vec2 b;
    const float angle = near_light_point(a, e1, e2, n, l.area, u, &b);
    const SphericalTriangle t = spherical_triangle(a, vec3_add(a, e1), vec3_add(a, e2), n, l.area);
    const Vec3 d = spherical_triangle_sample(&t, u);
    const Vec3 to = vec3_add_scaled(vec3_add_scaled(a, e1, b.x), e2, b.y);
    out[i] = vec4_make(b.x, b.y, vec3_length(vec3_cross(vec3_normalize(to), d)), angle);
}
)";

std::vector<float> angles_of(Check& check, const std::vector<dev::Light>& lights) {
    return run_kernel<float>(check.device, near_light_source, "measure",
                             Arguments().add(check.device.upload(lights)), lights.size());
}

void solid_angles(Check& check) {
    std::mt19937 bits(14);
    const auto even = [&] { return std::uniform_real_distribution<double>(-1, 1)(bits); };
    const std::size_t count = check.count(4096);
    for (const double size : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        std::vector<dev::Light> lights;
        while (lights.size() < count) {
            const dvec3 at = glm::normalize(dvec3(even(), even(), 2 + even()));
            const auto corner = [&] { return at + 0.5 * size * dvec3(even(), even(), even()); };
            const Corners t{corner(), corner(), corner()};
            const dvec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
            // Neither slivers nor seen from their edge: what a float holds of their corners decides those.
            if (glm::length(cross) > 0.02 * size * size &&
                std::abs(glm::dot(glm::normalize(cross), t[0])) > 0.1)
                lights.push_back(light_of(t));
        }
        const std::vector<float> found = angles_of(check, lights);
        double worst = 0;
        for (std::size_t i = 0; i < count; ++i)
            worst = std::max(worst, std::abs(found[i] / solid_angle(corners_of(lights[i])) - 1));
        check.at_most(worst, 1e-5, "relative error of solid angles, edges of ", size);
    }
    // An eighth of the sphere; and from where less is left of the half than directions can tell: by area.
    const auto near = [&](double height) {
        return light_of({dvec3(-2, -1, height), dvec3(2, -1, height), dvec3(0, 3, height)});
    };
    const std::vector<float> found =
        angles_of(check, {light_of({dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}), near(0.1), near(1e-4)});
    check.near(found[0], pi / 2, 1e-6, "solid angle of an octant");
    check.near(found[1], solid_angle(corners_of(near(0.1))), 1e-5, "solid angle close to the light");
    check.equal(found[2], 0.0, "solid angle on the light");
}

void points_in_solid_angle(Check& check) {
    struct Shape {
        const char* name;
        Corners corners;
    };
    for (const Shape& c :
         {Shape{"turned away", {dvec3(1, 0.2, 0.3), dvec3(-0.4, 1.5, 0.1), dvec3(0.2, -0.8, 2)}},
          {"far", {dvec3(0, 0, 20), dvec3(1, 0, 20), dvec3(0, 1, 21)}},
          {"close", {dvec3(-2, -1, 0.2), dvec3(2, -1, 0.2), dvec3(0, 3, 0.2)}},
          {"strip", {dvec3(-4, 0.5, 1), dvec3(4, 0.5, 1), dvec3(4, 0.55, 1)}}}) {
        const dev::Light light = light_of(c.corners);
        const std::size_t count = check.count(1 << 18);
        const auto drawn = run_kernel<Four>(check.device, near_light_source, "draw",
                                            Arguments().add(check.device.upload(std::vector{light})), count);
        // Cells of the flat triangle: squares of weights, cut in two along their diagonal.
        const int edge = std::min(8, grid_edge(count, 8));
        const Corners t = corners_of(light);
        const auto at = [&](double x, double y) {
            return t[0] + (x * (t[1] - t[0]) + y * (t[2] - t[0])) / double(edge);
        };
        std::vector<double> counts(2 * std::size_t(edge) * edge), expected(counts.size());
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x + y < edge; ++x) {
                const std::size_t cell = 2 * (std::size_t(y) * edge + x);
                expected[cell] = solid_angle({at(x, y), at(x + 1, y), at(x, y + 1)});
                if (x + y + 1 < edge)
                    expected[cell + 1] = solid_angle({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
            }
        for (double& e : expected) e *= double(count) / solid_angle(t);
        double apart = 0;
        for (const Four& d : drawn) {
            check.holds(d[0] >= 0 && d[1] >= 0 && d[0] + d[1] <= 1.000001f, "weights of corners, ", c.name);
            if (!(d[0] >= 0 && d[1] >= 0)) continue;
            const int x = std::min(int(d[0] * float(edge)), edge - 1),
                      y = std::min(int(d[1] * float(edge)), edge - 1 - x);
            const bool upper = d[0] * float(edge) - float(x) + d[1] * float(edge) - float(y) > 1;
            counts[2 * (std::size_t(y) * edge + x) + (upper && x + y + 1 < edge)] += 1;
            apart = std::max(apart, double(d[2]));
        }
        check.at_most(chi_square_z(counts, expected), chi_square_limit, "chi-square, ", c.name);
        check.also_at_most(apart, 2e-5, "angle between a direction and its point");
    }
}

}  // namespace

void add_near_lights(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C14", "solid angles of triangles", quick, solid_angles},
                     {"C14b", "points of a light, evenly in its solid angle", quick, points_in_solid_angle},
                 });
}

}  // namespace triad
