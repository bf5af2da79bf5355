/* Light sampling: one light by its share of the power, then a point or direction on it. */
#ifndef TRIAD_SHADING_LIGHT_H
#define TRIAD_SHADING_LIGHT_H

#include "common/random.h"
#include "common/sampling.h"
#include "shading/environment.h"
#include "shading/surface.h"

typedef struct LightSample {
    float3 direction; /* unit, towards the light */
    float3 target;    /* point on the light, when `distant` is 0 */
    float3
        weight; /* incident radiance / pdf (delta lights: irradiance per cosine / probability of the pick) */
    float inverse_pdf; /* of the solid angle, the pick included; 0: a delta light, which no other sampling
                          finds */
    int distant;
    uint flags; /* of the Light: its weight is of this spectrum */
    float2 uv;  /* of a map: weight and inverse_pdf are still to be looked up, by light_complete() */
} LightSample;

/* 1 / density in solid angle, seen from a point at `distance2` (squared), with which light_sample draws a
 * point of a triangle light. `cosine` is the absolute cosine at the light. */
TRIAD_FUNCTION float light_triangle_inverse_pdf(const Light* light, float inverse_distance2, float cosine) {
    return light->area_per_pick * cosine * inverse_distance2;
}

#if TRIAD_TRIANGLE_LIGHTS
/* What a triangle emits at barycentric weights b of its corners 1 and 2. */
TRIAD_FUNCTION float3 light_triangle_radiance(const Scene* scene, const Light* light, float2 b) {
    float3 radiance = (float3)(light->colour[0], light->colour[1], light->colour[2]);
#if TRIAD_TEXTURES
    const Triangle t = scene->triangles[light->primitive];
    const Geometry g = scene->geometries[t.geometry];
    global const Material* m = scene->materials + g.material;
    if (m->emission_use != TRIAD_NONE) {
        float2 uv0, uv1;
        float4 colour;
        surface_attributes(scene, &g, &t, b.x, b.y, &uv0, &uv1, &colour);
        radiance = surface_emission(scene, m, uv0, uv1);
    }
#endif
#if TRIAD_ALPHA_TEST
    /* Rays end short of the light, or begin beyond it: none asks for the coverage of the light itself. */
    radiance *= surface_coverage(scene, light->primitive, b.x, b.y);
#endif
    return radiance;
}

TRIAD_FUNCTION int light_sample_triangle(const Scene* scene, const Light* light, float3 p, float2 u,
                                         LightSample* s) {
    const float2 b = sampling_triangle(u);
    const float3 e1 = (float3)(light->edge1[0], light->edge1[1], light->edge1[2]);
    const float3 e2 = (float3)(light->edge2[0], light->edge2[1], light->edge2[2]);
    float3 q = (float3)(light->position[0], light->position[1], light->position[2]) + e1 * b.x + e2 * b.y;
    float3 n = (float3)(light->axis[0], light->axis[1], light->axis[2]);
    const float3 d = q - p;
    const float inverse_distance2 = 1.0f / math_dot(d, d);
    s->direction = d * sqrt(inverse_distance2);
    float cosine = -math_dot(n, s->direction);
    if (cosine < 0.0f && (light->flags & MATERIAL_DOUBLE_SIDED)) {
        cosine = -cosine;
        n = -n;
    }
    if (!(cosine > 0.0f) || !math_is_finite(inverse_distance2)) return 0;
    const float3 radiance = light_triangle_radiance(scene, light, b);
    s->inverse_pdf = light_triangle_inverse_pdf(light, inverse_distance2, cosine);
    s->weight = radiance * s->inverse_pdf;
    /* The target moves off the light by the rounding error of q, so that the light does not shadow itself. */
    s->target = q + n * (32.0f * 0x1.0p-23f * max_abs3(q));
    s->distant = 0;
    return 1;
}
#endif

