#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "base/error.h"
#include "base/freed_memory.h"
#include "base/log.h"
#include "pack/geometry_packer.h"
#include "pack/pack.h"
#include "pack/touching.h"

namespace triad {
namespace {

std::size_t triangles_of(const Mesh& mesh) {
    std::size_t n = 0;
    for (const Primitive& p : mesh.primitives) n += p.triangles.size();
    return n;
}

bool emits(const Material& m) { return m.emission != vec3(0.0f) && !m.unlit; }

void write_rows(float out[12], const dmat4& m) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) out[row * 4 + column] = static_cast<float>(m[column][row]);
}

/// Largest coordinate of a point in it.
float largest(const Bounds& b) {
    const dvec3 most = glm::max(glm::abs(b.lo), glm::abs(b.hi));
    return static_cast<float>(std::max({most.x, most.y, most.z}));
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

/// Meshes that get a tree of their own, to be placed many times; the others are flattened into the world's.
/// Emissive ones are always: a light is a triangle in the world.
std::vector<bool> instanced_meshes(const Scene& scene, std::size_t flatten_below) {
    std::vector<std::size_t> uses(scene.meshes.size());
    std::size_t flat_total = 0;
    for (const MeshInstance& i : scene.instances) {
        ++uses[i.mesh];
        flat_total += triangles_of(scene.meshes[i.mesh]);
    }
    std::vector<bool> instanced(scene.meshes.size());
    for (std::size_t mesh = 0; mesh < instanced.size(); ++mesh) {
        const auto& primitives = scene.meshes[mesh].primitives;
        instanced[mesh] = flat_total > flatten_below && uses[mesh] > 1 &&
                          std::none_of(primitives.begin(), primitives.end(), [&](const Primitive& p) {
                              return emits(scene.materials[p.material]);
                          });
    }
    return instanced;
}

/// The table of instances, of which the first is the world, and the trees of their meshes.
class InstancePacker {
  public:
    InstancePacker(const Scene& scene, PackedScene& out, GeometryPacker& geometry, const dmat4& rebase,
                   const std::vector<bool>& instanced)
        : scene_(scene), out_(out), geometry_(geometry), objects_(scene.meshes.size()) {
        dev::Instance world{};
        write_rows(world.to_world, dmat4(1.0));
        write_rows(world.to_object, dmat4(1.0));
        out_.instance_table.push_back(world);
        std::size_t count = 0;
        for (const MeshInstance& i : scene.instances)
            if (instanced[i.mesh]) {
                ++count;
                float& reach = objects_[i.mesh].reach;
                reach = std::max(reach, largest(transformed(out.reach, glm::inverse(rebase * i.to_world))));
            }
        reserve_more(out_.instance_table, count);
        reserve_more(boxes_, count);
    }

    void add(std::size_t mesh, const dmat4& to_rebased) {
        out_.instances = true;
        const Object& object = built(mesh);
        dev::Instance instance{};
        write_rows(instance.to_world, to_rebased);
        write_rows(instance.to_object, glm::inverse(to_rebased));
        std::copy(object.roots->begin(), object.roots->end(), instance.root);
        const auto index = static_cast<std::uint32_t>(out_.instance_table.size());
        out_.instance_table.push_back(instance);
        if (placed_.insert(index).second) {
            boxes_.push_back({transformed(object.bounds, to_rebased), index});
        } else {
            out_.instance_table.pop_back();
            out_.duplicates += triangles_of(scene_.meshes[mesh]);
        }
    }

    std::vector<BvhInstance> take_boxes() { return std::move(boxes_); }

  private:
    /// A mesh in its own space, with its tree once it was placed.
    struct Object {
        std::optional<BvhRoots> roots;
        Bounds bounds;
        float reach = 0;  ///< of rays, from all placements
    };

    const Object& built(std::size_t mesh) {
        Object& object = objects_[mesh];
        if (object.roots) return object;
        std::vector<BvhTriangle> triangles;
        geometry_.add_shared(scene_.meshes[mesh], triangles);
        for (const BvhTriangle& t : triangles)
            for (const vec3& c : t.corner) object.bounds.add(dvec3(c));
        object.roots = build_bvh(std::move(triangles), {}, object.reach, out_.bvh);
        return object;
    }

    std::string_view matrix(std::uint32_t i) const {
        const auto& rows = out_.instance_table[i].to_world;
        return {reinterpret_cast<const char*>(rows), sizeof rows};
    }

    struct Hash {
        const InstancePacker* of;
        std::size_t operator()(std::uint32_t i) const { return std::hash<std::string_view>()(of->matrix(i)); }
    };
    struct Equal {
        const InstancePacker* of;
        bool operator()(std::uint32_t a, std::uint32_t b) const {
            return of->matrix(a) == of->matrix(b) &&
                   std::ranges::equal(of->out_.instance_table[a].root, of->out_.instance_table[b].root);
        }
    };

    const Scene& scene_;
    PackedScene& out_;
    GeometryPacker& geometry_;
    std::vector<Object> objects_;
    std::vector<BvhInstance> boxes_;
    /// Exact duplicates are dropped: the same mesh with the same matrix.
    std::unordered_set<std::uint32_t, Hash, Equal> placed_{0, Hash{this}, Equal{this}};
};

/// Packs what is placed: `flat` gets the triangles of the world's own tree. Returns the boxes of instances.
std::vector<BvhInstance> pack_placed(const Scene& scene, const RenderSettings& settings, PackedScene& packed,
                                     std::vector<BvhTriangle>& flat) {
    const dmat4 rebase = glm::translate(dmat4(1.0), -packed.origin);
    const std::vector<bool> instanced = instanced_meshes(scene, settings.flatten_below);
    GeometryPacker packer(
        scene, packed,
        settings.view.orthographic ? std::nullopt : std::optional(settings.view.eye - packed.origin));
    InstancePacker instances(scene, packed, packer, rebase, instanced);
    std::size_t flat_count = 0;
    for (const MeshInstance& i : scene.instances)
        if (!instanced[i.mesh]) flat_count += triangles_of(scene.meshes[i.mesh]);
    flat.reserve(flat_count), packed.triangles.reserve(flat_count);
    for (const MeshInstance& i : scene.instances)
        if (instanced[i.mesh])
            instances.add(i.mesh, rebase * i.to_world);
        else
            packer.add_placed(scene.meshes[i.mesh], rebase * i.to_world, flat);
    return instances.take_boxes();
}

}  // namespace

