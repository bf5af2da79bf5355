#include "pack/near_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pack/pack.h"

namespace triad {
namespace {

using Corners = std::array<dvec3, 3>;

/// A corner within this many lengths of the longest edge, and points are drawn by solid angle. Farther away
/// the solid angle takes more time than it saves (docs/measurements/2026-11-28-solid-angle.md).
constexpr double reach_in_edges = 1.12;
/// Lights of less of the power matter little, and cost the search for what is near them. No number of equal
/// lights lies at the border, where rounding would decide.
constexpr double least_pick = 1.0 / 32.5;
/// Smaller ones are drawn by area: products of their lengths would underflow.
constexpr float least_area = 1e-30f;
/// Lights are drawn by solid angle where at least this share of all light is reflected diffusely within their
/// reach: in a scene with less, the time for it is lost.
constexpr double least_share = 0.1;
/// As many triangles are asked for all lights together, and of each primitive for one light. Those of a
/// primitive are taken to be alike.
constexpr std::size_t asked_of_all = 1 << 22, asked_of_each = 1 << 16;

dvec3 centre_of(const Corners& t) { return (t[0] + t[1] + t[2]) / 3.0; }

double longest_edge(const Corners& t) {
    return std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
}

struct Emitter {
    dvec3 centre, normal;
    double reach;
    bool both_sides;
};

/// Share of the flux of a small diffuse emitter that a triangle receives within its reach when nothing stands
/// between them: form factors of discs, of pieces that are small beside the reach. The emitter's own plane
/// receives nothing.
double received(const Emitter& light, const Corners& t, int splits = 6) {
    const dvec3 to = centre_of(t) - light.centre;
    const double size = longest_edge(t), distance = glm::length(to);
    if (!(distance - size < light.reach)) return 0;
    if (splits > 0 && size > light.reach / 4) {
        const dvec3 a = (t[0] + t[1]) / 2.0, b = (t[1] + t[2]) / 2.0, c = (t[2] + t[0]) / 2.0;
        double sum = 0;
        for (const Corners& piece : {Corners{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}})
            sum += received(light, piece, splits - 1);
        return sum;
    }
    const dvec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = glm::length(cross) / 2;
    if (!(distance > 1e-3 * size && distance < light.reach && area > 0)) return 0;
    const double front = glm::dot(light.normal, to) / distance;
    const double emitted = light.both_sides ? std::abs(front) / 2 : std::max(front, 0.0);
    const double cosine = std::abs(glm::dot(cross, to)) / (2 * area * distance);
    return emitted * cosine * area / (pi * distance * distance + area);
}

/// A sphere around each mesh, in its own space.
struct Sphere {
    dvec3 centre{0.0};
    double radius = 0;
};
std::vector<Sphere> spheres_of(const Scene& scene) {
    std::vector<Sphere> spheres;
    for (const Mesh& mesh : scene.meshes) {
        Bounds bounds;
        for (const Primitive& p : mesh.primitives)
            for (const vec3& q : p.positions) bounds.add(dvec3(q));
        spheres.push_back(mesh.primitives.empty() ? Sphere{} : Sphere{bounds.centre(), bounds.radius()});
    }
    return spheres;
}

/// Upper bound of what the matrix makes of lengths: its Frobenius norm.
double most_scale(const dmat4& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// What a material reflects diffusely of white light, without its texture.
double diffuse(const Material& m) {
    const vec4& c = m.base_colour;
    return (double(c.x) + c.y + c.z) / 3 * (1 - m.metallic) * (1 - m.transmission);
}

/// Share of the flux that all that is placed reflects diffusely within reach, once. asked: triangles of a
/// primitive, at most.
double reflected(const Emitter& light, const Scene& scene, const std::vector<Sphere>& spheres,
                 std::size_t asked) {
    double sum = 0;
    for (const MeshInstance& i : scene.instances) {
        const Sphere& around = spheres[i.mesh];
        const double distance = glm::length(transform_point(i.to_world, around.centre) - light.centre);
        if (distance > light.reach + around.radius * most_scale(i.to_world)) continue;
        for (const Primitive& p : scene.meshes[i.mesh].primitives) {
            const double albedo = diffuse(scene.materials[p.material]);
            const std::size_t step = (p.triangles.size() + asked - 1) / asked;
            for (std::size_t k = 0; k < p.triangles.size(); k += step) {
                Corners t;
                for (int c = 0; c < 3; ++c)
                    t[c] = transform_point(i.to_world, dvec3(p.positions[p.triangles[k][c]]));
                sum += albedo * double(step) * received(light, t);
            }
        }
    }
    return sum;
}

}  // namespace

void mark_near_lights(const Scene& scene, PackedScene& packed) {
    std::vector<dev::Light*> lights;
    for (dev::Light& l : packed.lights)
        if (l.type == LIGHT_TRIANGLE && l.pick >= least_pick && l.area >= least_area) lights.push_back(&l);
    if (lights.empty()) return;
    const std::vector<Sphere> spheres = spheres_of(scene);
    std::size_t primitives = 0;
    for (const MeshInstance& i : scene.instances) primitives += scene.meshes[i.mesh].primitives.size();
    const std::size_t asked = std::clamp<std::size_t>(
        asked_of_all / (std::max<std::size_t>(primitives, 1) * lights.size()), 1, asked_of_each);
    std::vector<double> reaches;
    double share = 0;
    for (const dev::Light* l : lights) {
        const auto vector = [](const float v[3]) { return dvec3(v[0], v[1], v[2]); };
        const dvec3 corner = packed.origin + vector(l->position);
        const Corners t{corner, corner + vector(l->edge1), corner + vector(l->edge2)};
        const Emitter emitter{centre_of(t), vector(l->axis), reach_in_edges * longest_edge(t),
                              (l->flags & MATERIAL_DOUBLE_SIDED) != 0};
        if (share < least_share) share += l->pick * reflected(emitter, scene, spheres, asked);
        reaches.push_back(emitter.reach);
    }
    if (share >= least_share)
        for (std::size_t i = 0; i < lights.size(); ++i) lights[i]->range = static_cast<float>(reaches[i]);
}

}  // namespace triad
