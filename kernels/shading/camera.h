/* Camera rays. */
#ifndef TRIAD_SHADING_CAMERA_H
#define TRIAD_SHADING_CAMERA_H

#include "common/sampling.h"
#include "shading/scene.h"

/* The ray through film position (x, y), in pixels of the full picture, y down. u: lens sample, uniform in [0,
 * 1)^2. */
TRIAD_FUNCTION Ray camera_ray(const Camera* c, float x, float y, Vec2 u) {
    const Vec3 right = VEC3_OF(c->right), up = VEC3_OF(c->up), forward = VEC3_OF(c->forward);
    const float sx = fma(x / c->pixels[0], 2.0f, -1.0f) * c->extent[0];
    const float sy = fma(y / c->pixels[1], -2.0f, 1.0f) * c->extent[1];
    const Vec3 across = vec3_add_scaled(vec3_scale(right, sx), up, sy);
    Vec3 origin = VEC3_OF(c->origin);
    Vec3 direction = vec3_add(forward, across);
    if (c->projection == CAMERA_ORTHOGRAPHIC) {
        origin = vec3_add(origin, across);
        direction = forward;
    }
#if TRIAD_LENS
    if (c->lens_radius > 0.0f) {
        const Vec2 lens = vec2_scale(sampling_disc(u), c->lens_radius);
        const Vec3 shift = vec3_add_scaled(vec3_scale(right, lens.x), up, lens.y);
        origin = vec3_add(origin, shift);
        direction = vec3_add_scaled(direction, shift, -1.0f / c->focus_distance);
    }
#endif
    direction = normalize_or(direction, forward);
    Ray ray;
    ray.origin[0] = origin.x, ray.origin[1] = origin.y, ray.origin[2] = origin.z;
    ray.direction[0] = direction.x, ray.direction[1] = direction.y, ray.direction[2] = direction.z;
    ray.t_max = INFINITY;
    ray.skip_instance = ray.skip_primitive = TRIAD_NONE;
    return ray;
}

#endif
