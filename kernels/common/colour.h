/* What paths multiply: linear Rec.709, or (TRIAD_HERO, a program of its own: path_full.cl) the values at four
 * wavelengths. */
#ifndef TRIAD_COMMON_COLOUR_H
#define TRIAD_COMMON_COLOUR_H

#include "common/vector.h"

#ifndef TRIAD_HERO
#define TRIAD_HERO 0
#endif

#if TRIAD_HERO
typedef Vec4 Colour;
#define colour_splat vec4_splat
#define colour_add vec4_add
#define colour_sub vec4_sub
#define colour_mul vec4_mul
#define colour_div vec4_div
#define colour_scale vec4_scale
#define colour_abs vec4_abs
#define colour_fma vec4_fma
#define colour_fma_scale vec4_fma_scale
#define colour_at_most vec4_at_most
#define colour_at_least vec4_at_least
TRIAD_FUNCTION float colour_average(Colour c) { return (c.x + c.y + c.z + c.w) * 0.25f; }
TRIAD_FUNCTION float colour_largest(Colour c) { return math_max(math_max(c.x, c.y), math_max(c.z, c.w)); }
#define colour_luminance colour_average
#define colour_load vec4_load
#define colour_store vec4_store
#else
typedef Vec3 Colour;
#define colour_splat vec3_splat
#define colour_add vec3_add
#define colour_sub vec3_sub
#define colour_mul vec3_mul
#define colour_div vec3_div
#define colour_scale vec3_scale
#define colour_abs vec3_abs
#define colour_fma vec3_fma
#define colour_fma_scale vec3_fma_scale
#define colour_at_most vec3_at_most
#define colour_at_least vec3_at_least
#define colour_average vec3_average
#define colour_largest vec3_largest
#define colour_luminance vec3_luminance
#define colour_load vec3_load
#define colour_store vec3_store
#endif

/* 1 - c. */
TRIAD_FUNCTION Colour colour_complement(Colour c) { return colour_sub(colour_splat(1.0f), c); }

#endif
