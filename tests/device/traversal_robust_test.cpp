// What breaks ray tracers: shared edges, rays in planes, flat and tiny boxes, leaving a surface, scale,
// degenerate and coincident input. The thresholds are zero.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "traversal_fixture.h"

using namespace triad;
using namespace triad::traversal_test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t count_misses(const std::vector<dev::Hit>& hits) {
    return std::size_t(
        std::count_if(hits.begin(), hits.end(), [](const dev::Hit& h) { return h.primitive == TRIAD_NONE; }));
}

void expect_same(const dev::Hit& a, const dev::Hit& b, float t_scale, std::size_t i) {
    ASSERT_EQ(a.primitive, b.primitive) << i;
    ASSERT_EQ(a.instance, b.instance) << i;
    if (a.primitive == TRIAD_NONE) return;
    ASSERT_EQ(a.t, b.t * t_scale) << i;
    ASSERT_EQ(a.u, b.u) << i;
    ASSERT_EQ(a.v, b.v) << i;
}

// C1
TEST(TraversalRobust, no_ray_slips_through_the_edges_and_corners_of_a_closed_surface) {
    for (const float offset : {0.0f, 1e2f, 1e4f}) {
        const vec3 centre(offset);
        World world;
        world.origin_reach = offset + 2.0f;
        const Primitive sphere = shapes::lat_long_sphere(centre, 1.0f, 64, 32);
        world.add(0, sphere);
        const Tracer tracer(world);
        Random random(1);
        std::vector<dev::Ray> rays;
        for (std::size_t i = 0; i < 200000; ++i) {
            const uvec3 t = sphere.triangles[random.below(sphere.triangles.size())];
            const unsigned corner = unsigned(random.below(3));
            const dvec3 a(sphere.positions[t[corner]]), b(sphere.positions[t[(corner + 1) % 3]]);
            const double along = i % 2 ? random() : 0.0;  // odd: on an edge, even: at a corner
            rays.push_back(ray_towards(dvec3(centre) + random.in_cube(0.4), a + along * (b - a)));
        }
        EXPECT_EQ(count_misses(tracer.closest(rays)), 0u) << "offset " << offset;
        const auto occluded = tracer.occluded(rays);
        EXPECT_EQ(std::count(occluded.begin(), occluded.end(), 0u), 0) << "offset " << offset;
    }
}

TEST(TraversalRobust, no_ray_slips_through_an_instance) {
    World world;
    world.origin_reach = 60.0f;
    const Primitive sphere = shapes::lat_long_sphere(vec3(0.0f), 1.0f, 48, 24);
    world.add(1, sphere);
    const dmat4 to_world =
        glm::scale(glm::rotate(glm::translate(dmat4(1.0), dvec3(31, -47, 22)), 0.7, dvec3(.6, .8, 0)),
                   dvec3(-3.0, 0.05, 1.0));
    world.placements.push_back({1, to_world});
    Random random(2);
    std::vector<dev::Ray> rays;
    for (std::size_t i = 0; i < 100000; ++i) {
        const uvec3 t = sphere.triangles[random.below(sphere.triangles.size())];
        const dvec3 a(sphere.positions[t.x]), b(sphere.positions[t.y]);
        rays.push_back(ray_towards(transform_point(to_world, random.in_cube(0.4)),
                                   transform_point(to_world, a + random() * (b - a))));
    }
    EXPECT_EQ(count_misses(Tracer(world).closest(rays)), 0u);
}

// C2
TEST(TraversalRobust, rays_in_the_planes_of_boxes_hit) {
    World world;
    world.origin_reach = 8.0f;
    // A wall at z = 0 in unit cells: the planes of all boxes are at integers, and so are the rays.
    world.add(0, shapes::quad({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}, 16, 16));
    std::vector<dev::Ray> rays;
    for (int x = -7; x <= 7; ++x)
        for (int y = -7; y <= 7; ++y)
            for (const double sign : {1.0, -1.0})
                for (const double zero : {0.0, -0.0}) {
                    rays.push_back(ray(dvec3(x, y, 3 * sign), dvec3(zero, zero, -sign)));
                    rays.push_back(ray(dvec3(x, y - 3, 3 * sign), dvec3(zero, 1, -sign)));
                    rays.push_back(ray(dvec3(x - 0.5, y, sign), dvec3(0.5, zero, -sign)));
                }
    std::erase_if(rays, [](const dev::Ray& r) { return r.origin[1] < -8 || r.origin[0] < -8; });
    EXPECT_EQ(count_misses(Tracer(world).closest(rays)), 0u) << "of " << rays.size();
}

