/* Light tracing (Dutre 1993): a photon shows the camera what it leaves at a surface. */
#ifndef TRIAD_PATH_PHOTON_SPLAT_H
#define TRIAD_PATH_PHOTON_SPLAT_H

#include "photon/splat.h"

#include "path/rays.h"
#include "path/surface.h"

/* A piece of the film that photons add to. */
typedef struct SplatFilm {
    volatile global uint* sums; /* pairs of uints */
    volatile global uint* half_sums;
    global const uint* tiles; /* of the crop: 1 for those that the photon counts for */
    uint first_pixel, pixels; /* of the crop, that the piece holds */
    uint half_index;          /* of the film, that the photon belongs to */
} SplatFilm;

/* A point of the film in the piece. */
typedef struct SplatPlace {
    size_t pixel; /* of the piece */
    size_t bin;
} SplatPlace;

/* x, y: of the film, in pixels of the full picture. 0: the photon does not count there. */
TRIAD_FUNCTION int splat_place(const SplatFilm* film, global const Frame* frame, float x, float y,
                               SplatPlace* place) {
    x -= (float)frame->crop[0], y -= (float)frame->crop[1];
    if (!(x >= 0.0f && y >= 0.0f && x < (float)frame->crop[2] && y < (float)frame->crop[3])) return 0;
    const uint px = math_min_uint((uint)x, frame->crop[2] - 1u),
               py = math_min_uint((uint)y, frame->crop[3] - 1u);
    const uint across = (frame->crop[2] + FILM_TILE - 1u) / FILM_TILE;
    if (film->tiles[py / FILM_TILE * across + px / FILM_TILE] == 0u) return 0;
    const uint bx = math_min_uint((uint)((x - (float)px) * (float)frame->bins[0]), frame->bins[0] - 1u),
               by = math_min_uint((uint)((y - (float)py) * (float)frame->bins[1]), frame->bins[1] - 1u);
    place->pixel = (size_t)py * frame->crop[2] + px - film->first_pixel;
    place->bin = place->pixel * (frame->bins[0] * frame->bins[1]) + by * frame->bins[0] + bx;
    return place->pixel < film->pixels; /* else of another piece, on either side */
}

TRIAD_FUNCTION void splat_colour(const SplatFilm* film, const SplatPlace* place, float quanta, Vec3 value,
                                 Tally* tally) {
    if (!film_is_finite(vec3_with(value, 0.0f))) {
        ++tally->not_finite;
        return;
    }
    const float channels[3] = {value.x, value.y, value.z};
    for (uint c = 0u; c < 3u; ++c) {
        const long fixed = film_fixed(channels[c], quanta, &tally->saturated);
        splat_add(film->sums + 2u * (place->bin * FILM_CHANNELS + c), fixed);
        if (film->half_index == 0u) splat_add(film->half_sums + 2u * (place->pixel * 3u + c), fixed);
    }
}

/* What a surface sends from wi towards `out`, of flux per area across wi: f |wi . ns| / |wi . ng| (the
 * adjoint BSDF of Veach 1997, section 5.3.2), evaluated as a path from the camera would, which comes from
 * `out`. */
TRIAD_FUNCTION Vec3 photon_bsdf(const Scene* scene, const Surface* s, Vec3 wi, Vec3 out,
                                const VertexBodies* around, float wavelength) {
    const float facing = vec3_dot(out, s->geometric_normal), lit = vec3_dot(wi, s->geometric_normal);
    if (facing == 0.0f || lit == 0.0f) return vec3_splat(0.0f);
    const int back = facing < 0.0f, through = facing * lit < 0.0f;
    const Vec3 ng = back ? vec3_negate(s->geometric_normal) : s->geometric_normal;
    const VertexBsdf v = vertex_bsdf(scene, s, out, ng, back, through ? around->beyond : around->here,
                                     through ? around->here : around->beyond, wavelength);
    if (!bsdf_has_smooth(&v.bsdf)) return vec3_splat(0.0f);
    const Vec3 wi_local = frame_to_local(&v.frame, wi);
    /* light must not go through by the shading normal */
    if (!(wi_local.z * vec3_dot(wi, ng) > 0.0f)) return vec3_splat(0.0f);
    float pdf;
    return vec3_scale(bsdf_eval(&v.bsdf, v.wo, wi_local, &pdf), fabs(1.0f / lit));
}

/* power: that arrives along the edge. u: of the lens. name: of the ray to it. */
TRIAD_FUNCTION void photon_splat(const Scene* scene, const SplatFilm* film, float pixel_area,
                                 const Vertex* vertex, float wavelength, Vec3 power, Vec2 u, uint name,
                                 Tally* tally) {
    const Surface* s = &vertex->surface;
    const Camera camera = scene->frame->camera;
    const Sight sight = splat_sight(&camera, pixel_area, s->position, u);
    SplatPlace place;
    if (!(sight.importance > 0.0f) || !splat_place(film, scene->frame, sight.x, sight.y, &place)) return;
    const float facing = vec3_dot(sight.direction, s->geometric_normal);
    Vec3 value =
        vec3_mul(power, photon_bsdf(scene, s, vertex->wo, sight.direction, &vertex->around, wavelength));
    value = vec3_scale(value, fabs(facing) * sight.importance);
    if (!(vec3_largest_abs(value) > 0.0f)) return; /* light of one wavelength is signed */
#if TRIAD_TRANSMISSION
    const int through = facing * vec3_dot(vertex->wo, s->geometric_normal) < 0.0f;
    const uint body = through ? vertex->around.beyond.x : vertex->around.here.x;
    if (body != TRIAD_NONE)
        value = vec3_mul(value, vertex_transmittance(scene->materials + body,
                                                     vec3_length(vec3_sub(sight.target, s->position))));
#endif
    const Vec3 ng = facing < 0.0f ? vec3_negate(s->geometric_normal) : s->geometric_normal;
    if (!rays_occluded(scene, vertex_spawn_to(s, ng, &vertex->hit, sight.target), name, tally))
        splat_colour(film, &place, scene->frame->quanta, value, tally);
}

#endif
