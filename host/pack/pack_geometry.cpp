#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "pack/pack.h"
#include "pack/refine.h"
#include "pack/touching.h"

namespace triad {
namespace {

std::uint32_t index32(std::size_t value) {
    if (value >= BVH_INDEX)
        throw Error(Exit::memory, "The scene has more vertices or triangles (" + std::to_string(value) +
                                      ") than 30-bit indices reach; split it or use instances.");
    return static_cast<std::uint32_t>(value);
}

void append(AlignedVector<float>& out, const vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); }

std::size_t triangles_of(const Mesh& mesh) {
    std::size_t n = 0;
    for (const Primitive& p : mesh.primitives) n += p.triangles.size();
    return n;
}

bool emits(const Material& m) { return m.emission != vec3(0.0f) && !m.unlit; }

/// Where a primitive's attributes that do not depend on the placement lie: shared by all its uses.
struct Shared {
    std::uint32_t uv[2], colour;
};

class GeometryPacker {
  public:
    /// `eye` in the packed world; none: nothing is refined.
    GeometryPacker(const Scene& scene, PackedScene& out, const std::optional<dvec3>& eye)
        : scene_(scene),
          out_(out),
          eye_(eye),
          reach_(glm::max(glm::abs(out.bounds.lo), glm::abs(out.bounds.hi))) {}

    /// Appends the mesh, transformed into the world, and its triangles for the tree builder.
    void add_placed(const Mesh& mesh, const dmat4& to_world, std::vector<BvhTriangle>& tree) {
        for (const Primitive& p : mesh.primitives) {
            std::vector<dvec3> position = transformed(p, to_world);
            const double reach = std::max({reach_.x, reach_.y, reach_.z});
            if (!eye_ || !needs_refining(p, position, *eye_, reach)) {
                add(p, share(p), position, to_world, tree);
                continue;
            }
            Primitive refined = p;
            refine(refined, position, *eye_, reach);
            detail("cut triangles that are large beside their distance to the eye: " +
                   std::to_string(p.triangles.size()) + " became " +
                   std::to_string(refined.triangles.size()));
            add(refined, store(refined), position, to_world, tree);
        }
    }

    /// The same in the mesh's own space, for instances to share.
    void add_shared(const Mesh& mesh, std::vector<BvhTriangle>& tree) {
        for (const Primitive& p : mesh.primitives)
            add(p, share(p), transformed(p, dmat4(1.0)), dmat4(1.0), tree);
    }

  private:
    const Scene& scene_;
    PackedScene& out_;
    const std::optional<dvec3> eye_;
    const dvec3 reach_;
    std::unordered_map<const Primitive*, Shared> shared_;

    static std::vector<dvec3> transformed(const Primitive& p, const dmat4& m) {
        std::vector<dvec3> position;
        position.reserve(p.positions.size());
        for (const vec3& v : p.positions) position.push_back(transform_point(m, dvec3(v)));
        return position;
    }

    Shared store(const Primitive& p) {
        Shared at{{TRIAD_NONE, TRIAD_NONE}, TRIAD_NONE};
        for (int set = 0; set < 2; ++set)
            if (!p.uvs[set].empty()) {
                at.uv[set] = index32(out_.uvs.size() / 2);
                reserve_more(out_.uvs, 2 * p.uvs[set].size());
                for (const vec2& uv : p.uvs[set]) out_.uvs.insert(out_.uvs.end(), {uv.x, uv.y});
            }
        if (!p.colours.empty()) {
            at.colour = index32(out_.colours.size() / 4);
            reserve_more(out_.colours, 4 * p.colours.size());
            for (const vec4& c : p.colours) out_.colours.insert(out_.colours.end(), {c.x, c.y, c.z, c.w});
        }
        return at;
    }

    Shared share(const Primitive& p) {
        const auto it = shared_.find(&p);
        return it != shared_.end() ? it->second : shared_.emplace(&p, store(p)).first->second;
    }

