/* The parts of the pipeline from bins to drives that see one colour at a time. */
#ifndef TRIAD_DISPLAY_H
#define TRIAD_DISPLAY_H

#include "subpixel/srgb.h"
#include "subpixel/tone_map.h"

/* Position on an axis of `size` values that goes on as its mirror image, as often as needed. */
TRIAD_FUNCTION uint display_reflect(int i, uint size) {
    if (i >= 0 && i < (int)size) return (uint)i;
    const int period = 2 * (int)size;
    int r = i % period;
    r = r < 0 ? r + period : r;
    return (uint)(r < (int)size ? r : period - 1 - r);
}

/* A display-linear colour, associated with its alpha, on the background that there may be. */
TRIAD_FUNCTION float4 display_on_background(global const DisplaySlab* slab, float4 v) {
    if (slab->background[3] == 0.0f) return v;
    const float3 behind = (float3)(slab->background[0], slab->background[1], slab->background[2]);
    return (float4)(fma((float3)(1.0f - v.w), behind, v.xyz), 1.0f);
}

/* Tone map and background. */
TRIAD_FUNCTION float4 display_light(global const DisplaySlab* slab, float4 radiance) {
    if (slab->encoded) return display_on_background(slab, radiance);
    return display_on_background(slab, tone_map_associated(slab->tone_map, radiance));
}

/* What the taps are to add up, from the radiance in a bin (encoded sources: display-linear light). */
TRIAD_FUNCTION float4 display_of_bin(global const DisplaySlab* slab, float4 radiance) {
    if (slab->order == TONE_PER_PIXEL || slab->order == TONE_NEVER) return radiance;
    float4 v = display_light(slab, radiance);
    if (slab->order == TONE_BIN_ENCODED) v.xyz = srgb_encode3(v.xyz);
    return v;
}

/* Display-linear light, from what the taps have added up; lobes below zero may have left [0, 1]. */
TRIAD_FUNCTION float4 display_of_sum(global const DisplaySlab* slab, float4 v) {
    v.w = math_saturate(v.w);
    if (slab->order == TONE_PER_PIXEL) return display_light(slab, v);
    if (slab->order == TONE_BIN_ENCODED)
        v.xyz = srgb_decode3((float3)(math_saturate(v.x), math_saturate(v.y), math_saturate(v.z)));
    return v;
}

#endif
