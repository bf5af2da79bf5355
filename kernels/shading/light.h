/* Light sampling: one light by its share of the power, or of what it may send here, then a point or direction
 * on it. */
#ifndef TRIAD_SHADING_LIGHT_H
#define TRIAD_SHADING_LIGHT_H

#include "common/random.h"
#include "common/sampling.h"
#include "shading/coat_emission.h"
#include "shading/facing.h"
#include "shading/light_tree.h"
#include "shading/near_light.h"
#include "shading/surface.h"

/* No light but a map: then nothing is picked. */
#define LIGHT_MAP_ALONE (!TRIAD_TRIANGLE_LIGHTS && !TRIAD_PUNCTUAL_LIGHTS)

typedef struct LightSample {
    Vec3 direction; /* unit, towards the light */
    Vec3 target;    /* point on the light, when `distant` is 0 */
    Vec3 weight; /* incident radiance / pdf (delta lights: irradiance per cosine / probability of the pick) */
    float inverse_pdf; /* of the solid angle, the pick included; 0: a delta light, which no other sampling
                          finds */
    int distant;
    uint light; /* its Light */
    uint flags; /* of the Light: its weight is of this spectrum */
    Vec2 uv;    /* of a map: weight and inverse_pdf are still to be looked up, by light_complete() */
} LightSample;

#if TRIAD_TRIANGLE_LIGHTS
/* How a triangle light is drawn: its solid angle over the probability of its pick; below 0: by its area, that
 * over the probability, negated. Finite for a light that is never picked, too. */
TRIAD_FUNCTION float light_extent(const Light* light, float angle) {
    const float extent = math_min((angle > 0.0f ? angle : light->area) * light->inverse_pick, 3e38f);
    return angle > 0.0f ? extent : -extent;
}

/* 1 / density in solid angle of a point drawn so, seen from a point at `distance2` (squared). `cosine` is the
 * absolute cosine at the light. */
TRIAD_FUNCTION float light_triangle_inverse_pdf(float extent, float inverse_distance2, float cosine) {
    return extent > 0.0f ? extent : -extent * cosine * inverse_distance2;
}

/* What a triangle emits at barycentric weights b of its corners 1 and 2, below its varnish. */
TRIAD_FUNCTION Vec3 light_triangle_radiance(const Scene* scene, const Light* light, Vec2 b) {
    Vec3 radiance = VEC3_OF(light->colour);
#if TRIAD_TEXTURES
    const Triangle t = scene->triangles[light->primitive];
    const Geometry g = scene->geometries[t.geometry];
    global const Material* m = scene->materials + g.material;
    if (m->emission_use != TRIAD_NONE) {
        Vec2 uv0, uv1;
        Vec4 colour;
        surface_attributes(scene, &g, &t, b.x, b.y, &uv0, &uv1, &colour);
        radiance = surface_emission(scene, m, uv0, uv1, vec2_splat(0.0f));
    }
#endif
#if TRIAD_ALPHA_TEST
    /* Rays end short of the light, or begin beyond it: none asks for the coverage of the light itself. */
    radiance = vec3_scale(radiance, surface_coverage(scene, light->primitive, b.x, b.y));
#endif
    return radiance;
}

TRIAD_FUNCTION int light_sample_triangle(const Scene* scene, const Light* light, Vec3 p, Vec2 u,
                                         LightSample* s) {
    const Vec3 e1 = VEC3_OF(light->edge1);
    const Vec3 e2 = VEC3_OF(light->edge2);
    Vec3 n = VEC3_OF(light->axis);
    float extent = light_extent(light, 0.0f);
    Vec2 b = sampling_triangle(u);
#if TRIAD_NEAR_LIGHTS
    const Vec3 a = vec3_sub(VEC3_OF(light->position), p);
    if (light_is_near(a, e1, e2, light->range)) {
        Vec2 near;
        const float angle = near_light_point(a, e1, e2, n, light->area, u, &near);
        if (angle > 0.0f) b = near, extent = light_extent(light, angle);
    }
#endif
    const Vec3 q = vec3_add_scaled(vec3_add_scaled(VEC3_OF(light->position), e1, b.x), e2, b.y);
    const Vec3 d = vec3_sub(q, p);
    const float inverse_distance2 = 1.0f / vec3_dot(d, d);
    s->direction = vec3_scale(d, sqrt(inverse_distance2));
    float cosine = -vec3_dot(n, s->direction);
    if (cosine < 0.0f && (light->flags & MATERIAL_DOUBLE_SIDED)) {
        cosine = -cosine;
        n = vec3_negate(n);
    }
    if (!(cosine > 0.0f) || !math_is_finite(inverse_distance2)) return 0;
    s->inverse_pdf = light_triangle_inverse_pdf(extent, inverse_distance2, cosine);
    /* The target moves off the light by the rounding error of q, so that the light does not shadow itself. */
    s->target = vec3_add_scaled(q, n, 32.0f * 0x1.0p-23f * vec3_largest_abs(q));
    s->distant = 0;
    Vec3 radiance = light_triangle_radiance(scene, light, b);
#if TRIAD_CLEARCOAT
    radiance = vec3_scale(radiance, coat_light(scene, light, b, vec3_negate(s->direction)));
#endif
    s->weight = vec3_scale(radiance, s->inverse_pdf);
    return 1;
}
#endif

