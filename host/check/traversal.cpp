// What breaks ray tracers: shared edges, rays in planes, flat and tiny boxes, leaving a surface, scale. The
// thresholds are zero. Degenerate and coincident input: traversal_input.cpp.
#include "check/cases.h"
#include "check/hits.h"
#include "check/measurements.h"
#include "check/ray_caster.h"

namespace triad {
namespace {

using namespace traversal_case;

constexpr double infinity = std::numeric_limits<double>::infinity();

// C1
void watertight_edges(Check& check) {
    const std::size_t count = check.count(200000);
    for (const float offset : {0.0f, 1e2f, 1e4f}) {
        const vec3 centre(offset);
        World world;
        world.origin_reach = offset + 2.0f;
        const Primitive sphere = shapes::lat_long_sphere(centre, 1.0f, 64, 32);
        world.add(0, sphere);
        const RayCaster caster(check.device, world);
        Random random(1);
        std::vector<dev::Ray> rays;
        for (std::size_t i = 0; i < count; ++i) {
            const uvec3 t = sphere.triangles[random.below(sphere.triangles.size())];
            const unsigned corner = unsigned(random.below(3));
            const dvec3 a(sphere.positions[t[corner]]), b(sphere.positions[t[(corner + 1) % 3]]);
            const double along = i % 2 ? random() : 0.0;  // odd: on an edge, even: at a corner
            rays.push_back(ray_towards(dvec3(centre) + random.in_cube(0.4), a + along * (b - a)));
        }
        check.at_most(count_misses(caster.closest(rays)), 0, "rays of ", rays.size(), " missed at offset ",
                      offset);
        const auto occluded = caster.occluded(rays);
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
    check.at_most(count_misses(RayCaster(check.device, world).closest(rays)), 0, "rays missed");
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
    check.at_most(count_misses(RayCaster(check.device, world).closest(rays)), 0, "rays of ", rays.size(),
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
    const auto hits = RayCaster(check.device, world).closest(rays);
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
        const auto hits = RayCaster(check.device, world).closest(rays);
        world.origin_reach = 1e6f;
        const auto expected = RayCaster(check.device, world).closest(rays);
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
                const RayCaster caster(check.device, world);
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
                again += rays.size() - count_misses(caster.closest(rays));
                for (const std::uint32_t occluded : caster.occluded(rays)) again += occluded;
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
    const auto hits = RayCaster(check.device, world).closest({r});
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
        return RayCaster(check.device, world).closest(rays);
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

}  // namespace

void add_traversal(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {
                                  {"C1", "watertight edges", quick, watertight_edges},
                                  {"C1b", "watertight instances", standard, watertight_instance},
                                  {"C2", "rays in the planes of boxes", quick, rays_in_planes_of_boxes},
                                  {"C2a", "rays along axes from the planes of boxes", quick, rays_along_axes},
                                  {"C2b", "slab rounding at tiny and flat boxes", quick, slab_rounding},
                                  {"C3", "no ray hits the triangle it leaves", quick, no_self_intersection},
                                  {"C3b", "a skipped triangle is seen in another instance", quick,
                                   skip_is_of_one_instance},
                                  {"C5", "scaling rays by 2^k changes no bit", quick, scaling_changes_no_bit},
                              });
}

}  // namespace triad