    /// `position`: of p's vertices in the space of the tree, which `m` leads to.
    void add(const Primitive& p, const Shared& shared, const std::vector<dvec3>& position, const dmat4& m,
             std::vector<BvhTriangle>& tree) {
        const dmat3 linear(m);
        const bool mirrored = glm::determinant(linear) < 0.0;
        dev::Geometry g{};
        g.first_triangle = index32(out_.triangles.size());
        g.material = static_cast<std::uint32_t>(p.material);
        g.normal = p.normals.empty() ? TRIAD_NONE : index32(out_.normals.size() / 3);
        g.tangent = p.tangents.empty() ? TRIAD_NONE : index32(out_.tangents.size() / 4);
        g.uv[0] = shared.uv[0], g.uv[1] = shared.uv[1];
        g.colour = shared.colour;
        g.first_light = TRIAD_NONE;
        g.touching = TRIAD_NONE;

        const dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
        reserve_more(out_.normals, 3 * p.normals.size());
        reserve_more(out_.tangents, 4 * p.tangents.size());
        for (const vec3& n : p.normals) append(out_.normals, vec3(glm::normalize(normal_matrix * dvec3(n))));
        for (const vec4& t : p.tangents) {
            append(out_.tangents, vec3(glm::normalize(linear * dvec3(vec3(t)))));
            out_.tangents.push_back(mirrored ? -t.w : t.w);
        }
        const Material& material = scene_.materials[p.material];
        const std::uint32_t geometry = index32(out_.geometries.size());
        for (const uvec3& t : p.triangles) {
            // Mirroring turns the winding around; swapping two corners keeps the front the front.
            const std::uint32_t corner[3] = {t.x, mirrored ? t.z : t.y, mirrored ? t.y : t.z};
            BvhTriangle b;
            for (int c = 0; c < 3; ++c) b.corner[c] = vec3(position[corner[c]]);
            b.primitive = index32(out_.triangles.size());
            b.geometry = geometry;
            b.opaque = material.alpha_mode == AlphaMode::opaque;
            tree.push_back(b);
            out_.triangles.push_back({{corner[0], corner[1], corner[2]}, geometry});
        }
        out_.geometries.push_back(g);
    }
};

void write_rows(float out[12], const dmat4& m) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) out[row * 4 + column] = static_cast<float>(m[column][row]);
}

