// Traversal against brute force in double precision: what is hit, where, and what is not.
#include <cstring>

#include "check/cases.h"
#include "check/measurements.h"
#include "check/ray_caster.h"

namespace triad {
namespace {

using namespace traversal_case;

/// Compares every ray whose answer is not a matter of rounding; returns how many were compared.
std::size_t expect_reference(Check& check, const World& world, const std::vector<dev::Ray>& rays,
                             double size) {
    const RayCaster caster(check.device, world);
    const auto hits = caster.closest(rays);
    const auto occluded = caster.occluded(rays);
    std::size_t compared = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.equal(occluded[i], hits[i].primitive != TRIAD_NONE ? 1u : 0u, "occlusion of ray ", i);
        const Reference expected = brute_force(world, rays[i]);
        if (expected.margin < 1e-4 || expected.second_t - expected.t < 1e-4 * size) continue;
        ++compared;
        if (hits[i].primitive != expected.primitive || hits[i].instance != expected.instance) {
            ++wrong;
            continue;
        }
        if (expected.primitive == TRIAD_NONE) continue;
        check.near(hits[i].t, expected.t, 1e-4 * size, "t of ray ", i);
        check.near(hits[i].u, expected.u, 1e-2, "u of ray ", i);
        check.near(hits[i].v, expected.v, 1e-2, "v of ray ", i);
    }
    check.at_most(double(wrong), 0, "wrong hits of ", compared);
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

void agrees_on_random_triangles(Check& check) {
    const std::size_t rays = check.count(3000);
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 31u, 33u, 400u})
        check.above(expect_reference(check, soup(count, 1.0, 0.6, count), random_rays(rays, 2.0, 7), 1.0),
                    2 * rays / 3, "rays compared");
}

void agrees_at_every_scale(Check& check) {
    const std::size_t rays = check.count(3000);
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        const World world = soup(300, scale, 0.3 * scale, 11);
        check.above(expect_reference(check, world, random_rays(rays, 2.0 * scale, 13), scale), 2 * rays / 3,
                    "rays compared");
    }
}

void empty_world(Check& check) {
    const RayCaster caster(check.device, World{});
    const auto rays = random_rays(100, 1.0, 3);
    for (const dev::Hit& hit : caster.closest(rays)) check.equal(hit.primitive, TRIAD_NONE, "primitive");
    for (const std::uint32_t occluded : caster.occluded(rays)) check.equal(occluded, 0u, "occlusion");
}

void agrees_with_instances(Check& check) {
    const std::size_t rays = check.count(6000);
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
    check.above(expect_reference(check, world, random_rays(rays, 4.0, 23), 1.0), 2 * rays / 3,
                "rays compared");
}

void agrees_with_tiny_and_huge_instances(Check& check) {
    const std::size_t rays = check.count(3000);
    for (const double scale : {1e-5, 1e5}) {
        World world;
        world.origin_reach = 3.0f;
        world.add(1, shapes::displaced_sphere(vec3(0.0f), float(1.0 / scale), 16, 8, 0.3f, 2.0f, 5));
        world.placements.push_back({1, glm::scale(dmat4(1.0), dvec3(scale))});
        check.above(expect_reference(check, world, random_rays(rays, 2.0, 29), 1.0), 2 * rays / 3,
                    "rays compared");
    }
}

void length_of_direction_scales_t(Check& check) {
    const World world = soup(200, 1.0, 0.4, 31);
    const RayCaster caster(check.device, world);
    auto rays = random_rays(2000, 2.0, 37);
    for (dev::Ray& r : rays) r.t_max = std::numeric_limits<float>::infinity();
    const auto unit = caster.closest(rays);
    for (dev::Ray& r : rays)
        for (float& d : r.direction) d *= 4.0f;
    const auto scaled = caster.closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.equal(scaled[i].primitive, unit[i].primitive, "primitive");
        check.equal(scaled[i].t * 4.0f, unit[i].t, "t");
        check.equal(scaled[i].u, unit[i].u, "u");
    }
}

void t_max_counts(Check& check) {
    World world;
    world.origin_reach = 1.0f;
    world.add(0, shapes::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 5, 5));
    const RayCaster caster(check.device, world);
    const std::vector<dev::Ray> rays{ray({0.1, 0.3, 1}, {0, 0, -1}, 1.0f),
                                     ray({0.1, 0.3, 1}, {0, 0, -1}, 0.99999994f),
                                     ray({0.1, 0.3, 0}, {0, 0, -1})};
    const auto hits = caster.closest(rays);
    const auto occluded = caster.occluded(rays);
    check.equal(hits[0].t, 1.0f, "t at t_max");
    check.equal(occluded[0], 1u, "occlusion at t_max");
    check.equal(hits[1].primitive, TRIAD_NONE, "hit beyond t_max");
    check.equal(occluded[1], 0u, "occlusion beyond t_max");
    check.equal(hits[2].primitive, TRIAD_NONE, "hit at t = 0, which does not count,");
}

void same_bits_without_instances(Check& check) {
    const World world = soup(500, 1.0, 0.3, 41);
    const auto rays = random_rays(4000, 2.0, 43);
    const auto general = RayCaster(check.device, world).closest(rays),
               special = RayCaster(check.device, world, {{"TRIAD_INSTANCES", "0"}}).closest(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.equal(general[i].primitive, special[i].primitive, "primitive");
        check.equal(general[i].t, special[i].t, "t");
        check.equal(general[i].u, special[i].u, "u");
        check.equal(general[i].v, special[i].v, "v");
    }
}

