/* Small vectors as structs of scalars, and what is done with them. OpenCL's own vector types keep drivers
 * from vectorising across work-items (docs/kernels.md); they are for lanes within an item, as in traversal/.
 * Members are .x .y .z .w, and functions round once per component and operation, in the order written. */
#ifndef TRIAD_COMMON_VECTOR_H
#define TRIAD_COMMON_VECTOR_H

#include "common/language.h"
#include "common/math.h"

/* x86-64's convention for calls packs two floats of a small struct into one vector, and what is left of that
 * after inlining stops the vectoriser. Structs beyond 16 bytes go through memory, which dissolves. */
#if defined(__x86_64__) && !TRIAD_ITEM_LANES
#define VECTOR_ALIGNMENT __attribute__((aligned(32)))
#else
#define VECTOR_ALIGNMENT
#endif

typedef struct Vec2 {
    float x, y;
} VECTOR_ALIGNMENT Vec2;
typedef struct Vec3 {
    float x, y, z;
} VECTOR_ALIGNMENT Vec3;
typedef struct Vec4 {
    float x, y, z, w;
} VECTOR_ALIGNMENT Vec4;
typedef struct UVec2 {
    uint x, y;
} VECTOR_ALIGNMENT UVec2;
typedef struct UVec4 {
    uint x, y, z, w;
} VECTOR_ALIGNMENT UVec4;
typedef struct IVec3 {
    int x, y, z;
} VECTOR_ALIGNMENT IVec3;

TRIAD_FUNCTION Vec2 vec2_make(float x, float y) {
    Vec2 v;
    v.x = x, v.y = y;
    return v;
}
TRIAD_FUNCTION Vec3 vec3_make(float x, float y, float z) {
    Vec3 v;
    v.x = x, v.y = y, v.z = z;
    return v;
}
TRIAD_FUNCTION Vec4 vec4_make(float x, float y, float z, float w) {
    Vec4 v;
    v.x = x, v.y = y, v.z = z, v.w = w;
    return v;
}
TRIAD_FUNCTION UVec2 uvec2_make(uint x, uint y) {
    UVec2 v;
    v.x = x, v.y = y;
    return v;
}
TRIAD_FUNCTION UVec4 uvec4_make(uint x, uint y, uint z, uint w) {
    UVec4 v;
    v.x = x, v.y = y, v.z = z, v.w = w;
    return v;
}
TRIAD_FUNCTION IVec3 ivec3_make(int x, int y, int z) {
    IVec3 v;
    v.x = x, v.y = y, v.z = z;
    return v;
}

/* All components alike. */
TRIAD_FUNCTION Vec2 vec2_splat(float s) { return vec2_make(s, s); }
TRIAD_FUNCTION Vec3 vec3_splat(float s) { return vec3_make(s, s, s); }
TRIAD_FUNCTION Vec4 vec4_splat(float s) { return vec4_make(s, s, s, s); }

/* Of the first elements of an array, in whatever address space. */
#define VEC2_OF(array) vec2_make((array)[0], (array)[1])
#define VEC3_OF(array) vec3_make((array)[0], (array)[1], (array)[2])
#define VEC4_OF(array) vec4_make((array)[0], (array)[1], (array)[2], (array)[3])

/* The index-th of an array of vectors, and setting it. */
TRIAD_FUNCTION Vec2 vec2_load(global const float* values, size_t index) {
    return VEC2_OF(values + 2 * index);
}
TRIAD_FUNCTION Vec3 vec3_load(global const float* values, size_t index) {
    return VEC3_OF(values + 3 * index);
}
TRIAD_FUNCTION Vec4 vec4_load(global const float* values, size_t index) {
    return VEC4_OF(values + 4 * index);
}
TRIAD_FUNCTION void vec3_store(Vec3 v, global float* values, size_t index) {
    values += 3 * index;
    values[0] = v.x, values[1] = v.y, values[2] = v.z;
}
TRIAD_FUNCTION void vec4_store(Vec4 v, global float* values, size_t index) {
    values += 4 * index;
    values[0] = v.x, values[1] = v.y, values[2] = v.z, values[3] = v.w;
}

