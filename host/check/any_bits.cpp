// Rays of any bits: whatever stands in a ray, nothing is read beyond the trees (a simulator sees it, a CPU
// may crash), the walk ends, and what is hit is a triangle of the scene.
#include "check/any_bits.h"

#include "check/cases.h"
#include "check/measurements.h"
#include "check/ray_caster.h"

namespace triad {
namespace {

using namespace traversal_case;

/// Nodes with empty children on both levels, blocks with fewer than four triangles, a mesh that is placed
/// mirrored, shrunk and enlarged to the ends of what float can square.
World world_of_both_levels() {
    World world;
    world.origin_reach = 8.0f;
    world.add(0, shapes::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}, 3, 3));
    world.add(1, shapes::lat_long_sphere(vec3(0.0f), 1.0f, 6, 4));
    world.add(2, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
    const dmat4 one(1.0);
    world.placements = {{1, glm::scale(glm::translate(one, dvec3(1, 0, 0)), dvec3(-1, 0.5, 1))},
                        {1, glm::scale(one, dvec3(1e-18))},
                        {2, glm::scale(glm::translate(one, dvec3(0, 2, 0)), dvec3(1e-9, 1e9, 1))},
                        {2, glm::translate(one, dvec3(0, -2, 1))}};
    return world;
}

dev::Ray any_ray(any_bits::Words& words) {
    dev::Ray r{};
    for (float& x : r.origin) x = words.number();
    for (float& x : r.direction) x = words.number();
    r.t_max = words.bits() % 4 ? std::numeric_limits<float>::infinity() : words.number();
    // Some numbers stay ordinary, so that the others come as far as the leaves.
    const std::uint32_t ordinary = words.bits();
    for (int a = 0; a < 3; ++a) {
        if (ordinary >> a & 1) r.origin[a] = float(a) - 1.0f;
        if (ordinary >> (a + 3) & 1) r.direction[a] = a == 2 ? -1.0f : 0.1f;
    }
    r.skip_instance = ordinary & 64 ? words.bits() : words.bits() % 5;
    r.skip_primitive = ordinary & 128 ? words.bits() : words.bits() % 64;
    return r;
}

std::vector<dev::Ray> any_rays(std::size_t count) {
    any_bits::Words words(25);
    std::vector<dev::Ray> rays(count);
    for (dev::Ray& r : rays) r = any_ray(words);
    return rays;
}

/// A triangle of the scene, where the ray goes.
bool is_of(const World& world, const dev::Hit& hit, const dev::Ray& ray) {
    return hit.primitive < world.triangle_count && hit.instance <= world.placements.size() && hit.t > 0 &&
           hit.t <= ray.t_max;
}

void rays_of_any_bits(Check& check) {
    const World world = world_of_both_levels();
    const std::vector<dev::Ray> rays = any_rays(check.count(1 << 21, 2048));
    const RayCaster caster(check.device, world);
    const auto hits = caster.closest(rays);
    const auto occluded = caster.occluded(rays);
    std::size_t found = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const dev::Hit& hit = hits[i];
        const bool hits_something = hit.primitive != TRIAD_NONE;
        found += hits_something;
        wrong += occluded[i] != (hits_something ? 1u : 0u);
        if (hits_something) wrong += !is_of(world, hit, rays[i]);
    }
    check.at_most(double(wrong), 0, "answers that are none, of ", rays.size());
    check.above(double(found), double(rays.size()) / 100, "rays that hit something");
}

// Bounds on rays that are no numbers are none: what lies beside such a ray may be missed, or all be visited.
void packets_of_any_bits(Check& check) {
    const WithFormat walks(check.device, BvhFormat::bvh8);
    const World world = world_of_both_levels();
    const std::vector<dev::Ray> rays = any_rays(check.count(1 << 20, 2048));
    const auto hits = RayCaster(check.device, world, {{"TRIAD_PACKETS", "1"}}).packets(rays);
    std::size_t found = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].primitive == TRIAD_NONE) continue;
        ++found;
        wrong += !is_of(world, hits[i], rays[i]);
    }
    check.at_most(double(wrong), 0, "answers that are none, of ", rays.size());
    check.above(double(found), double(rays.size()) / 100, "rays that hit something");
}

}  // namespace

void add_any_bits(std::vector<CheckCase>& cases) {
    cases.push_back({"C25", "rays of any bits", CheckLevel::quick, rays_of_any_bits});
    cases.push_back({"C25b", "packets of any bits", CheckLevel::quick, packets_of_any_bits});
}

}  // namespace triad