TEST(TraversalRobust, rays_along_the_axes_hit_boxes_that_start_at_their_origin) {
    World world;
    world.origin_reach = 1.0f;
    world.add(0, shapes::box(vec3(-1.0f), vec3(1.0f), true));
    std::vector<dev::Ray> rays;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            for (const double a : {-1.0, -0.5, 0.0, 0.25, 1.0})
                for (const double b : {-1.0, 0.0, 0.75, 1.0}) {
                    dvec3 o(0.0), d(0.0);
                    o[(axis + 1) % 3] = a, o[(axis + 2) % 3] = b, d[axis] = sign;
                    rays.push_back(ray(o, d));
                }
    const auto hits = Tracer(world).closest(rays);
    EXPECT_EQ(count_misses(hits), 0u);
    for (const dev::Hit& hit : hits) EXPECT_EQ(hit.t, 1.0f);
}

// C2b
TEST(TraversalRobust, the_slab_test_never_misses_a_tiny_or_flat_box_that_holds_a_hit) {
    // The same rays and triangles with boxes padded by whole units: what the triangle test alone finds.
    Random random(3);
    std::size_t misses = 0, found = 0;
    for (int round = 0; round < 10; ++round) {
        World world;
        const double size = std::pow(10.0, -5.0 + round * 0.5);
        world.origin_reach = 10.0f;
        for (int i = 0; i < 500; ++i) {  // far apart, so that each lies in a box of its own
            const vec3 c(random.in_cube(8.0));
            dvec3 u = size * random.direction(), v = size * random.direction();
            if (i % 2) u[i / 2 % 3] = v[i / 2 % 3] = 0.0;  // flat
            world.add(0, c - vec3(u) - vec3(v), c + vec3(u), c + vec3(v));
        }
        std::vector<dev::Ray> rays;
        for (int i = 0; i < 100000; ++i) {
            const auto& t = world.meshes[0][random.below(500)].corner;
            double a = random(), b = random();
            if (a + b > 1) a = 1 - a, b = 1 - b;
            if (i % 8 == 0) a = 0;
            const dvec3 p = dvec3(t[0]) + a * dvec3(t[1] - t[0]) + b * dvec3(t[2] - t[0]);
            rays.push_back(ray_towards(random.in_cube(10.0), p));
        }
        const auto hits = Tracer(world).closest(rays);
        world.origin_reach = 1e6f;
        const auto expected = Tracer(world).closest(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (expected[i].primitive == TRIAD_NONE) continue;
            ++found;
            misses += hits[i].primitive != expected[i].primitive;
        }
    }
    EXPECT_EQ(misses, 0u);
    EXPECT_GT(found, 700000u);
}

// C3
TEST(TraversalRobust, a_ray_never_hits_again_the_triangle_it_leaves) {
    Random random(4);
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        for (const double offset : {0.0, 1.0, 1e3, 1e6}) {
            // One triangle in front of a wall: any hit at or near the origin would be the triangle itself.
            std::size_t again = 0, spawned = 0;
            for (int batch = 0; batch < 20; ++batch) {
                World world;
                world.origin_reach = float(4 * scale + offset);
                const dvec3 centre = offset * random.direction();
                const vec3 a(centre + random.in_cube(scale)), b(centre + random.in_cube(scale)),
                    c(centre + random.in_cube(scale));
                world.add(0, a, b, c);
                world.add(0, b, a, c);  // its exact duplicate, wound the other way
                const Tracer tracer(world);
                std::vector<dev::Ray> rays;
                for (int i = 0; i < 1000; ++i) {
                    double u = random(), v = random();
                    if (u + v > 1) u = 1 - u, v = 1 - v;
                    dev::Ray r = ray(dvec3(a) + u * (dvec3(b) - dvec3(a)) + v * (dvec3(c) - dvec3(a)),
                                     random.direction());
                    r.skip_instance = 0;
                    r.skip_primitive = 0;
                    rays.push_back(r);
                }
                spawned += rays.size();
                again += rays.size() - count_misses(tracer.closest(rays));
                for (const std::uint32_t occluded : tracer.occluded(rays)) again += occluded;
            }
            EXPECT_EQ(again, 0u) << "of " << spawned << " at scale " << scale << ", offset " << offset;
        }
}

TEST(TraversalRobust, a_skipped_triangle_of_one_instance_is_still_seen_in_another) {
    World world;
    world.origin_reach = 4.0f;
    world.add(1, vec3(-1, -1, 0), vec3(1, -1, 0), vec3(0, 1, 0));
    world.placements.push_back({1, dmat4(1.0)});
    world.placements.push_back({1, glm::translate(dmat4(1.0), dvec3(0, 0, -2))});
    dev::Ray r = ray({0, 0, 0}, {0, 0, -1});
    r.skip_instance = 1;
    r.skip_primitive = 0;
    const auto hits = Tracer(world).closest({r});
    EXPECT_EQ(hits[0].instance, 2u);
    EXPECT_EQ(hits[0].t, 2.0f);
}