/// Spheres in the world and placed, and soup between them: trees of some depth, and boxes that overlap.
World crowded_world() {
    World world = soup(2000, 3.0, 0.3, 47);
    world.origin_reach = 8.0f;
    world.add(0, shapes::displaced_sphere(vec3(0.0f), 1.0f, 60, 30, 0.3f, 3.0f, 2));
    world.add(1, shapes::displaced_sphere(vec3(0.0f), 1.0f, 30, 20, 0.2f, 2.0f, 3));
    Random random(53);
    for (int i = 0; i < 40; ++i) {
        const dmat4 place = glm::translate(dmat4(1.0), random.in_cube(3.0));
        world.placements.push_back(
            {1, glm::scale(glm::rotate(place, random.between(0, 6.28), random.direction()),
                           dvec3(random.between(0.1, 1), 0.4, 0.7))});
    }
    return world;
}

// The trees are walked in other orders, through other boxes, by other code.
void same_hits_in_every_format(Check& check) {
    const World world = crowded_world();
    auto rays = random_rays(check.count(40000), 4.0, 59);
    for (std::size_t i = 0; i < rays.size(); i += 5)
        rays[i].skip_instance = std::uint32_t(i % 7), rays[i].skip_primitive = std::uint32_t(i % 3000);
    std::vector<std::vector<dev::Hit>> hits;
    std::vector<std::vector<std::uint32_t>> occluded;
    for (const BvhFormat format : all_bvh_formats) {
        const WithFormat walks(check.device, format);
        const RayCaster caster(check.device, world);
        hits.push_back(caster.closest(rays));
        occluded.push_back(caster.occluded(rays));
    }
    std::size_t hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.holds(std::memcmp(&hits[0][i], &hits[1][i], sizeof(dev::Hit)) == 0, "hit of ray ", i,
                    " differs");
        check.equal(occluded[1][i], occluded[0][i], "occlusion of ray ", i);
        hit += occluded[0][i];
    }
    check.above(hit, rays.size() / 5, "hits");
}

/// PACKET_RAYS neighbours from about one point to about another, or, at `apart` 1, from anywhere to anywhere.
void add_packet(std::vector<dev::Ray>& rays, Random& random, bool from_one_point, double apart) {
    dvec3 from = random.in_cube(4.0), to = random.in_cube(3.0);
    // along an axis or a diagonal: signs and the largest component differ within the packet
    if (random() < 0.3) to[int(random.below(3))] = from[int(random.below(3))];
    if (random() < 0.3) to = from + (random() < 0.5 ? 1.0 : -1.0) * dvec3(to.x - from.x);
    for (unsigned i = 0; i < PACKET_RAYS; ++i) {
        const dvec3 origin = from_one_point ? from : from + random.in_cube(4.0 * apart);
        rays.push_back(ray_towards(origin, to + random.in_cube(6.0 * apart)));
        if (random() < 0.1) rays.back().t_max = float(random.between(0.1, 4.0));
    }
}

void expect_packets(Check& check, const RayCaster& caster, const std::vector<dev::Ray>& rays) {
    const auto alone = caster.closest(rays), together = caster.packets(rays);
    std::size_t hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check.holds(std::memcmp(&alone[i], &together[i], sizeof(dev::Hit)) == 0, "hit of ray ", i,
                    " differs");
        hit += alone[i].primitive != TRIAD_NONE;
    }
    check.above(hit, rays.size() / 3, "hits");
}

// Boxes are met by bounds on all rays, triangles are left out that no ray can hit, and the last packet is
// short.
void packets_hit_what_rays_hit(Check& check) {
    const WithFormat walks(check.device, BvhFormat::bvh8);
    const RayCaster caster(check.device, crowded_world(), {{"TRIAD_PACKETS", "1"}});
    std::vector<dev::Ray> rays;
    Random random(61);
    for (const double apart : {0.0, 1e-6, 1e-3, 0.01, 0.1, 1.0})
        for (std::size_t packet = 0; packet < check.count(600, 8); ++packet)
            add_packet(rays, random, packet % 3 != 0, apart);
    rays.resize(rays.size() - 3);
    expect_packets(check, caster, rays);
    expect_packets(
        check,
        RayCaster(check.device, soup(2000, 3.0, 0.5, 67), {{"TRIAD_PACKETS", "1"}, {"TRIAD_INSTANCES", "0"}}),
        rays);
}

}  // namespace

void add_traversal_reference(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"T2", "rays against brute force", quick, agrees_on_random_triangles},
                     {"T3", "rays against brute force at every scale", standard, agrees_at_every_scale},
                     {"T4", "instances against brute force", quick, agrees_with_instances},
                     {"T5", "tiny and huge instances against brute force", standard,
                      agrees_with_tiny_and_huge_instances},
                     {"T6", "an empty world", standard, empty_world},
                     {"T7", "length of the direction scales t alone", standard, length_of_direction_scales_t},
                     {"T8", "t_max is the last t that counts", quick, t_max_counts},
                     {"T9", "same bits without instances", standard, same_bits_without_instances},
                     {"T10", "same hits in every format of nodes", quick, same_hits_in_every_format},
                     {"T11", "packets hit what their rays hit alone", quick, packets_hit_what_rays_hit},
                 });
}

}  // namespace triad
