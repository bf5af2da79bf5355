#include "scene/farthest_point.h"

#include <algorithm>

#include "base/parallel_for.h"
#include "scene/strokes.h"

namespace triad {
namespace {

constexpr std::size_t block_size = 512;  // triangles
constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// Textures and vertex colours multiply alpha by at most 1.
bool is_never_seen(const Material& m) {
    return (m.alpha_mode == AlphaMode::blend && m.base_colour.w <= 0.0f) ||
           (m.alpha_mode == AlphaMode::mask && m.base_colour.w < m.alpha_cutoff);
}

}  // namespace

/// The farthest point so far.
struct FarthestPoint::Search {
    dvec3 direction;
    double reach = nowhere;
    dvec3 point{0.0};

    void meet(const dvec3& p) {
        if (const double r = glm::dot(direction, p); r > reach) reach = r, point = p;
    }
};

FarthestPoint::FarthestPoint(const Scene& scene)
    : stroke_ends_(scene.stroke_ends.empty() ? ends_of_strokes(scene) : scene.stroke_ends) {
    for (const bool all : {false, true}) {
        add_blocks(scene, all);
        if (!placed_.empty() || !stroke_ends_.empty()) break;
    }
    Bounds bounds;
    for (const dvec3& p : stroke_ends_) bounds.add(p);
    for (const Placed& placed : placed_) {
        bounds.add(placed.box.centre - placed.box.half);
        bounds.add(placed.box.centre + placed.box.half);
    }
    if (!bounds.empty()) origin_ = bounds.centre();
    for (dvec3& p : stroke_ends_) p -= origin_;
    for (Placed& placed : placed_) placed.box.centre -= origin_;
}

void FarthestPoint::add_blocks(const Scene& scene, bool all) {
    meshes_.assign(scene.meshes.size(), {});
    std::vector<Block*> blocks;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        for (const Primitive& p : scene.meshes[i].primitives) {
            if (!all && is_never_seen(scene.materials[p.material])) continue;
            for (std::size_t first = 0; first < p.triangles.size(); first += block_size)
                meshes_[i].blocks.push_back(
                    {&p, first, std::min(block_size, p.triangles.size() - first), {}});
        }
        for (Block& block : meshes_[i].blocks) blocks.push_back(&block);
    }
    parallel_for(blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Block& block = *blocks[i];
            Bounds bounds;
            for (std::size_t k = block.first; k < block.first + block.count; ++k)
                for (int corner = 0; corner < 3; ++corner)
                    bounds.add(dvec3(block.primitive->positions[block.primitive->triangles[k][corner]]));
            block.box = Box(bounds);
        }
    });
    for (MeshBlocks& mesh : meshes_) {
        Bounds bounds;
        for (const Block& block : mesh.blocks) {
            bounds.add(block.box.centre - block.box.half);
            bounds.add(block.box.centre + block.box.half);
        }
        if (!bounds.empty()) mesh.box = Box(bounds);
    }
    for (const MeshInstance& instance : scene.instances) {
        const MeshBlocks& mesh = meshes_[instance.mesh];
        if (instance.is_drawn_strokes || instance.is_ground || mesh.blocks.empty()) continue;
        const dmat3 m(instance.to_world);
        Placed placed{&instance, {}};
        placed.box.centre = transform_point(instance.to_world, mesh.box.centre);
        placed.box.half = dmat3(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])) * mesh.box.half;
        placed_.push_back(placed);
    }
}

dvec3 FarthestPoint::operator()(const dvec3& direction) const {
    Search search{direction};
    for (const dvec3& p : stroke_ends_) search.meet(p);
    // The instance whose box reaches farthest comes first: it leaves few others to look into.
    const Placed* first = nullptr;
    double farthest = nowhere;
    for (const Placed& placed : placed_)
        if (const double r = placed.box.reach(direction); r > farthest) farthest = r, first = &placed;
    if (first) look_into(search, *first->instance);
    for (const Placed& placed : placed_)
        if (&placed != first && placed.box.reach(direction) > search.reach)
            look_into(search, *placed.instance);
    return search.point;
}

void FarthestPoint::look_into(Search& search, const MeshInstance& instance) const {
    dmat4 to_world = instance.to_world;
    to_world[3] -= dvec4(origin_, 0.0);
    const dvec3 direction = glm::transpose(dmat3(to_world)) * search.direction;
    const double beside = glm::dot(search.direction, dvec3(to_world[3]));
    const std::vector<Block>& blocks = meshes_[instance.mesh].blocks;
    const auto visit = [&](const Block& block) {
        for (std::size_t k = block.first; k < block.first + block.count; ++k)
            for (int corner = 0; corner < 3; ++corner)
                search.meet(transform_point(
                    to_world, dvec3(block.primitive->positions[block.primitive->triangles[k][corner]])));
    };
    const auto first = std::max_element(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) {
        return a.box.reach(direction) < b.box.reach(direction);
    });
    visit(*first);
    for (auto block = blocks.begin(); block != blocks.end(); ++block)
        if (block != first && beside + block->box.reach(direction) > search.reach) visit(*block);
}

}  // namespace triad