#if TRIAD_PUNCTUAL_LIGHTS
/* KHR_lights_punctual. */
TRIAD_FUNCTION int light_sample_punctual(const Light* light, float3 p, LightSample* s) {
    const float3 colour = (float3)(light->colour[0], light->colour[1], light->colour[2]);
    const float3 axis = (float3)(light->axis[0], light->axis[1], light->axis[2]);
    s->inverse_pdf = 0.0f;
    if (light->type == LIGHT_DIRECTIONAL) {
        s->direction = -axis;
        s->weight = colour * (1.0f / light->pick);
        s->distant = 1;
        return 1;
    }
    s->target = (float3)(light->position[0], light->position[1], light->position[2]);
    s->distant = 0;
    const float3 d = s->target - p;
    const float distance2 = math_dot(d, d);
    if (!(distance2 > 0.0f)) return 0;
    s->direction = normalize_or(d, (float3)(0.0f));
    float attenuation = 1.0f / distance2;
    if (light->range > 0.0f) {
        const float r2 = distance2 / (light->range * light->range);
        attenuation *= clamp(1.0f - r2 * r2, 0.0f, 1.0f);
    }
    if (light->type == LIGHT_SPOT) {
        const float cone =
            clamp(fma(-math_dot(axis, s->direction), light->cone_scale, light->cone_offset), 0.0f, 1.0f);
        attenuation *= cone * cone;
    }
    s->weight = colour * (attenuation / light->pick);
    return attenuation > 0.0f;
}
#endif

/* Draws a light and a direction to it from p: `pick` and `u` are uniform 32-bit integers. 0 when nothing
 * arrives. */
TRIAD_FUNCTION int light_sample(const Scene* scene, float3 p, uint pick, uint2 u, LightSample* s) {
    float unused;
    const uint index = cdf_find(&scene->frame->lights, scene->light_cdf, pick, &unused, &unused);
    const Light light = scene->lights[index];
    s->flags = light.flags;
#if TRIAD_TRIANGLE_LIGHTS
    if (light.type == LIGHT_TRIANGLE)
        return light_sample_triangle(scene, &light, p, (float2)(random_float(u.x), random_float(u.y)), s);
#endif
#if TRIAD_PUNCTUAL_LIGHTS
    if (light.type == LIGHT_POINT || light.type == LIGHT_SPOT || light.type == LIGHT_DIRECTIONAL)
        return light_sample_punctual(&light, p, s);
#endif
#if TRIAD_ENVIRONMENT_MAP
    if (light.type == LIGHT_ENVIRONMENT) {
        const Environment e = scene->frame->environment;
        s->direction = environment_sample(scene, &e, u, &s->uv);
        s->weight = (float3)(1.0f);
        environment_prefetch_texels(scene, &e, s->uv);
        s->inverse_pdf = light.pick; /* until light_complete() knows the density of the map */
        s->distant = 1;
        return 1;
    }
#endif
    return 0;
}

/* The second half of light_sample, for directions that nothing stands in the way of: maps are looked up here.
 */
TRIAD_FUNCTION int light_complete(const Scene* scene, LightSample* s) {
#if TRIAD_ENVIRONMENT_MAP
    if (s->distant && s->inverse_pdf > 0.0f) {
        const Environment e = scene->frame->environment;
        float pdf;
        const float3 radiance = environment_lookup(scene, &e, s->uv, &pdf);
        pdf *= s->inverse_pdf;
        if (!(pdf > 0.0f)) return 0;
        s->inverse_pdf = 1.0f / pdf;
        s->weight = radiance * s->inverse_pdf;
    }
#endif
    return 1;
}

/* Power heuristic with exponent 2 (Veach 1997, eq. 9.12) of a sample, from the density that the other
 * sampling has there over its own; the form survives densities whose squares overflow. */
TRIAD_FUNCTION float power_heuristic(float other_over_own) {
    return 1.0f / fma(other_over_own, other_over_own, 1.0f);
}

#endif
