// Traversal against brute force in double precision: what is hit, where, and what is not.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "traversal_fixture.h"

using namespace triad;
using namespace triad::traversal_test;

namespace {

/// Compares every ray whose answer is not a matter of rounding; returns how many were compared.
std::size_t expect_reference(const World& world, const std::vector<dev::Ray>& rays, double size) {
    const Tracer tracer(world);
    const auto hits = tracer.closest(rays);
    const auto occluded = tracer.occluded(rays);
    std::size_t compared = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(occluded[i], hits[i].primitive != TRIAD_NONE ? 1u : 0u) << "ray " << i;
        const Reference expected = brute_force(world, rays[i]);
        if (expected.margin < 1e-4 || expected.second_t - expected.t < 1e-4 * size) continue;
        ++compared;
        if (hits[i].primitive != expected.primitive || hits[i].instance != expected.instance) {
            ++wrong;
            continue;
        }
        if (expected.primitive == TRIAD_NONE) continue;
        EXPECT_NEAR(hits[i].t, expected.t, 1e-4 * size) << "ray " << i;
        EXPECT_NEAR(hits[i].u, expected.u, 1e-2) << "ray " << i;
        EXPECT_NEAR(hits[i].v, expected.v, 1e-2) << "ray " << i;
    }
    EXPECT_EQ(wrong, 0u) << "of " << compared;
    return compared;
}

std::vector<dev::Ray> random_rays(std::size_t count, double reach, std::uint64_t seed) {
    Random random(seed);
    std::vector<dev::Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        dev::Ray r = ray(random.in_cube(reach), random.direction());
        if (i % 3 == 0) r.t_max = float(random.between(0.1, 1.0) * reach);
        rays.push_back(r);
    }
    return rays;
}

World soup(std::size_t count, double half, double size, std::uint64_t seed) {
    Random random(seed);
    World world;
    world.origin_reach = float(2 * half);
    for (std::size_t i = 0; i < count; ++i) {
        const dvec3 centre = random.in_cube(half);
        const auto corner = [&] { return vec3(centre + random.in_cube(size)); };
        const vec3 a = corner(), b = corner(), c = corner();
        world.add(0, a, b, c);
    }
    return world;
}

TEST(TraversalReference, agrees_on_random_triangles_of_every_count_around_the_leaf_size) {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 31u, 33u, 400u})
        EXPECT_GT(expect_reference(soup(count, 1.0, 0.6, count), random_rays(3000, 2.0, 7), 1.0), 2000u)
            << count;
}

TEST(TraversalReference, agrees_on_small_and_large_scales) {
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        const World world = soup(300, scale, 0.3 * scale, 11);
        EXPECT_GT(expect_reference(world, random_rays(3000, 2.0 * scale, 13), scale), 2000u) << scale;
    }
}

TEST(TraversalReference, hits_nothing_in_an_empty_world) {
    const Tracer tracer{World{}};
    const auto rays = random_rays(100, 1.0, 3);
    for (const dev::Hit& hit : tracer.closest(rays)) EXPECT_EQ(hit.primitive, TRIAD_NONE);
    for (const std::uint32_t occluded : tracer.occluded(rays)) EXPECT_EQ(occluded, 0u);
}

TEST(TraversalReference, agrees_with_instances_rotated_mirrored_squashed_and_scaled) {
    World world = soup(50, 3.0, 0.5, 17);
    world.origin_reach = 8.0f;
    world.add(1, shapes::displaced_sphere(vec3(0.0f), 1.0f, 12, 8, 0.2f, 2.0f, 3));
    world.add(2, shapes::torus(vec3(100.0f, 0.0f, 0.0f), 10.0f, 4.0f, 12, 8));
    Random random(19);
    for (int i = 0; i < 24; ++i) {
        dmat4 m = glm::translate(dmat4(1.0), random.in_cube(3.0));
        m = glm::rotate(m, random.between(0, 6.28), random.direction());
        const double scale = std::exp(random.between(-1.5, 0.2));
        m = glm::scale(m, scale * dvec3(i % 2 ? -1.0 : 1.0, i % 3 ? 1.0 : 0.2, 1.0));
        if (i % 4 == 3) {
            m = glm::scale(m, dvec3(0.08));
            m = glm::translate(m, dvec3(-100.0, 0.0, 0.0));
        }
        world.placements.push_back({std::size_t(i % 4 == 3 ? 2 : 1), m});
    }
    EXPECT_GT(expect_reference(world, random_rays(6000, 4.0, 23), 1.0), 4000u);
}

TEST(TraversalReference, agrees_when_an_instance_is_tiny_or_huge_in_its_own_space) {
    for (const double scale : {1e-5, 1e5}) {
        World world;
        world.origin_reach = 3.0f;
        world.add(1, shapes::displaced_sphere(vec3(0.0f), float(1.0 / scale), 16, 8, 0.3f, 2.0f, 5));
        world.placements.push_back({1, glm::scale(dmat4(1.0), dvec3(scale))});
        EXPECT_GT(expect_reference(world, random_rays(3000, 2.0, 29), 1.0), 2000u) << scale;
    }
}

TEST(TraversalReference, a_direction_that_is_not_unit_scales_t_alone) {
    const World world = soup(200, 1.0, 0.4, 31);
    const Tracer tracer(world);
    auto rays = random_rays(2000, 2.0, 37);
    for (dev::Ray& r : rays) r.t_max = std::numeric_limits<float>::infinity();
    const auto unit = tracer.closest(rays);
    for (dev::Ray& r : rays)
        for (float& d : r.direction) d *= 4.0f;
    const auto scaled = tracer.closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(scaled[i].primitive, unit[i].primitive);
        ASSERT_EQ(scaled[i].t * 4.0f, unit[i].t);
        ASSERT_EQ(scaled[i].u, unit[i].u);
    }
}

TEST(TraversalReference, t_max_is_the_last_t_that_counts) {
    World world;
    world.origin_reach = 1.0f;
    world.add(0, shapes::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 5, 5));
    const Tracer tracer(world);
    const std::vector<dev::Ray> rays{ray({0.1, 0.3, 1}, {0, 0, -1}, 1.0f),
                                     ray({0.1, 0.3, 1}, {0, 0, -1}, 0.99999994f),
                                     ray({0.1, 0.3, 0}, {0, 0, -1})};
    const auto hits = tracer.closest(rays);
    const auto occluded = tracer.occluded(rays);
    EXPECT_EQ(hits[0].t, 1.0f);
    EXPECT_EQ(occluded[0], 1u);
    EXPECT_EQ(hits[1].primitive, TRIAD_NONE);
    EXPECT_EQ(occluded[1], 0u);
    EXPECT_EQ(hits[2].primitive, TRIAD_NONE) << "t = 0 does not count";
}

TEST(TraversalReference, a_program_without_instances_gives_the_same_bits) {
    const World world = soup(500, 1.0, 0.3, 41);
    const auto rays = random_rays(4000, 2.0, 43);
    const auto general = Tracer(world).closest(rays),
               special = Tracer(world, {{"TRIAD_INSTANCES", "0"}}).closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(general[i].primitive, special[i].primitive);
        ASSERT_EQ(general[i].t, special[i].t);
        ASSERT_EQ(general[i].u, special[i].u);
        ASSERT_EQ(general[i].v, special[i].v);
    }
}

}  // namespace