#if TRIAD_PUNCTUAL_LIGHTS
/* KHR_lights_punctual. */
TRIAD_FUNCTION int light_sample_punctual(const Light* light, Vec3 p, LightSample* s) {
    const Vec3 colour = VEC3_OF(light->colour);
    const Vec3 axis = VEC3_OF(light->axis);
    s->inverse_pdf = 0.0f;
    if (light->type == LIGHT_DIRECTIONAL) {
        s->direction = vec3_negate(axis);
        s->weight = vec3_scale(colour, light->inverse_pick);
        s->distant = 1;
        return 1;
    }
    s->target = VEC3_OF(light->position);
    s->distant = 0;
    const Vec3 d = vec3_sub(s->target, p);
    const float distance2 = vec3_dot(d, d);
    if (!(distance2 > 0.0f)) return 0;
    s->direction = normalize_or(d, vec3_splat(0.0f));
    float attenuation = 1.0f / distance2;
    if (light->range > 0.0f) {
        const float r2 = distance2 / (light->range * light->range);
        attenuation *= math_clamp(1.0f - r2 * r2, 0.0f, 1.0f);
    }
    if (light->type == LIGHT_SPOT) {
        const float cone =
            math_clamp(fma(-vec3_dot(axis, s->direction), light->cone_scale, light->cone_offset), 0.0f, 1.0f);
        attenuation *= cone * cone;
    }
    s->weight = vec3_scale(colour, attenuation * light->inverse_pick);
    return attenuation > 0.0f;
}
#endif

/* Which Light, or TRIAD_NONE: none is seen. probability: of this pick; below 0: the light's share of the
 * power. within: in [0, 1), uniform again: where in the light's share the number lies that picked it. */
typedef struct LightPick {
    uint light;
    float probability;
    float within;
} LightPick;

TRIAD_FUNCTION Light light_picked(const Scene* scene, LightPick pick) {
    Light light = scene->lights[pick.light];
#if TRIAD_LIGHT_TREE
    if (pick.probability >= 0.0f)
        light.inverse_pick = pick.probability > 0.0f ? 1.0f / pick.probability : LIGHT_UNPICKED;
#endif
    return light;
}

#if TRIAD_TRIANGLE_LIGHTS
/* light_extent() of a triangle light that a path from the receiver has hit, as light sampling would have
 * picked and drawn it. */
TRIAD_FUNCTION float light_found(const Scene* scene, Receiver receiver, uint index) {
    LightPick pick = {index, -1.0f, 0.0f};
    float angle = 0.0f;
#if TRIAD_NEAR_LIGHTS
    global const Light* l = scene->lights + index;
    const Vec3 a = vec3_sub(VEC3_OF(l->position), receiver.position);
    const Vec3 e1 = VEC3_OF(l->edge1), e2 = VEC3_OF(l->edge2);
    if (light_is_near(a, e1, e2, l->range)) angle = near_light_angle(a, e1, e2, VEC3_OF(l->axis), l->area);
#endif
#if TRIAD_LIGHT_TREE
    if (scene->frame->light_range != 0u) pick.probability = light_tree_probability(scene, &receiver, index);
#endif
    (void)receiver;
    const Light light = light_picked(scene, pick);
    return light_extent(&light, angle);
}
#endif