TRIAD_FUNCTION Vec3 vec4_xyz(Vec4 v) { return vec3_make(v.x, v.y, v.z); }
TRIAD_FUNCTION Vec4 vec3_with(Vec3 v, float w) { return vec4_make(v.x, v.y, v.z, w); }
/* Without its first component, and with w last. */
TRIAD_FUNCTION Vec4 vec4_push(Vec4 v, float w) { return vec4_make(v.y, v.z, v.w, w); }

/* ---- Component by component ---- */

TRIAD_FUNCTION Vec2 vec2_add(Vec2 a, Vec2 b) { return vec2_make(a.x + b.x, a.y + b.y); }
TRIAD_FUNCTION Vec2 vec2_sub(Vec2 a, Vec2 b) { return vec2_make(a.x - b.x, a.y - b.y); }
TRIAD_FUNCTION Vec2 vec2_scale(Vec2 v, float s) { return vec2_make(v.x * s, v.y * s); }
/* a + t (b - a), rounded as math_mix. */
TRIAD_FUNCTION Vec2 vec2_mix(Vec2 a, Vec2 b, float t) {
    return vec2_make(math_mix(a.x, b.x, t), math_mix(a.y, b.y, t));
}

TRIAD_FUNCTION Vec3 vec3_add(Vec3 a, Vec3 b) { return vec3_make(a.x + b.x, a.y + b.y, a.z + b.z); }
TRIAD_FUNCTION Vec3 vec3_sub(Vec3 a, Vec3 b) { return vec3_make(a.x - b.x, a.y - b.y, a.z - b.z); }
TRIAD_FUNCTION Vec3 vec3_mul(Vec3 a, Vec3 b) { return vec3_make(a.x * b.x, a.y * b.y, a.z * b.z); }
TRIAD_FUNCTION Vec3 vec3_div(Vec3 a, Vec3 b) { return vec3_make(a.x / b.x, a.y / b.y, a.z / b.z); }
TRIAD_FUNCTION Vec3 vec3_scale(Vec3 v, float s) { return vec3_make(v.x * s, v.y * s, v.z * s); }
TRIAD_FUNCTION Vec3 vec3_negate(Vec3 v) { return vec3_make(-v.x, -v.y, -v.z); }
TRIAD_FUNCTION Vec3 vec3_abs(Vec3 v) { return vec3_make(fabs(v.x), fabs(v.y), fabs(v.z)); }
/* a + s v, rounded twice. */
TRIAD_FUNCTION Vec3 vec3_add_scaled(Vec3 a, Vec3 v, float s) { return vec3_add(a, vec3_scale(v, s)); }
/* a b + c, rounded once. */
TRIAD_FUNCTION Vec3 vec3_fma(Vec3 a, Vec3 b, Vec3 c) {
    return vec3_make(fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z));
}
/* s v + c, rounded once. */
TRIAD_FUNCTION Vec3 vec3_fma_scale(float s, Vec3 v, Vec3 c) { return vec3_fma(vec3_splat(s), v, c); }
TRIAD_FUNCTION Vec3 vec3_mix(Vec3 a, Vec3 b, float t) { return vec3_fma_scale(t, vec3_sub(b, a), a); }
/* From a to b by the weight t of b, rounded three times. */
TRIAD_FUNCTION Vec3 vec3_blend(Vec3 a, Vec3 b, float t) { return vec3_add_scaled(a, vec3_sub(b, a), t); }
/* a where it is less (more) than b, else b. */
TRIAD_FUNCTION Vec3 vec3_at_most(Vec3 a, Vec3 b) {
    return vec3_make(math_min(a.x, b.x), math_min(a.y, b.y), math_min(a.z, b.z));
}
TRIAD_FUNCTION Vec3 vec3_at_least(Vec3 a, Vec3 b) {
    return vec3_make(math_max(a.x, b.x), math_max(a.y, b.y), math_max(a.z, b.z));
}