float largest(const dvec3& v) {
    return static_cast<float>(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

Bounds transformed(const Bounds& b, const dmat4& m) {
    Bounds out;
    for (int corner = 0; corner < 8; ++corner)
        out.add(transform_point(m, dvec3(corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y,
                                         corner & 4 ? b.hi.z : b.lo.z)));
    return out;
}

/// Rays start on surfaces or at the camera, the lens included; where the eye is outside, wherever it may turn
/// to around the scene.
Bounds reach_of(const Bounds& scene, const dvec3& eye, double around) {
    Bounds reach = scene;
    reach.add({eye - around, eye + around});
    if (scene.lo == glm::min(scene.lo, eye) && scene.hi == glm::max(scene.hi, eye)) return reach;
    const double radius = glm::length(eye - scene.centre()) + around;
    reach.add({scene.centre() - radius, scene.centre() + radius});
    return reach;
}

}  // namespace

void pack_geometry(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    const Bounds world = bounds_of(scene);
    packed.origin = glm::clamp(settings.view.eye, world.lo, world.hi);
    packed.bounds = {world.lo - packed.origin, world.hi - packed.origin};
    const dmat4 rebase = glm::translate(dmat4(1.0), -packed.origin);

    std::vector<std::size_t> uses(scene.meshes.size());
    std::size_t flat_total = 0;
    for (const MeshInstance& i : scene.instances) {
        ++uses[i.mesh];
        flat_total += triangles_of(scene.meshes[i.mesh]);
    }
    // Emissive meshes are always flattened: a light is a triangle in the world.
    auto instanced = [&](std::size_t mesh) {
        const auto& primitives = scene.meshes[mesh].primitives;
        return flat_total > settings.flatten_below && uses[mesh] > 1 &&
               std::none_of(primitives.begin(), primitives.end(),
                            [&](const Primitive& p) { return emits(scene.materials[p.material]); });
    };

    dev::Instance identity{};
    write_rows(identity.to_world, dmat4(1.0));
    write_rows(identity.to_object, dmat4(1.0));
    packed.instance_table.push_back(identity);

    const dvec3 eye = settings.view.eye - packed.origin;
    packed.reach = reach_of(packed.bounds, eye, lens_reach(settings.view));
    const Bounds& reach = packed.reach;

    GeometryPacker packer(scene, packed, settings.view.orthographic ? std::nullopt : std::optional(eye));
    std::vector<BvhTriangle> flat;
    std::size_t flat_count = 0;
    for (const MeshInstance& i : scene.instances)
        if (!instanced(i.mesh)) flat_count += triangles_of(scene.meshes[i.mesh]);
    flat.reserve(flat_count), packed.triangles.reserve(flat_count);
    std::vector<BvhInstance> boxes;
    std::vector<std::optional<BvhRoots>> roots(scene.meshes.size());
    std::vector<Bounds> object_bounds(scene.meshes.size());
    std::vector<float> object_reach(scene.meshes.size());
    for (const MeshInstance& i : scene.instances)
        if (instanced(i.mesh))
            object_reach[i.mesh] = std::max(object_reach[i.mesh], [&] {
                const Bounds b = transformed(reach, glm::inverse(rebase * i.to_world));
                return std::max(largest(b.lo), largest(b.hi));
            }());
    // Exact duplicates: the same mesh with the same matrix.
    const auto matrix = [&](std::uint32_t i) {
        const auto& rows = packed.instance_table[i].to_world;
        return std::string_view(reinterpret_cast<const char*>(rows), sizeof rows);
    };
    const auto hash = [&](std::uint32_t i) { return std::hash<std::string_view>()(matrix(i)); };
    const auto equal = [&](std::uint32_t a, std::uint32_t b) {
        return matrix(a) == matrix(b) &&
               std::ranges::equal(packed.instance_table[a].root, packed.instance_table[b].root);
    };
    std::unordered_set<std::uint32_t, decltype(hash), decltype(equal)> placed(0, hash, equal);
    for (const MeshInstance& i : scene.instances) {
        const dmat4 to_rebased = rebase * i.to_world;
        const Mesh& mesh = scene.meshes[i.mesh];
        if (!instanced(i.mesh)) {
            packer.add_placed(mesh, to_rebased, flat);
            continue;
        }
        packed.instances = true;
        if (!roots[i.mesh]) {
            std::vector<BvhTriangle> own;
            packer.add_shared(mesh, own);
            for (const BvhTriangle& t : own)
                for (const vec3& c : t.corner) object_bounds[i.mesh].add(dvec3(c));
            roots[i.mesh] = build_bvh(std::move(own), {}, object_reach[i.mesh], packed.bvh);
        }
        dev::Instance instance{};
        write_rows(instance.to_world, to_rebased);
        write_rows(instance.to_object, glm::inverse(to_rebased));
        std::copy(roots[i.mesh]->begin(), roots[i.mesh]->end(), instance.root);
        const auto index = static_cast<std::uint32_t>(packed.instance_table.size());
        packed.instance_table.push_back(instance);
        if (!placed.insert(index).second) {
            packed.instance_table.pop_back();
            packed.duplicates += triangles_of(mesh);
            continue;
        }
        boxes.push_back({transformed(object_bounds[i.mesh], to_rebased), index});
    }
    if (flat.empty() && boxes.empty())
        throw Error(Exit::scene,
                    "There is nothing to render in " + scene.name + ": its scene has no triangles.");
    note_touching(scene, packed, flat);
    packed.first_placed_block = packed.bvh.blocks.size();
    std::copy_if(flat.begin(), flat.end(), std::back_inserter(packed.emitters), [&](const BvhTriangle& t) {
        return emits(scene.materials[packed.geometries[t.geometry].material]);
    });
    packed.roots =
        build_bvh(std::move(flat), boxes, std::max(largest(reach.lo), largest(reach.hi)), packed.bvh);
    detail("packed " + std::to_string(packed.triangles.size()) + " triangles in " +
           std::to_string(packed.geometries.size()) + " geometries, " + std::to_string(boxes.size()) +
           " instances");
}

}  // namespace triad
