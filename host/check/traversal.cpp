// What breaks ray tracers: shared edges, rays in planes, flat and tiny boxes, leaving a surface, scale,
// degenerate and coincident input. The thresholds are zero.
#include "check/cases.h"
#include "check/measurements.h"
#include "check/tracer.h"

namespace triad {
namespace {

using namespace traversal_case;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t count_misses(const std::vector<dev::Hit>& hits) {
    return std::size_t(
        std::count_if(hits.begin(), hits.end(), [](const dev::Hit& h) { return h.primitive == TRIAD_NONE; }));
}

void expect_same(Check& check, const dev::Hit& a, const dev::Hit& b, float t_scale, std::size_t i) {
    check.equal(a.primitive, b.primitive, "primitive of ray ", i);
    check.equal(a.instance, b.instance, "instance of ray ", i);
    if (a.primitive == TRIAD_NONE) return;
    check.equal(a.t, b.t * t_scale, "t of ray ", i);
    check.equal(a.u, b.u, "u of ray ", i);
    check.equal(a.v, b.v, "v of ray ", i);
}

// C1
void watertight_edges(Check& check) {
    const std::size_t count = check.count(200000);
    for (const float offset : {0.0f, 1e2f, 1e4f}) {
        const vec3 centre(offset);
        World world;
        world.origin_reach = offset + 2.0f;
        const Primitive sphere = shapes::lat_long_sphere(centre, 1.0f, 64, 32);
        world.add(0, sphere);
        const Tracer tracer(check.device, world);
        Random random(1);
        std::vector<dev::Ray> rays;
        for (std::size_t i = 0; i < count; ++i) {
            const uvec3 t = sphere.triangles[random.below(sphere.triangles.size())];
            const unsigned corner = unsigned(random.below(3));
            const dvec3 a(sphere.positions[t[corner]]), b(sphere.positions[t[(corner + 1) % 3]]);
            const double along = i % 2 ? random() : 0.0;  // odd: on an edge, even: at a corner
            rays.push_back(ray_towards(dvec3(centre) + random.in_cube(0.4), a + along * (b - a)));
        }
        check.at_most(count_misses(tracer.closest(rays)), 0, "rays of ", rays.size(), " missed at offset ",
                      offset);
        const auto occluded = tracer.occluded(rays);
        check.at_most(std::count(occluded.begin(), occluded.end(), 0u), 0, "shadow rays missed at offset ",
                      offset);
    }
}

void watertight_instance(Check& check) {
    World world;
    world.origin_reach = 60.0f;
    const Primitive sphere = shapes::lat_long_sphere(vec3(0.0f), 1.0f, 48, 24);
    world.add(1, sphere);
    const dmat4 to_world =
        glm::scale(glm::rotate(glm::translate(dmat4(1.0), dvec3(31, -47, 22)), 0.7, dvec3(.6, .8, 0)),
                   dvec3(-3.0, 0.05, 1.0));
    world.placements.push_back({1, to_world});
    Random random(2);
    const std::size_t count = check.count(100000);
    std::vector<dev::Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const uvec3 t = sphere.triangles[random.below(sphere.triangles.size())];
        const dvec3 a(sphere.positions[t.x]), b(sphere.positions[t.y]);
        rays.push_back(ray_towards(transform_point(to_world, random.in_cube(0.4)),
                                   transform_point(to_world, a + random() * (b - a))));
    }
    check.at_most(count_misses(Tracer(check.device, world).closest(rays)), 0, "rays missed");
}

// C2
void rays_in_planes_of_boxes(Check& check) {
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
    check.at_most(count_misses(Tracer(check.device, world).closest(rays)), 0, "rays of ", rays.size(),
                  " missed");
}

void rays_along_axes(Check& check) {
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
    const auto hits = Tracer(check.device, world).closest(rays);
    check.at_most(count_misses(hits), 0, "rays missed");
    for (const dev::Hit& hit : hits) check.equal(hit.t, 1.0f, "t");
}

// C2b
void slab_rounding(Check& check) {
    // The same rays and triangles with boxes padded by whole units: what the triangle test alone finds.
    Random random(3);
    const std::size_t count = check.count(100000);
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
        for (int i = 0; i < int(count); ++i) {
            const auto& t = world.meshes[0][random.below(500)].corner;
            double a = random(), b = random();
            if (a + b > 1) a = 1 - a, b = 1 - b;
            if (i % 8 == 0) a = 0;
            const dvec3 p = dvec3(t[0]) + a * dvec3(t[1] - t[0]) + b * dvec3(t[2] - t[0]);
            rays.push_back(ray_towards(random.in_cube(10.0), p));
        }
        const auto hits = Tracer(check.device, world).closest(rays);
        world.origin_reach = 1e6f;
        const auto expected = Tracer(check.device, world).closest(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (expected[i].primitive == TRIAD_NONE) continue;
            ++found;
            misses += hits[i].primitive != expected[i].primitive;
        }
    }
    check.at_most(double(misses), 0, "hits lost, of ", found);
    check.above(found, 7 * count, "hits found");
}

