/* Triangle lights that are large beside their distance: points on them are drawn evenly in their solid angle,
 * not on their area, so that no distance or cosine at the light makes samples noisy. */
#ifndef TRIAD_SHADING_NEAR_LIGHT_H
#define TRIAD_SHADING_NEAR_LIGHT_H

#include "common/sampling.h"
#include "shading/scene.h"

/* A triangle as its receiver sees it, made ready for sampling (Peters 2021, "BRDF importance sampling for
 * polygonal lights"). */
typedef struct SphericalTriangle {
    Vec3 a, b, c;      /* unit, towards the corners */
    float volume;      /* |a . (b x c)| */
    float c_a_and_b;   /* c . a + c . b */
    float one_and_a_b; /* 1 + a . b */
    float half_angle;  /* half of the solid angle, in [0, pi]; Van Oosterom and Strackee 1983, eq. 8 */
} SphericalTriangle;

/* From vectors to the corners; normal: unit, of their plane; area: of the flat triangle. The volume by normal
 * and area is right where a determinant of three nearly equal vectors cancels. */
TRIAD_FUNCTION SphericalTriangle spherical_triangle(Vec3 a, Vec3 b, Vec3 c, Vec3 normal, float area) {
    const float over_a = 1.0f / sqrt(vec3_dot(a, a)), over_b = 1.0f / sqrt(vec3_dot(b, b)),
                over_c = 1.0f / sqrt(vec3_dot(c, c));
    SphericalTriangle t;
    t.a = vec3_scale(a, over_a), t.b = vec3_scale(b, over_b), t.c = vec3_scale(c, over_c);
    t.volume = 2.0f * (area * over_b) * over_c * fabs(vec3_dot(t.a, normal));
    t.c_a_and_b = vec3_dot(t.c, t.a) + vec3_dot(t.c, t.b);
    t.one_and_a_b = 1.0f + vec3_dot(t.a, t.b);
    t.half_angle = math_atan2(t.volume, t.one_and_a_b + t.c_a_and_b);
    return t;
}

/* A unit vector into the triangle, evenly in solid angle, for u in [0, 1)^2. */
TRIAD_FUNCTION Vec3 spherical_triangle_sample(const SphericalTriangle* t, Vec2 u) {
    float sine, cosine;
    math_sincos_turns(u.x * t->half_angle * (0.5f / MATH_PI), &sine, &cosine);
    /* The corner `end` between a and c that leaves the share u.x of the angle to a, b and it. */
    const Vec3 middle = vec3_add_scaled(vec3_scale(t->a, fma(t->volume, cosine, -t->c_a_and_b * sine)), t->c,
                                        t->one_and_a_b * sine);
    const float turn = 2.0f * vec3_dot(t->a, middle) / vec3_dot(middle, middle);
    const Vec3 end = vec3_add_scaled(vec3_negate(t->a), middle, turn);
    /* From b towards it, evenly in the cosine. */
    const float b_end = vec3_dot(t->b, end);
    const float z = fma(u.y, b_end - 1.0f, 1.0f);
    const float s =
        sqrt(math_max(0.0f, (1.0f - z) * (1.0f + z)) / math_max((1.0f - b_end) * (1.0f + b_end), 0x1.0p-60f));
    return vec3_add_scaled(vec3_scale(t->b, fma(-s, b_end, z)), end, s);
}

/* Half of the solid angle beyond which points are drawn by area: directions from so near are known too
 * roughly. */
#define NEAR_LIGHT_MOST 3.1f
TRIAD_FUNCTION float near_light_angle_of(const SphericalTriangle* t) {
    return t->half_angle < NEAR_LIGHT_MOST ? 2.0f * t->half_angle : 0.0f;
}

/* Solid angle of a light a corner of which is near; 0: its points are not drawn by it. a: to corner 0, edges
 * from there to the others; normal and area as of Light. */
TRIAD_FUNCTION float near_light_angle(Vec3 a, Vec3 edge1, Vec3 edge2, Vec3 normal, float area) {
    const SphericalTriangle t = spherical_triangle(a, vec3_add(a, edge1), vec3_add(a, edge2), normal, area);
    return near_light_angle_of(&t);
}

/* The same, and a point drawn by u in [0, 1)^2: barycentric weights of corners 1 and 2. */
TRIAD_FUNCTION float near_light_point(Vec3 a, Vec3 edge1, Vec3 edge2, Vec3 normal, float area, Vec2 u,
                                      Vec2* point) {
    const SphericalTriangle t = spherical_triangle(a, vec3_add(a, edge1), vec3_add(a, edge2), normal, area);
    const Vec3 d = spherical_triangle_sample(&t, u);
    /* where it meets the plane */
    const float over = 0.5f / (area * vec3_dot(d, normal));
    const float b1 = math_clamp(over * vec3_dot(d, vec3_cross(edge2, a)), 0.0f, 1.0f);
    const float b2 = math_clamp(over * vec3_dot(d, vec3_cross(a, edge1)), 0.0f, 1.0f - b1);
    *point = vec2_make(b1, b2);
    return near_light_angle_of(&t);
}

/* Whether a corner is within reach of light and receiver; a path that hits the light asks the same. */
TRIAD_FUNCTION int light_is_near(Vec3 a, Vec3 edge1, Vec3 edge2, float reach) {
    const Vec3 b = vec3_add(a, edge1), c = vec3_add(a, edge2);
    const float least = math_min(math_min(vec3_dot(a, a), vec3_dot(b, b)), vec3_dot(c, c));
    return least > 0.0f && least < math_square(reach);
}

#endif
