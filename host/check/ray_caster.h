#pragma once
/// Rays against generated geometry on a device, and the same in double precision by brute force.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "bvh/bvh.h"
#include "device/device.h"
#include "kernels/types.h"
#include "scene/shapes.h"
#include "trace/node_format.h"

namespace triad::traversal_case {

/// Meshes as the traversal sees them: mesh 0 is flattened into the world (instance 0), mesh i > 0 may be
/// placed.
struct World {
    struct Placement {
        std::size_t mesh;
        dmat4 to_world;
    };
    std::vector<std::vector<BvhTriangle>> meshes{{}};
    std::vector<Placement> placements;  ///< placements[i] is instance i + 1
    float origin_reach = 0.0f;

    std::uint32_t triangle_count = 0;

    void add(std::size_t mesh, const Primitive& shape, const vec3& offset = vec3(0.0f), float scale = 1.0f) {
        if (meshes.size() <= mesh) meshes.resize(mesh + 1);
        for (const uvec3& t : shape.triangles)
            add(mesh, corner(shape, t.x, offset, scale), corner(shape, t.y, offset, scale),
                corner(shape, t.z, offset, scale));
    }
    void add(std::size_t mesh, const vec3& a, const vec3& b, const vec3& c) {
        if (meshes.size() <= mesh) meshes.resize(mesh + 1);
        meshes[mesh].push_back({{a, b, c}, triangle_count++});
    }

  private:
    static vec3 corner(const Primitive& shape, unsigned i, const vec3& offset, float scale) {
        return shape.positions[i] * scale + offset;
    }
};

inline void set_rows(const dmat4& m, float rows[12]) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) rows[row * 4 + column] = float(m[column][row]);
}

/// Trees on the device.
class RayCaster {
  public:
    RayCaster(Device& device, const BvhPool& pool, std::span<const dev::Instance> instances,
              const BvhRoots& roots, const Options& options = {})
        : device_(device) {
        upload(pool, instances, roots, options);
    }
    RayCaster(Device& device, const World& world, const Options& options = {}) : device_(device) {
        BvhPool pool;
        pool.formats = {format_of(device)};
        std::vector<BvhRoots> roots(world.meshes.size());
        std::vector<Bounds> bounds(world.meshes.size());
        for (std::size_t m = 1; m < world.meshes.size(); ++m) {
            double reach = world.origin_reach;
            for (const auto& p : world.placements)
                if (p.mesh == m) {
                    const dmat4 to_object = glm::inverse(p.to_world);
                    for (int corner = 0; corner < 8; ++corner) {
                        const dvec3 c = double(world.origin_reach) *
                                        dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                        const dvec3 o = glm::abs(transform_point(to_object, c));
                        reach = std::max({reach, o.x, o.y, o.z});
                    }
                }
            roots[m] = build_bvh(world.meshes[m], {}, float(reach), pool);
            for (const BvhTriangle& t : world.meshes[m])
                for (const vec3& c : t.corner) bounds[m].add(dvec3(c));
        }
        std::vector<BvhInstance> boxes;
        std::vector<dev::Instance> instances(world.placements.size() + 1);
        set_rows(dmat4(1.0), instances[0].to_world);
        set_rows(dmat4(1.0), instances[0].to_object);
        for (std::size_t i = 0; i < world.placements.size(); ++i) {
            const auto& [mesh, to_world] = world.placements[i];
            Bounds box;
            for (int corner = 0; corner < 8; ++corner)
                box.add(transform_point(to_world, {corner & 1 ? bounds[mesh].hi.x : bounds[mesh].lo.x,
                                                   corner & 2 ? bounds[mesh].hi.y : bounds[mesh].lo.y,
                                                   corner & 4 ? bounds[mesh].hi.z : bounds[mesh].lo.z}));
            boxes.push_back({box, std::uint32_t(i + 1)});
            set_rows(to_world, instances[i + 1].to_world);
            set_rows(glm::inverse(to_world), instances[i + 1].to_object);
            std::copy(roots[mesh].begin(), roots[mesh].end(), instances[i + 1].root);
        }
        upload(pool, instances, build_bvh(world.meshes[0], boxes, world.origin_reach, pool), options);
    }

    std::vector<dev::Hit> closest(const std::vector<dev::Ray>& rays) const {
        return trace<dev::Hit>("intersect_closest", rays);
    }
    std::vector<std::uint32_t> occluded(const std::vector<dev::Ray>& rays) const {
        return trace<std::uint32_t>("intersect_occluded", rays);
    }
    /// Of bvh8, with TRIAD_PACKETS=1: closest() of neighbours together.
    std::vector<dev::Hit> packets(const std::vector<dev::Ray>& rays) const {
        return trace<dev::Hit>("intersect_packets", rays, PACKET_RAYS);
    }

