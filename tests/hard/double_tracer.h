#pragma once
/// The referee of what is seen: every triangle, in double precision, without a tree.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace triad::hard {

struct DoubleHit {
    double t = std::numeric_limits<double>::infinity();
    double second_t = std::numeric_limits<double>::infinity();  ///< of what would be seen without it
    std::size_t instance = 0, primitive = 0, triangle = 0;
    dvec3 normal{0.0}, corner{0.0};  ///< unit, on the ray's side; a corner, in the world
    double reach = 0;                ///< largest distance of a corner from the eye
    /// How far the ray passes from the nearest edge that could change the answer, as a barycentric weight
    /// times the height over that edge, seen along the ray: a length. Float may decide otherwise below its
    /// rounding.
    double margin = std::numeric_limits<double>::infinity();
    bool found() const { return t < std::numeric_limits<double>::infinity(); }
};

class DoubleTracer {
  public:
    explicit DoubleTracer(const Scene& scene) : scene_(scene) {
        for (const MeshInstance& i : scene.instances) {
            Bounds box;
            for (const Primitive& p : scene.meshes[i.mesh].primitives)
                for (const vec3& v : p.positions) box.add(transform_point(i.to_world, dvec3(v)));
            balls_.push_back({box.centre(), 1.000001 * box.radius()});
        }
    }

    /// The closest hit with t in (t_min, t_max); without `any`, else the first that is found.
    DoubleHit trace(const dvec3& origin, const dvec3& direction, double t_min = 0,
                    double t_max = std::numeric_limits<double>::infinity(), bool any = false) const {
        DoubleHit best;
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            const MeshInstance& instance = scene_.instances[i];
            const dvec3 to = balls_[i].centre - origin;
            const double along = glm::dot(to, direction);
            if (glm::dot(to, to) - along * along / glm::dot(direction, direction) >
                balls_[i].radius * balls_[i].radius)
                continue;
            const dmat4 to_object = glm::inverse(instance.to_world);
            const dvec3 o = transform_point(to_object, origin), d = transform_vector(to_object, direction);
            const Mesh& mesh = scene_.meshes[instance.mesh];
            for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
                for (std::size_t k = 0; k < mesh.primitives[p].triangles.size(); ++k) {
                    visit(mesh.primitives[p], k, o, d, t_min, t_max, best, i, p);
                    if (any && best.found()) return best;
                }
        }
        if (!best.found()) return best;
        const Primitive& p = scene_.meshes[scene_.instances[best.instance].mesh].primitives[best.primitive];
        const uvec3 t = p.triangles[best.triangle];
        const dmat4& m = scene_.instances[best.instance].to_world;
        const dvec3 a = transform_point(m, dvec3(p.positions[t.x])),
                    b = transform_point(m, dvec3(p.positions[t.y])),
                    c = transform_point(m, dvec3(p.positions[t.z]));
        best.normal = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(best.normal, direction) > 0) best.normal = -best.normal;
        best.corner = a;
        best.reach = std::max({glm::length(a - origin), glm::length(b - origin), glm::length(c - origin)});
        return best;
    }

    const Material& material(const DoubleHit& hit) const {
        return scene_
            .materials[scene_.meshes[scene_.instances[hit.instance].mesh].primitives[hit.primitive].material];
    }

  private:
    struct Ball {
        dvec3 centre;
        double radius;
    };

    static void visit(const Primitive& p, std::size_t k, const dvec3& o, const dvec3& d, double t_min,
                      double t_max, DoubleHit& best, std::size_t instance, std::size_t primitive) {
        const uvec3 corners = p.triangles[k];
        const dvec3 a(p.positions[corners.x]), e1 = dvec3(p.positions[corners.y]) - a,
                                               e2 = dvec3(p.positions[corners.z]) - a;
        const dvec3 q = glm::cross(d, e2);
        const double det = glm::dot(e1, q);
        if (det == 0) return;
        const dvec3 s = o - a, r = glm::cross(s, e1);
        const double u = glm::dot(s, q) / det, v = glm::dot(d, r) / det, t = glm::dot(e2, r) / det;
        const double least = std::min({u, v, 1 - u - v});
        if (!(t > t_min && t < t_max) || least < -0.5) return;
        // |det| / |d| is twice the triangle's area as the ray sees it; over the longest edge: the least
        // height.
        const double longest =
            std::sqrt(std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e2 - e1, e2 - e1)}));
        if (t < best.second_t)
            best.margin = std::min(best.margin, std::abs(least) * std::abs(det) / (glm::length(d) * longest));
        if (least < 0) return;
        if (t < best.t) {
            best.second_t = best.t;
            best.t = t, best.instance = instance, best.primitive = primitive, best.triangle = k;
        } else {
            best.second_t = std::min(best.second_t, t);
        }
    }

    const Scene& scene_;
    std::vector<Ball> balls_;
};

}  // namespace triad::hard
