// Triangles that a scene should not have and that files do have: without area, thin as a needle, two or more
// in one place. The thresholds are zero.
#include "check/cases.h"
#include "check/hits.h"
#include "check/measurements.h"
#include "check/ray_caster.h"

namespace triad {
namespace {

using namespace traversal_case;

// C6
void degenerate_triangles(Check& check) {
    World clean, dirty;
    clean.origin_reach = dirty.origin_reach = 3.0f;
    const Primitive body = shapes::displaced_sphere(vec3(0.0f), 1.0f, 40, 20, 0.3f, 3.0f, 8);
    Random random(9);
    clean.add(0, body);
    dirty.add(0, body);
    for (std::size_t i = 0; i < body.triangles.size() / 10; ++i) {
        const vec3 p(random.in_cube(1.0)), q(vec3(random.in_cube(1.0)));
        if (i % 3 == 0) dirty.add(0, p, p, p);
        if (i % 3 == 1) dirty.add(0, p, q, p);
        if (i % 3 == 2) dirty.add(0, p, 0.5f * (p + p), p);
    }
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 20000; ++i) rays.push_back(ray(random.in_cube(2.0), random.direction()));
    const auto expected = RayCaster(check.device, clean).closest(rays),
               hits = RayCaster(check.device, dirty).closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) expect_same(check, hits[i], expected[i], 1.0f, i);
}

void sliver_blocks_no_ray(Check& check) {
    World world;
    world.origin_reach = 2.0f;
    world.add(0, vec3(-1, 0, 0), vec3(1, 1e-7f, 0), vec3(0, 0, 0));
    std::vector<dev::Ray> rays;
    Random random(10);
    for (int i = 0; i < 10000; ++i)
        rays.push_back(
            ray({random.between(-1, 1), random.between(0.001, 1) * (i % 2 ? 1 : -1), 1}, {0, 0, -1}));
    check.equal(count_misses(RayCaster(check.device, world).closest(rays)), rays.size(),
                "misses of a sliver");
}

// C7
void coincident_triangles(Check& check) {
    const Primitive wall = shapes::quad({-1, -1, 0.3f}, {2, 0, 0.1f}, {0, 2, 0}, 8, 8);
    const auto size = std::uint32_t(wall.triangles.size());
    Random random(11);
    const int count = int(check.count(20000));
    std::vector<dev::Ray> rays;
    for (int i = 0; i < count; ++i)
        rays.push_back(
            ray_towards(random.in_cube(3.0), {random.between(-.99, .99), random.between(-.99, .99), 0.3}));
    for (int order = 0; order < 4; ++order) {
        World world;
        world.origin_reach = 3.0f;
        for (int copy = 0; copy < 3; ++copy) world.add(0, wall);
        auto& triangles = world.meshes[0];
        if (order == 1) std::reverse(triangles.begin(), triangles.end());
        if (order > 1)
            for (std::size_t i = triangles.size(); i > 1; --i)
                std::swap(triangles[i - 1], triangles[random.below(i)]);
        if (order == 3)  // other corners first, and wound the other way
            for (BvhTriangle& t : triangles)
                if (t.primitive % 2) std::swap(t.corner[0], t.corner[2]);
        std::size_t hit = 0;
        for (const dev::Hit& h : RayCaster(check.device, world).closest(rays))
            if (h.primitive != TRIAD_NONE) {
                check.holds(h.primitive < size, "a higher id wins in order ", order);
                ++hit;
            }
        check.above(hit, count / 2, "hits");
    }
}

void coincident_instances(Check& check) {
    World world;
    world.origin_reach = 4.0f;
    world.add(1, shapes::lat_long_sphere(vec3(0.0f), 1.0f, 24, 12));
    const dmat4 place =
        glm::rotate(glm::translate(dmat4(1.0), dvec3(0.3, 0.1, -0.2)), 0.3, dvec3(0, 0.6, 0.8));
    for (int i = 0; i < 5; ++i) world.placements.push_back({1, place});
    Random random(12);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 5000; ++i) rays.push_back(ray(random.in_cube(3.0), random.direction()));
    std::size_t hit = 0;
    for (const dev::Hit& h : RayCaster(check.device, world).closest(rays))
        if (h.primitive != TRIAD_NONE) {
            check.equal(h.instance, 1u, "instance");
            ++hit;
        }
    check.above(hit, 200u, "hits");
}

void thousand_in_one_place(Check& check) {
    // Equal boxes, different triangles: nothing to split by, and nothing to drop.
    World world;
    world.origin_reach = 2.0f;
    for (int i = 0; i < 1000; ++i)
        world.add(0, vec3(-1, -1, 0), vec3(1, 1, 1), vec3(-1 + i * 0.002f, 1, 0.5f));
    Random random(13);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 300; ++i) rays.push_back(ray(random.in_cube(2.0), random.direction()));
    const auto hits = RayCaster(check.device, world).closest(rays);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Reference expected = brute_force(world, rays[i]);
        if (expected.margin < 1e-6 || expected.second_t - expected.t < 1e-5) continue;
        ++compared;
        check.equal(hits[i].primitive, expected.primitive, "primitive of ray ", i);
    }
    check.above(compared, 100u, "rays compared");
}

}  // namespace

void add_traversal_input(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C6", "degenerate triangles change nothing", quick, degenerate_triangles},
                     {"C6b", "a sliver blocks no ray beside it", standard, sliver_blocks_no_ray},
                     {"C7", "of coincident triangles the lower id", quick, coincident_triangles},
                     {"C7b", "of coincident instances the lower id", standard, coincident_instances},
                     {"T1", "a thousand triangles in one place", full, thousand_in_one_place},
                 });
}

}  // namespace triad
