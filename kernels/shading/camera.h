/* Camera rays. */
#ifndef TRIAD_SHADING_CAMERA_H
#define TRIAD_SHADING_CAMERA_H

#include "common/sampling.h"
#include "shading/scene.h"

/* The ray through film position (x, y), in pixels of the full picture, y down. u: lens sample, uniform in [0,
 * 1)^2. */
TRIAD_FUNCTION Ray camera_ray(const Camera* c, float x, float y, float2 u) {
    const float3 right = (float3)(c->right[0], c->right[1], c->right[2]),
                 up = (float3)(c->up[0], c->up[1], c->up[2]);
    const float3 forward = (float3)(c->forward[0], c->forward[1], c->forward[2]);
    const float sx = fma(x / c->pixels[0], 2.0f, -1.0f) * c->extent[0];
    const float sy = fma(y / c->pixels[1], -2.0f, 1.0f) * c->extent[1];
    const float3 across = right * sx + up * sy;
    float3 origin = (float3)(c->origin[0], c->origin[1], c->origin[2]);
    float3 direction = forward + across;
    if (c->projection == CAMERA_ORTHOGRAPHIC) {
        origin += across;
        direction = forward;
    }
#if TRIAD_LENS
    if (c->lens_radius > 0.0f) {
        const float2 lens = sampling_disc(u) * c->lens_radius;
        const float3 shift = right * lens.x + up * lens.y;
        origin += shift;
        direction -= shift * (1.0f / c->focus_distance);
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
