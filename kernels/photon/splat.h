/* Light on its way to the camera: where a point is in the picture, and order-free sums that many work-items
 * add to. */
#ifndef TRIAD_PHOTON_SPLAT_H
#define TRIAD_PHOTON_SPLAT_H

#include "common/sampling.h"

/* How the camera sees a point. */
typedef struct Sight {
    Vec3 direction;   /* unit, from the point towards the eye */
    Vec3 target;      /* the point of the lens */
    float x, y;       /* film position, in pixels of the full picture */
    float importance; /* of a unit of radiance per projected area at the point: 1 / m^2; 0: not in sight */
} Sight;

/* From p to a point of the lens, u in [0, 1)^2. A pixel's value is the mean of radiance over its area A on
 * the image plane at distance 1: a projected area dA cos at distance d counts dA cos / (d^2 cos_eye^3 A) of
 * it. */
TRIAD_FUNCTION Sight splat_sight(const Camera* c, float pixel_area, Vec3 p, Vec2 u) {
    const Vec3 right = VEC3_OF(c->right), up = VEC3_OF(c->up), forward = VEC3_OF(c->forward),
               eye = VEC3_OF(c->origin);
    Sight s;
    s.target = eye;
    s.importance = 0.0f;
    float focus = 1.0f;
    Vec2 lens = vec2_splat(0.0f);
#if TRIAD_LENS
    if (c->lens_radius > 0.0f) {
        lens = vec2_scale(sampling_disc(u), c->lens_radius);
        s.target = vec3_add(s.target, vec3_add_scaled(vec3_scale(right, lens.x), up, lens.y));
        focus = c->focus_distance;
    }
#else
    (void)u;
#endif
    const Vec3 to = vec3_sub(p, s.target);
    const float depth = vec3_dot(to, forward);
    if (!(depth > 0.0f)) return s;
    Vec2 on_plane = vec2_make(vec3_dot(to, right), vec3_dot(to, up)); /* in units of the extent */
    if (c->projection == CAMERA_ORTHOGRAPHIC) {
        s.direction = vec3_negate(forward);
        s.target = vec3_add_scaled(p, forward, -depth);
        s.importance = 1.0f / pixel_area;
    } else {
        /* where the line through the lens crosses the plane in focus, seen from the middle of the lens */
        on_plane.x = on_plane.x / depth + lens.x / focus;
        on_plane.y = on_plane.y / depth + lens.y / focus;
        const float inverse = 1.0f / vec3_length(to), cosine = depth * inverse;
        s.direction = vec3_scale(to, -inverse);
        s.importance = inverse * inverse / (cosine * cosine * cosine * pixel_area);
    }
    s.x = fma(on_plane.x / c->extent[0], 0.5f, 0.5f) * c->pixels[0];
    s.y = fma(on_plane.y / c->extent[1], -0.5f, 0.5f) * c->pixels[1];
    return s;
}

/* Adds to a 64-bit sum that others add to at the same time: two halves and a carry, modulo 2^64, so that no
 * order matters. */
TRIAD_FUNCTION void splat_add(volatile global uint* sum, long value) {
    const uint low = (uint)(ulong)value, high = (uint)((ulong)value >> 32);
    const uint old = low == 0u ? 0u : atomic_add(sum, low);
    const uint carry = old + low < old;
    if (high + carry != 0u) atomic_add(sum + 1, high + carry);
}

#endif