void pack_geometry(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    const Bounds world = bounds_of(scene);
    packed.origin = glm::clamp(settings.view.eye, world.lo, world.hi);
    packed.bounds = {world.lo - packed.origin, world.hi - packed.origin};
    packed.reach = reach_of(packed.bounds, settings.view.eye - packed.origin, lens_reach(settings.view));

    std::vector<BvhTriangle> flat;
    std::vector<BvhInstance> boxes = pack_placed(scene, settings, packed, flat);
    if (flat.empty() && boxes.empty())
        throw Error(Exit::scene,
                    "There is nothing to render in " + scene.name + ": its scene has no triangles.");
    note_touching(scene, packed, flat);
    packed.first_placed_block = packed.bvh.blocks.size();
    std::copy_if(flat.begin(), flat.end(), std::back_inserter(packed.emitters), [&](const BvhTriangle& t) {
        return emits(scene.materials[packed.geometries[t.geometry].material]);
    });
    packed.roots = build_bvh(std::move(flat), std::move(boxes), largest(packed.reach), packed.bvh);
    give_back_freed_memory();
    detail("packed " + std::to_string(packed.triangles.size()) + " triangles in " +
           std::to_string(packed.geometries.size()) + " geometries, " +
           std::to_string(packed.instance_table.size() - 1) + " instances");
}

}  // namespace triad