TRIAD_FUNCTION Vec4 vec4_add(Vec4 a, Vec4 b) { return vec4_make(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
TRIAD_FUNCTION Vec4 vec4_sub(Vec4 a, Vec4 b) { return vec4_make(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w); }
TRIAD_FUNCTION Vec4 vec4_mul(Vec4 a, Vec4 b) { return vec4_make(a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w); }
TRIAD_FUNCTION Vec4 vec4_div(Vec4 a, Vec4 b) { return vec4_make(a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w); }
TRIAD_FUNCTION Vec4 vec4_scale(Vec4 v, float s) { return vec4_make(v.x * s, v.y * s, v.z * s, v.w * s); }
TRIAD_FUNCTION Vec4 vec4_blend(Vec4 a, Vec4 b, float t) { return vec4_add(a, vec4_scale(vec4_sub(b, a), t)); }
TRIAD_FUNCTION Vec4 vec4_abs(Vec4 v) { return vec4_make(fabs(v.x), fabs(v.y), fabs(v.z), fabs(v.w)); }
TRIAD_FUNCTION Vec4 vec4_fma(Vec4 a, Vec4 b, Vec4 c) {
    return vec4_make(fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z), fma(a.w, b.w, c.w));
}
TRIAD_FUNCTION Vec4 vec4_fma_scale(float s, Vec4 v, Vec4 c) { return vec4_fma(vec4_splat(s), v, c); }
TRIAD_FUNCTION Vec4 vec4_mix(Vec4 a, Vec4 b, float t) { return vec4_fma_scale(t, vec4_sub(b, a), a); }
TRIAD_FUNCTION Vec4 vec4_at_most(Vec4 a, Vec4 b) {
    return vec4_make(math_min(a.x, b.x), math_min(a.y, b.y), math_min(a.z, b.z), math_min(a.w, b.w));
}
TRIAD_FUNCTION Vec4 vec4_at_least(Vec4 a, Vec4 b) {
    return vec4_make(math_max(a.x, b.x), math_max(a.y, b.y), math_max(a.z, b.z), math_max(a.w, b.w));
}

/* ---- Geometry: written out, because the bounds of OpenCL's functions are absolute and loose ---- */

TRIAD_FUNCTION float vec3_dot(Vec3 a, Vec3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
/* Each component to 1.5 ulp. */
TRIAD_FUNCTION Vec3 vec3_cross(Vec3 a, Vec3 b) {
    return vec3_make(math_difference_of_products(a.y, b.z, a.z, b.y),
                     math_difference_of_products(a.z, b.x, a.x, b.z),
                     math_difference_of_products(a.x, b.y, a.y, b.x));
}
TRIAD_FUNCTION float vec3_length(Vec3 v) { return sqrt(vec3_dot(v, v)); }
/* v is neither zero nor so long or short that its square leaves the normal range (1e-18 to 1e18 is safe). */
TRIAD_FUNCTION Vec3 vec3_normalize(Vec3 v) { return vec3_scale(v, 1.0f / sqrt(vec3_dot(v, v))); }
/* The direction w mirrored about the unit normal n: both point away from the surface. */
TRIAD_FUNCTION Vec3 vec3_reflect(Vec3 w, Vec3 n) {
    return vec3_fma_scale(2.0f * vec3_dot(w, n), n, vec3_negate(w));
}

TRIAD_FUNCTION float vec3_average(Vec3 v) { return (v.x + v.y + v.z) * (1.0f / 3.0f); }
TRIAD_FUNCTION float vec3_largest(Vec3 v) { return math_max(v.x, math_max(v.y, v.z)); }
TRIAD_FUNCTION float vec3_largest_abs(Vec3 v) { return vec3_largest(vec3_abs(v)); }
/* Of linear Rec.709. */
TRIAD_FUNCTION float vec3_luminance(Vec3 v) { return fma(v.x, 0.2126f, fma(v.y, 0.7152f, v.z * 0.0722f)); }

#endif
