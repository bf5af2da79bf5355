#include "bench/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace triad {
namespace {

dev::Ray make_ray(const vec3& origin, const vec3& direction, float t_max, std::uint32_t skip) {
    dev::Ray ray{};
    for (int a = 0; a < 3; ++a) ray.origin[a] = origin[a], ray.direction[a] = direction[a];
    ray.t_max = t_max;
    ray.skip_instance = skip == TRIAD_NONE ? TRIAD_NONE : 0;
    ray.skip_primitive = skip;
    return ray;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

class UnitNumbers {
  public:
    float operator()() { return float(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_{1};
};

}  // namespace

std::vector<dev::Ray> primary_rays(const RayScene& scene, unsigned size) {
    const vec3 forward = glm::normalize(scene.target - scene.eye);
    const vec3 right = glm::normalize(glm::cross(forward, vec3(0, 1, 0))), up = glm::cross(right, forward);
    std::vector<dev::Ray> rays;
    for (unsigned i = 0; i < size * size; ++i) {
        const unsigned tile = i / 64, block = i % 64 / 8;
        const unsigned x = tile % (size / 8) * 8 + block % 2 * 4 + i % 4,
                       y = tile / (size / 8) * 8 + block / 2 * 2 + i % 8 / 4;
        const float u = (float(x) + 0.5f) / float(size) * 2 - 1, v = 1 - (float(y) + 0.5f) / float(size) * 2;
        rays.push_back(make_ray(scene.eye, glm::normalize(forward + scene.half_height * (u * right + v * up)),
                                infinity, TRIAD_NONE));
    }
    return rays;
}

std::vector<RayEnd> ends_of(const RayScene& scene, const std::vector<dev::Ray>& rays,
                            const std::vector<dev::Hit>& hits) {
    std::vector<RayEnd> points;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].primitive == TRIAD_NONE) continue;
        const uvec3 t = scene.mesh.triangles[hits[i].primitive];
        const vec3 a = scene.mesh.positions[t.x], b = scene.mesh.positions[t.y],
                   c = scene.mesh.positions[t.z];
        const vec3 d(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
        vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(normal, d) > 0) normal = -normal;
        points.push_back({a + hits[i].u * (b - a) + hits[i].v * (c - a) + 1e-4f * scene.reach * normal,
                          normal, hits[i].primitive});
    }
    return points;
}

std::vector<dev::Ray> diffuse_rays(const std::vector<RayEnd>& points) {
    UnitNumbers random;
    std::vector<dev::Ray> rays;
    for (const RayEnd& p : points) {
        const float phi = 2 * float(pi) * random(), z = 2 * random() - 1,
                    r = std::sqrt(std::max(0.0f, 1 - z * z));
        const vec3 direction = p.normal * 1.0001f + vec3(r * std::cos(phi), r * std::sin(phi), z);
        rays.push_back(make_ray(p.position, glm::normalize(direction), infinity, p.primitive));
    }
    return rays;
}

std::vector<dev::Ray> shadow_rays(const RayScene& scene, const std::vector<RayEnd>& points) {
    UnitNumbers random;
    std::vector<dev::Ray> rays;
    for (const RayEnd& p : points) {
        const float u = random(), v = random();
        const vec3 to_light = scene.light + u * scene.light_u + v * scene.light_v - p.position;
        if (glm::dot(to_light, p.normal) <= 0) continue;
        const float distance = glm::length(to_light);
        rays.push_back(make_ray(p.position, to_light / distance, 0.999f * distance, p.primitive));
    }
    return rays;
}

}  // namespace triad
