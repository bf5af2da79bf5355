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
TRIAD_FUNCTION Vec4 display_on_background(global const DisplaySlab* slab, Vec4 v) {
    if (slab->background[3] == 0.0f) return v;
    const Vec3 behind = VEC3_OF(slab->background);
    return vec3_with(vec3_fma_scale(1.0f - v.w, behind, vec4_xyz(v)), 1.0f);
}

/* Tone map and background. */
TRIAD_FUNCTION Vec4 display_light(global const DisplaySlab* slab, Vec4 radiance) {
    if (slab->encoded) return display_on_background(slab, radiance);
    return display_on_background(slab, tone_map_associated(slab->tone_map, radiance));
}

/* What the taps are to add up, from the radiance in a bin (encoded sources: display-linear light). */
TRIAD_FUNCTION Vec4 display_of_bin(global const DisplaySlab* slab, Vec4 radiance) {
    if (slab->order == TONE_PER_PIXEL || slab->order == TONE_NEVER) return radiance;
    Vec4 v = display_light(slab, radiance);
    if (slab->order == TONE_BIN_ENCODED) v = vec3_with(srgb_encode3(vec4_xyz(v)), v.w);
    return v;
}

/* Display-linear light, from what the taps have added up; lobes below zero may have left [0, 1]. */
TRIAD_FUNCTION Vec4 display_of_sum(global const DisplaySlab* slab, Vec4 sum) {
    Vec4 v = vec3_with(vec4_xyz(sum), math_saturate(sum.w));
    if (slab->order == TONE_PER_PIXEL) return display_light(slab, v);
    if (slab->order == TONE_BIN_ENCODED)
        v = vec3_with(srgb_decode3(vec3_make(math_saturate(v.x), math_saturate(v.y), math_saturate(v.z))),
                      v.w);
    return v;
}

#endif