/* The light that the uniform 32-bit integer `number` picks for a receiver. */
TRIAD_FUNCTION LightPick light_pick(const Scene* scene, Receiver receiver, uint number) {
    LightPick pick = {0u, -1.0f, 0.0f};
#if !LIGHT_MAP_ALONE
#if TRIAD_LIGHT_TREE
    const uint rest = (number >> 1) - scene->frame->light_first;
    if (rest < scene->frame->light_range) {
        pick.light = light_tree_pick(scene, &receiver, rest, &pick.probability, &pick.within);
        return pick;
    }
#endif
    uint first, unused;
    pick.light = cdf_search(&scene->frame->lights, scene->light_cdf, number, &first, &unused);
    const float within = (float)(number - first) * (0x1p-32f * scene->lights[pick.light].inverse_pick);
#else
    const float within = (float)number * 0x1p-32f;
    (void)scene;
#endif
    pick.within = math_min(within, 0x1.fffffep-1f);
    (void)receiver;
    return pick;
}

/* Draws a direction to a light by what the pick has left of its number and by v, a uniform 32-bit integer. 0
 * when nothing arrives. */
TRIAD_FUNCTION int light_sample_picked(const Scene* scene, LightPick pick, Receiver receiver, uint v,
                                       LightSample* s) {
    if (pick.light == TRIAD_NONE) return 0;
    (void)v;
    const Vec3 p = receiver.position;
    const Light light = light_picked(scene, pick);
    s->light = pick.light;
    s->flags = light.flags;
#if TRIAD_TRIANGLE_LIGHTS
    if (light.type == LIGHT_TRIANGLE)
        return light_sample_triangle(scene, &light, p, vec2_make(pick.within, random_float(v)), s);
#endif
#if TRIAD_PUNCTUAL_LIGHTS
    if (light.type == LIGHT_POINT || light.type == LIGHT_SPOT || light.type == LIGHT_DIRECTIONAL)
        return light_sample_punctual(&light, p, s);
#endif
#if TRIAD_ENVIRONMENT_MAP
    if (light.type == LIGHT_ENVIRONMENT) {
        const Environment e = scene->frame->environment;
        s->inverse_pdf = light.pick; /* until light_complete() knows the density of the map */
        UVec2 numbers = uvec2_make((uint)(pick.within * 0x1p32f), v);
#if !LIGHT_MAP_ALONE
        /* a hash below: columns have finer shares than the numbers of an unlikely map */
        numbers.x += (uint)(random_float(random_mix(as_uint(pick.within) ^ v)) * light.inverse_pick);
#endif
        if (receiver.facing != 0u) {
            float factor;
            numbers = facing_warp(scene, receiver.facing, numbers, &factor);
            s->inverse_pdf *= factor;
        }
        s->direction = environment_sample(scene, &e, numbers, &s->uv);
        s->weight = vec3_splat(1.0f);
        environment_prefetch_texels(scene, &e, s->uv);
        s->distant = 1;
        return 1;
    }
#endif
    return 0;
}

/* Draws a light and a direction to it by uniform 32-bit integers. */
TRIAD_FUNCTION int light_sample(const Scene* scene, Receiver receiver, UVec2 u, LightSample* s) {
    return light_sample_picked(scene, light_pick(scene, receiver, u.x), receiver, u.y, s);
}

/* The second half of light_sample, for directions that nothing stands in the way of: maps are looked up here.
 */
TRIAD_FUNCTION int light_complete(const Scene* scene, LightSample* s) {
#if TRIAD_ENVIRONMENT_MAP
    if (s->distant && s->inverse_pdf > 0.0f) {
        const Environment e = scene->frame->environment;
        float pdf;
        const Vec3 radiance = environment_lookup(scene, &e, s->uv, &pdf);
        pdf *= s->inverse_pdf;
        if (!(pdf > 0.0f)) return 0;
        s->inverse_pdf = 1.0f / pdf;
        s->weight = vec3_scale(radiance, s->inverse_pdf);
    }
#endif
    return 1;
}

/* Power heuristic with exponent 2 (Veach 1997, eq. 9.12) of a sample, from the density that the other
 * sampling has there over its own; the form survives densities whose squares overflow. */
TRIAD_FUNCTION float power_heuristic(float other_over_own) {
    return 1.0f / fma(other_over_own, other_over_own, 1.0f);
}

/* The same with exponent 1.5, for maps, which are drawn by where a surface faces about as well as its body
 * is: where both do well, less of an exponent adds less noise of its own. */
TRIAD_FUNCTION float map_heuristic(float other_over_own) {
    return 1.0f / fma(other_over_own, sqrt(other_over_own), 1.0f);
}

#endif
