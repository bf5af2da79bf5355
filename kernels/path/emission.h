/* Stages `miss` and `emission`: the light that a path runs into. */
#ifndef TRIAD_PATH_EMISSION_H
#define TRIAD_PATH_EMISSION_H

#include "path/gather.h"
#include "path/surface.h"
#include "shading/light.h"

TRIAD_FUNCTION void path_finds(PathState* path, Colour found, Tally* tally) {
    path->radiance = colour_add(path->radiance, found);
    record_found(tally, path, found);
}

/* The path leaves the scene: it finds the environment, or nothing at all, which is alpha. */
TRIAD_FUNCTION void path_miss(const Scene* scene, PathState* path, const Hit* hit, Tally* tally) {
    global const Frame* frame = scene->frame;
    const Vec3 direction = path_direction(path);
    (void)hit;
    record_vertex(tally, path, direction, hit, TRIAD_NONE);
    record_end(tally, PATH_LEFT_SCENE);
    if ((path->traits & PATH_STRAIGHT) && frame->transparent) {
        /* weights above 1 make up for paths that ended in a surface: no clamping */
        path->alpha -= path_share(&path->colours) * colour_average(path->throughput) / path_body_scale(path);
        return;
    }
    const uint facing = path->pdf > 0.0f ? path_receiver(path, VEC3_OF(path->ray.origin)).facing : 0u;
    float light_pdf;
    const Colour sky =
        path_colour(&path->colours, environment_radiance(scene, direction, facing, &light_pdf));
    float weight = path->pdf > 0.0f ? map_heuristic(light_pdf / path->pdf) : 1.0f;
    if (frame->environment.photons && path_leaves_to_photons(scene, path)) weight = 0.0f;
    path_finds(path, colour_scale(colour_mul(path->throughput, sky), weight), tally);
}

/* An unlit surface shows its colour to the camera, directly or in mirrors, and is black to all else; 1: it is
 * one, and the path ends. */
TRIAD_FUNCTION int path_unlit(const Scene* scene, PathState* path, const Vertex* vertex, Tally* tally) {
#if TRIAD_UNLIT
    const Surface* s = &vertex->surface;
    if (!(scene->materials[s->material].flags & MATERIAL_UNLIT)) return 0;
    const Colour shown = colour_mul(path->throughput, path_colour(&path->colours, s->base_colour));
    path_finds(path, path->traits & PATH_SPECULAR ? shown : colour_splat(0.0f), tally);
    record_end(tally, PATH_UNLIT);
    return 1;
#else
    (void)scene, (void)path, (void)vertex, (void)tally;
    return 0;
#endif
}

/* The light that the edge has hit, and light_found() of it for the vertex at its start. */
typedef struct LightHit {
    uint light; /* TRIAD_NONE: none */
    float extent;
} LightHit;

TRIAD_FUNCTION LightHit path_lit(const Scene* scene, const PathState* path, const Hit* hit) {
    LightHit lit = {TRIAD_NONE, 0.0f};
#if TRIAD_TRIANGLE_LIGHTS
    global const Geometry* geometry = scene->geometries + scene->triangles[hit->primitive].geometry;
    if (geometry->first_light != TRIAD_NONE && !path_is_back(path)) {
        lit.light = geometry->first_light + hit->primitive - geometry->first_triangle;
        if (path->pdf > 0.0f)
            lit.extent = light_found(scene, path_receiver(path, VEC3_OF(path->ray.origin)), lit.light);
    }
#else
    (void)scene, (void)path, (void)hit;
#endif
    return lit;
}

/* What the surface emits along the edge; lit: path_lit()'s. */
TRIAD_FUNCTION void path_emission(const Scene* scene, PathState* path, const Vertex* vertex, LightHit lit,
                                  Tally* tally) {
#if TRIAD_TRIANGLE_LIGHTS
    const Surface* s = &vertex->surface;
    global const Material* material = scene->materials + s->material;
    if (lit.light == TRIAD_NONE || (vertex->back && !(material->flags & MATERIAL_DOUBLE_SIDED))) return;
    global const Light* found = scene->lights + lit.light;
    float weight = 1.0f;
    if ((found->flags & LIGHT_PHOTONS) && path_leaves_to_photons(scene, path)) weight = 0.0f;
    if (path->pdf > 0.0f)
        weight = power_heuristic(
            1.0f / (path->pdf * light_triangle_inverse_pdf(lit.extent, 1.0f / (vertex->hit.t * vertex->hit.t),
                                                           vec3_dot(vertex->ng, vertex->wo))));
#if TRIAD_CLEARCOAT
    weight *= coat_emission(scene, s, vertex->wo, vertex->ng, vertex->back);
#endif
    const Colour radiance = path_light(scene, &path->colours, found->flags,
                                       surface_emission(scene, material, s->uv0, s->uv1, surface_covered(s)));
    path_finds(path, colour_scale(colour_mul(path->throughput, radiance), weight), tally);
#else
    (void)scene, (void)path, (void)vertex, (void)lit, (void)tally;
#endif
}

#endif
