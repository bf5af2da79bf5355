/* Stage `connect`: a vertex chooses a light, and asks for a ray to it. */
#ifndef TRIAD_PATH_CONNECT_H
#define TRIAD_PATH_CONNECT_H

#include "path/bsdf.h"
#include "path/gather.h"
#include "shading/light.h"

/* Light that arrives if nothing is in the way of the ray. */
typedef struct PendingLight {
    Ray ray;
#if TRIAD_ALPHA_TEST
    uint name; /* of the ray: coverage_ray() */
#endif
    Colour worth; /* what it adds to the radiance of the path; of a map: times its radiance and weight */
#if TRIAD_ENVIRONMENT_MAP
    /* of a map, which is looked up when the ray has got through */
    float inverse_pdf; /* of light sampling, without the map's own density; 0: no map */
    float bsdf_pdf;    /* of the path's direction */
    Vec2 uv;
    uint flags; /* of its Light */
#endif
#if TRIAD_RECORD
    uint light; /* which Light it is */
#endif
} PendingLight;

/* Whether what lies in that direction is alpha, however it is found: the camera sees it through the surface.
 */
TRIAD_FUNCTION int connect_is_alpha(const Scene* scene, const PathState* path, const VertexBsdf* v,
                                    const LightSample* light, float side) {
#if TRIAD_ENVIRONMENT_MAP
    /* inverse_pdf 0: no map */
#if TRIAD_DIFFUSE_TRANSMISSION
    if (v->bsdf.base.p_through > 0.0f) return 0; /* scattered, not seen: BSDF_CLOUDED */
#endif
    return (path->traits & PATH_STRAIGHT) && side < 0.0f && scene->frame->transparent && light->distant &&
           light->inverse_pdf > 0.0f;
#else
    (void)scene, (void)path, (void)v, (void)light, (void)side;
    return 0;
#endif
}

/* What the body between the vertex and the light lets through. */
TRIAD_FUNCTION Colour connect_transmittance(const Scene* scene, const PathState* path, const Vertex* vertex,
                                            const LightSample* light, float side) {
#if TRIAD_TRANSMISSION
    const uint body = side < 0.0f ? vertex->around.beyond.x : vertex->around.here.x;
    if (body != TRIAD_NONE && !light->distant)
        return path_transmittance(&path->colours, scene->materials + body,
                                  vec3_length(vec3_sub(light->target, vertex->surface.position)));
#else
    (void)scene, (void)path, (void)vertex, (void)light, (void)side;
#endif
    return colour_splat(1.0f);
}

TRIAD_FUNCTION LightPick path_pick(const Scene* scene, const PathState* path, const Vertex* vertex,
                                   const SamplerBlock* u) {
    const LightPick none = {TRIAD_NONE, 0.0f, 0.0f};
    if (scene->frame->light_count == 0u || path_ends_in_map(scene, path)) return none;
    return light_pick(scene, path_receiver(path, vertex->surface.position), u->set[2].x);
}

/* pick: path_pick()'s. 0: no light can be seen from here. */
TRIAD_FUNCTION int path_connect(const Scene* scene, const PathState* path, const Vertex* vertex,
                                const VertexBsdf* v, const SamplerBlock* u, LightPick pick,
                                PendingLight* pending) {
    const Surface* s = &vertex->surface;
    LightSample light;
    if (!bsdf_has_smooth(&v->bsdf) ||
        !light_sample_picked(scene, pick, path_receiver(path, s->position), u->set[2].y, &light))
        return 0;
    const float side = vec3_dot(light.direction, vertex->ng);
    const Vec3 wi = frame_to_local(&v->frame, light.direction);
    /* the shading normal must not move light through the surface */
    if (!(side * wi.z > 0.0f) || connect_is_alpha(scene, path, v, &light, side)) return 0;

    float bsdf_pdf;
    const Colour reflected = colour_mul(path->throughput, path_eval(scene, path, vertex, v, wi, &bsdf_pdf));
    const Colour direct = colour_mul(reflected, connect_transmittance(scene, path, vertex, &light, side));
    const Colour radiance = path_light(scene, &path->colours, light.flags, light.weight);
    /* the colour of a light with a spectrum is signed */
    if (!(colour_largest(colour_abs(colour_mul(direct, radiance))) > 0.0f)) return 0;
    if (path_map_use(scene) == PHOTON_MAP_VISUALISED) bsdf_pdf = 0.0f; /* no path goes there */

    const Vec3 away = side > 0.0f ? vertex->ng : vec3_negate(vertex->ng);
    pending->ray = light.distant ? vertex_spawn(s, away, &vertex->hit, light.direction)
                                 : vertex_spawn_to(s, away, &vertex->hit, light.target);
#if TRIAD_ALPHA_TEST
    pending->name = path_ray_name(path) + 1u;
#endif
    pending->worth =
        colour_mul(direct, colour_scale(radiance, power_heuristic(bsdf_pdf * light.inverse_pdf)));
#if TRIAD_ENVIRONMENT_MAP
    pending->inverse_pdf = 0.0f;
    if (light.distant && light.inverse_pdf > 0.0f) {
        pending->worth = direct;
        pending->inverse_pdf = light.inverse_pdf;
        pending->bsdf_pdf = bsdf_pdf;
        pending->uv = light.uv;
        pending->flags = light.flags;
    }
#endif
#if TRIAD_RECORD
    pending->light = light.light;
#endif
    return 1;
}

/* Nothing is in the way of the ray. */
TRIAD_FUNCTION void path_arrive(const Scene* scene, PathState* path, const PendingLight* pending,
                                Tally* tally) {
    Colour direct = pending->worth;
#if TRIAD_ENVIRONMENT_MAP
    if (pending->inverse_pdf > 0.0f) {
        LightSample light;
        light.distant = 1;
        light.inverse_pdf = pending->inverse_pdf;
        light.uv = pending->uv;
        if (!light_complete(scene, &light)) return;
        const Colour radiance = path_light(scene, &path->colours, pending->flags, light.weight);
        const float weight = map_heuristic(pending->bsdf_pdf * light.inverse_pdf);
        direct = colour_mul(direct, colour_scale(radiance, weight));
    }
#else
    (void)scene;
#endif
    path->radiance = colour_add(path->radiance, direct);
    record_direct(tally, pending->light, path, direct);
}

#endif