  private:
    void upload(const BvhPool& pool, std::span<const dev::Instance> instances, const BvhRoots& roots,
                const Options& options) {
        nodes_ = nodes_on(device_, pool);
        blocks_ = device_.upload(pool.blocks);
        instances_ = device_.upload(instances);
        root_ = roots[std::size_t(format_of(device_))];
        program_ = device_.build("traversal/intersect.cl", options);
    }

    template <class Result>
    std::vector<Result> trace(const char* kernel, const std::vector<dev::Ray>& rays,
                              std::size_t rays_of_item = 1) const {
        const Buffer in = device_.upload(rays), out = device_.allocate(rays.size() * sizeof(Result));
        device_.run(program_.kernel(kernel),
                    Arguments()
                        .add(nodes_)
                        .add(blocks_)
                        .add(instances_)
                        .add(root_)
                        .add(in)
                        .add(out)
                        .add(std::uint32_t(rays.size())),
                    (rays.size() + rays_of_item - 1) / rays_of_item);
        device_.finish();
        return device_.download<Result>(out);
    }

    Device& device_;
    Buffer nodes_, blocks_, instances_;
    std::uint32_t root_ = 0;
    Program program_;
};

/// While it lives the device walks nodes of another format.
class WithFormat {
  public:
    WithFormat(Device& device, BvhFormat format) : device_(device), before_(format_of(device)) {
        set_format(device, format);
    }
    ~WithFormat() { set_format(device_, before_); }
    WithFormat(const WithFormat&) = delete;
    WithFormat& operator=(const WithFormat&) = delete;

  private:
    Device& device_;
    const BvhFormat before_;
};

inline dev::Ray ray(const dvec3& origin, const dvec3& direction,
                    float t_max = std::numeric_limits<float>::infinity()) {
    dev::Ray r{};
    for (int a = 0; a < 3; ++a) r.origin[a] = float(origin[a]), r.direction[a] = float(direction[a]);
    r.t_max = t_max;
    r.skip_instance = r.skip_primitive = TRIAD_NONE;
    return r;
}
inline dev::Ray ray_towards(const dvec3& origin, const dvec3& point) {
    const dvec3 o = dvec3(vec3(origin));
    return ray(o, glm::normalize(point - o));
}
inline dvec3 origin_of(const dev::Ray& r) { return {r.origin[0], r.origin[1], r.origin[2]}; }
inline dvec3 direction_of(const dev::Ray& r) { return {r.direction[0], r.direction[1], r.direction[2]}; }

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return double(engine_() >> 11) * 0x1p-53; }
    double between(double lo, double hi) { return lo + (hi - lo) * (*this)(); }
    dvec3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    dvec3 direction() {
        const double z = between(-1, 1), phi = 2 * pi * (*this)(), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    std::size_t below(std::size_t n) { return std::size_t((*this)() * double(n)); }

  private:
    std::mt19937_64 engine_;
};

/// Closest hit in double precision; `margin` is how far, in barycentric weight, the ray passes from the
/// nearest edge that could change the answer, so that a test can leave out rays that float may rightly decide
/// otherwise.
struct Reference {
    double t = std::numeric_limits<double>::infinity();
    double u = 0, v = 0;
    std::uint32_t primitive = TRIAD_NONE, instance = TRIAD_NONE;
    double margin = std::numeric_limits<double>::infinity();
    double second_t = std::numeric_limits<double>::infinity();
};

inline Reference brute_force(const World& world, const dev::Ray& r) {
    Reference best;
    const auto visit = [&](const std::vector<BvhTriangle>& mesh, const dmat4& to_object,
                           std::uint32_t instance) {
        const dvec3 o = transform_point(to_object, origin_of(r)),
                    d = transform_vector(to_object, direction_of(r));
        for (const BvhTriangle& tri : mesh) {
            if (r.skip_instance == instance && r.skip_primitive == tri.primitive) continue;
            const dvec3 a(tri.corner[0]), e1 = dvec3(tri.corner[1]) - a, e2 = dvec3(tri.corner[2]) - a;
            const dvec3 p = glm::cross(d, e2);
            const double det = glm::dot(e1, p);
            if (det == 0) continue;
            const dvec3 s = o - a, q = glm::cross(s, e1);
            const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
            if (!(t > 0 && t <= r.t_max)) continue;
            const double inside = std::min({u, v, 1 - u - v});
            best.margin = std::min(best.margin, std::fabs(inside));
            if (inside < 0) continue;
            if (t < best.t) {
                best.second_t = best.t;
                best.t = t, best.u = u, best.v = v, best.primitive = tri.primitive, best.instance = instance;
            } else {
                best.second_t = std::min(best.second_t, t);
            }
        }
    };
    visit(world.meshes[0], dmat4(1.0), 0);
    for (std::size_t i = 0; i < world.placements.size(); ++i)
        visit(world.meshes[world.placements[i].mesh], glm::inverse(world.placements[i].to_world),
              std::uint32_t(i + 1));
    return best;
}

}  // namespace triad::traversal_case
