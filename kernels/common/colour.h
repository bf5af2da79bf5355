/* What paths multiply: linear Rec.709, or (TRIAD_HERO, a program of its own: path_full.cl) the values at four
 * wavelengths. */
#ifndef TRIAD_COMMON_COLOUR_H
#define TRIAD_COMMON_COLOUR_H

#include "common/math.h"

#ifndef TRIAD_HERO
#define TRIAD_HERO 0
#endif

#if TRIAD_HERO
typedef float4 Colour;
TRIAD_FUNCTION float colour_average(Colour c) { return (c.x + c.y + c.z + c.w) * 0.25f; }
TRIAD_FUNCTION float colour_max(Colour c) { return math_max(math_max(c.x, c.y), math_max(c.z, c.w)); }
TRIAD_FUNCTION float colour_luminance(Colour c) { return colour_average(c); }
#else
typedef float3 Colour;
TRIAD_FUNCTION float colour_average(Colour c) { return math_average(c); }
TRIAD_FUNCTION float colour_max(Colour c) { return math_max3(c); }
TRIAD_FUNCTION float colour_luminance(Colour c) { return math_luminance(c); }
#endif

/* Component by component: a where it is less (more), else b. */
TRIAD_FUNCTION Colour colour_min(Colour a, Colour b) { return a < b ? a : b; }
TRIAD_FUNCTION Colour colour_above(Colour a, Colour b) { return a > b ? a : b; }

#endif
