/// What a packing promises to the eye, and for which other eyes that holds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "pack/pack.h"
#include "pack/refine.h"

namespace triad {
namespace {

/// A packing is kept while its promises hold within a factor of two: without it, a step of an eye before a
/// floor that was cut for it would already cut other edges. Points then err by twice as much, still far below
/// 1e-4 of their distance (pack/refine.h).
constexpr double longest_kept_edge = 2 * longest_edge_per_distance;
/// Coordinates of a triangle are as many times its distance from the eye that a scene is packed for as its
/// edges are, since the render origin lies at that eye, and once more.
constexpr double most_coordinate = 2 * (longest_edge_per_distance + 1);

/// Whether what was packed with settings `a` holds for `b`: paths leave what is packed for photons alone.
bool packs_alike(const RenderSettings& a, const RenderSettings& b) {
    return a.spectral == b.spectral && a.texture_levels == b.texture_levels &&
           (b.integrator == Integrator::path ||
            (a.integrator == b.integrator && a.aim_photons == b.aim_photons)) &&
           (a.ray_start == RayStart::filter) == (b.ray_start == RayStart::filter) &&
           a.environment_rotation == b.environment_rotation &&
           a.environment_strength == b.environment_strength && a.flatten_below == b.flatten_below;
}

bool same_place(const View& a, const View& b) {
    return a.eye == b.eye && a.orthographic == b.orthographic && lens_reach(a) <= lens_reach(b);
}

/// The squared distance of p from the segment between a and b.
double distance2(const dvec3& p, const dvec3& a, const dvec3& b) {
    const dvec3 edge = b - a;
    const double length2 = glm::dot(edge, edge);
    const double at = length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0.0;
    const dvec3 off = p - a - edge * at;
    return glm::dot(off, off);
}

/// The same from a triangle: from its plane where p lies above its inside.
double distance2(const dvec3& p, const dvec3 corner[3]) {
    const dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    bool inside = true;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const dvec3 &a = corner[i], &b = corner[(i + 1) % 3];
        inside &= glm::dot(glm::cross(b - a, p - a), normal) >= 0;
        least = std::min(least, distance2(p, a, b));
    }
    const double above = glm::dot(p - corner[0], normal);
    return inside && normal != dvec3(0.0) ? above * above / glm::dot(normal, normal) : least;
}

/// What is flattened is exact enough for an eye at `eye` (rebased).
bool is_exact(const PackedScene& packed, const dvec3& eye) {
    const dvec3 most = glm::max(glm::abs(packed.bounds.lo), glm::abs(packed.bounds.hi));
    const Cutter cutter(eye, std::max({most.x, most.y, most.z}), longest_kept_edge);
    for (std::size_t i = packed.first_placed_block; i < packed.bvh.blocks.size(); ++i) {
        const dev::TriangleBlock& block = packed.bvh.blocks[i];
        for (int lane = 0; lane < 4; ++lane) {
            dvec3 corner[3];
            double coordinate = 0;
            for (int c = 0; c < 3; ++c)
                for (int axis = 0; axis < 3; ++axis) {
                    corner[c][axis] = block.vertex[c * 3 + axis][lane];
                    coordinate = std::max(coordinate, std::abs(corner[c][axis]));
                }
            if (coordinate * coordinate > most_coordinate * most_coordinate * distance2(eye, corner) ||
                cutter.cuts_any(corner[0], corner[1], corner[2]))
                return false;
        }
    }
    return true;
}

}  // namespace

bool holds_for(const PackedScene& packed, const RenderSettings& settings) {
    if (!packs_alike(packed.settings, settings)) return false;
    const View& view = settings.view;
    if (same_place(view, packed.settings.view)) return true;
    const dvec3 eye = view.eye - packed.origin;
    const double around = lens_reach(view);
    const Bounds& reach = packed.reach;
    const dvec3 low = eye - around, high = eye + around;
    if (glm::any(glm::lessThan(low, reach.lo)) || glm::any(glm::greaterThan(high, reach.hi))) return false;
    return view.orthographic || is_exact(packed, eye);
}

std::shared_ptr<const PackedScene> pack_for(const Scene& scene, const RenderSettings& settings,
                                            std::shared_ptr<const PackedScene> before, BvhFormats formats) {
    if (before && holds_for(*before, settings)) {
        const BvhFormats& there = before->bvh.formats;
        if (std::includes(there.begin(), there.end(), formats.begin(), formats.end())) return before;
        // For the same eye again, so that all devices see the same scene.
        formats.insert(there.begin(), there.end());
        auto packed = std::make_shared<PackedScene>(pack(scene, before->settings, before->surfaces, formats));
        packed->packings = before->packings;
        return packed;
    }
    const bool share = before && packs_alike(before->settings, settings);
    if (before) formats.insert(before->bvh.formats.begin(), before->bvh.formats.end());
    auto packed = std::make_shared<PackedScene>(
        pack(scene, settings, share ? before->surfaces : std::shared_ptr<const PackedSurfaces>{}, formats));
    if (share) packed->packings = before->packings + 1;
    return packed;
}

std::string text_of(const RenderSettings& settings, const PackedScene& packed) {
    std::string text = text_of(settings);
    text.pop_back();
    // Named where they are on, so that films of before, which had none, do not merge with them.
    if (has_levels(*packed.surfaces)) text += ", \"texture_levels\": 1";
    const dvec3& eye = packed.settings.view.eye;
    if (eye != settings.view.eye || packed.settings.view.orthographic != settings.view.orthographic) {
        char place[128];
        std::snprintf(place, sizeof place, ", \"packed_for_eye\": [%.17g, %.17g, %.17g]", eye.x, eye.y,
                      eye.z);
        text += place;
    }
    return text + "}";
}

}  // namespace triad