// C5
TEST(TraversalRobust, scaling_by_a_power_of_two_changes_no_bit) {
    const auto hits_at = [&](float scale) {
        World world;
        world.origin_reach = 4.0f * scale;
        world.add(0, shapes::terrain(4.0f, 0.7f, 24, 5), vec3(0.0f), scale);
        world.add(1, shapes::displaced_sphere(vec3(0.0f), 0.5f, 24, 12, 0.2f, 3.0f, 6), vec3(0.0f), scale);
        for (int i = 0; i < 3; ++i)
            world.placements.push_back(
                {1, glm::rotate(glm::translate(dmat4(1.0), double(scale) * dvec3(i - 1, 1.0, 0.3 * i)),
                                0.5 * i, dvec3(0, 1, 0))});
        Random random(7);
        std::vector<dev::Ray> rays;
        for (int i = 0; i < 5000; ++i) {
            const dvec3 origin = random.in_cube(2.0), direction = random.direction();
            rays.push_back(ray(double(scale) * dvec3(vec3(origin)),
                               i % 16 ? direction : dvec3(0, i % 32 ? -1 : 1, 0),
                               i % 5 ? float(infinity) : 1.5f * scale));
        }
        return Tracer(world).closest(rays);
    };
    const auto base = hits_at(1.0f);
    EXPECT_GT(base.size() - count_misses(base), 1000u);
    for (int k = -20; k <= 20; ++k) {
        const auto scaled = hits_at(std::ldexp(1.0f, k));
        for (std::size_t i = 0; i < base.size(); ++i) expect_same(scaled[i], base[i], std::ldexp(1.0f, k), i);
    }
}

// C6
TEST(TraversalRobust, degenerate_triangles_change_nothing) {
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
    const auto expected = Tracer(clean).closest(rays), hits = Tracer(dirty).closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) expect_same(hits[i], expected[i], 1.0f, i);
}

TEST(TraversalRobust, a_sliver_blocks_no_ray_beside_it) {
    World world;
    world.origin_reach = 2.0f;
    world.add(0, vec3(-1, 0, 0), vec3(1, 1e-7f, 0), vec3(0, 0, 0));
    std::vector<dev::Ray> rays;
    Random random(10);
    for (int i = 0; i < 10000; ++i)
        rays.push_back(
            ray({random.between(-1, 1), random.between(0.001, 1) * (i % 2 ? 1 : -1), 1}, {0, 0, -1}));
    EXPECT_EQ(count_misses(Tracer(world).closest(rays)), rays.size());
}

// C7
TEST(TraversalRobust, of_coincident_triangles_the_lower_id_wins_in_any_order) {
    const Primitive wall = shapes::quad({-1, -1, 0.3f}, {2, 0, 0.1f}, {0, 2, 0}, 8, 8);
    const auto size = std::uint32_t(wall.triangles.size());
    Random random(11);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 20000; ++i)
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
        for (const dev::Hit& h : Tracer(world).closest(rays))
            if (h.primitive != TRIAD_NONE) {
                ASSERT_LT(h.primitive, size) << "order " << order;
                ++hit;
            }
        EXPECT_GT(hit, 10000u);
    }
}

TEST(TraversalRobust, of_coincident_instances_the_lower_id_wins) {
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
    for (const dev::Hit& h : Tracer(world).closest(rays))
        if (h.primitive != TRIAD_NONE) {
            ASSERT_EQ(h.instance, 1u);
            ++hit;
        }
    EXPECT_GT(hit, 200u);
}

TEST(TraversalRobust, a_thousand_triangles_in_one_place_are_all_kept) {
    // Equal boxes, different triangles: nothing to split by, and nothing to drop.
    World world;
    world.origin_reach = 2.0f;
    for (int i = 0; i < 1000; ++i)
        world.add(0, vec3(-1, -1, 0), vec3(1, 1, 1), vec3(-1 + i * 0.002f, 1, 0.5f));
    Random random(13);
    std::vector<dev::Ray> rays;
    for (int i = 0; i < 300; ++i) rays.push_back(ray(random.in_cube(2.0), random.direction()));
    const auto hits = Tracer(world).closest(rays);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Reference expected = brute_force(world, rays[i]);
        if (expected.margin < 1e-6 || expected.second_t - expected.t < 1e-5) continue;
        ++compared;
        EXPECT_EQ(hits[i].primitive, expected.primitive);
    }
    EXPECT_GT(compared, 100u);
}

}  // namespace