// C3
void no_self_intersection(Check& check) {
    Random random(4);
    const int batches = int(check.count(20, 1)), rays_each = int(check.count(1000, 250));
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        for (const double offset : {0.0, 1.0, 1e3, 1e6}) {
            // One triangle in front of a wall: any hit at or near the origin would be the triangle itself.
            std::size_t again = 0, spawned = 0;
            for (int batch = 0; batch < batches; ++batch) {
                World world;
                world.origin_reach = float(4 * scale + offset);
                const dvec3 centre = offset * random.direction();
                const vec3 a(centre + random.in_cube(scale)), b(centre + random.in_cube(scale)),
                    c(centre + random.in_cube(scale));
                world.add(0, a, b, c);
                world.add(0, b, a, c);  // its exact duplicate, wound the other way
                const Tracer tracer(check.device, world);
                std::vector<dev::Ray> rays;
                for (int i = 0; i < rays_each; ++i) {
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
            check.at_most(double(again), 0, "re-hits of ", spawned, " at scale ", scale, ", offset ", offset);
        }
}

void skip_is_of_one_instance(Check& check) {
    World world;
    world.origin_reach = 4.0f;
    world.add(1, vec3(-1, -1, 0), vec3(1, -1, 0), vec3(0, 1, 0));
    world.placements.push_back({1, dmat4(1.0)});
    world.placements.push_back({1, glm::translate(dmat4(1.0), dvec3(0, 0, -2))});
    dev::Ray r = ray({0, 0, 0}, {0, 0, -1});
    r.skip_instance = 1;
    r.skip_primitive = 0;
    const auto hits = Tracer(check.device, world).closest({r});
    check.equal(hits[0].instance, 2u, "instance");
    check.equal(hits[0].t, 2.0f, "t");
}

// C5
void scaling_changes_no_bit(Check& check) {
    const int count = int(check.count(5000, 500));
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
        for (int i = 0; i < count; ++i) {
            const dvec3 origin = random.in_cube(2.0), direction = random.direction();
            rays.push_back(ray(double(scale) * dvec3(vec3(origin)),
                               i % 16 ? direction : dvec3(0, i % 32 ? -1 : 1, 0),
                               i % 5 ? float(infinity) : 1.5f * scale));
        }
        return Tracer(check.device, world).closest(rays);
    };
    const auto base = hits_at(1.0f);
    check.above(base.size() - count_misses(base), count / 5, "hits");
    const int step = check.level >= CheckLevel::standard ? 1 : 10;
    for (int k = -20; k <= 20; k += step) {
        const auto scaled = hits_at(std::ldexp(1.0f, k));
        for (std::size_t i = 0; i < base.size(); ++i)
            expect_same(check, scaled[i], base[i], std::ldexp(1.0f, k), i);
    }
}

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
    const auto expected = Tracer(check.device, clean).closest(rays),
               hits = Tracer(check.device, dirty).closest(rays);
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
    check.equal(count_misses(Tracer(check.device, world).closest(rays)), rays.size(), "misses of a sliver");
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
        for (const dev::Hit& h : Tracer(check.device, world).closest(rays))
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
    for (const dev::Hit& h : Tracer(check.device, world).closest(rays))
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
    const auto hits = Tracer(check.device, world).closest(rays);
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

void add_traversal(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"C1", "watertight edges", quick, watertight_edges},
            {"C1b", "watertight instances", standard, watertight_instance},
            {"C2", "rays in the planes of boxes", quick, rays_in_planes_of_boxes},
            {"C2a", "rays along axes from the planes of boxes", quick, rays_along_axes},
            {"C2b", "slab rounding at tiny and flat boxes", quick, slab_rounding},
            {"C3", "no ray hits the triangle it leaves", quick, no_self_intersection},
            {"C3b", "a skipped triangle is seen in another instance", quick, skip_is_of_one_instance},
            {"C5", "scaling rays by 2^k changes no bit", quick, scaling_changes_no_bit},
            {"C6", "degenerate triangles change nothing", quick, degenerate_triangles},
            {"C6b", "a sliver blocks no ray beside it", standard, sliver_blocks_no_ray},
            {"C7", "of coincident triangles the lower id", quick, coincident_triangles},
            {"C7b", "of coincident instances the lower id", standard, coincident_instances},
            {"T1", "a thousand triangles in one place", full, thousand_in_one_place},
        });
}

}  // namespace triad
