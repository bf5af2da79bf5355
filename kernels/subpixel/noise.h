/* Tone maps of bins that hold few rays. A tone map is bent, so that the mean of tone-mapped noise is not the
 * tone-mapped mean: alone, a bin of one ray is too dark. Where the bins of a pixel differ by noise, they are
 * therefore mapped along the tangent at the pixel's mean, which keeps their mean; where they differ by
 * structure, one by one, which keeps bright edges tame. docs/subpixel.md has the measurements. */
#ifndef TRIAD_SUBPIXEL_NOISE_H
#define TRIAD_SUBPIXEL_NOISE_H

#include "subpixel/display.h"

/* Floats of a pixel: mean radiance and alpha of its bins; what a display shows of that; the share of noise.
 */
#define NOISE_RECORD 9
#define NOISE_MOST_BINS 16 /* along an axis of a pixel */
/* The tangent is a chord of this share of the way to the bin: every tone map has one. */
#define NOISE_CHORD 0.03125f

/* Sums over some bins, and over pairs of neighbours among them. */
typedef struct NoiseSums {
    float values, squares, differences; /* the last squared */
    uint count, pairs;
} NoiseSums;

/* A bin's brightness, bent so that a few bright rays do not decide alone. */
TRIAD_FUNCTION float noise_value(float4 bin) {
    const float l = math_min(math_max(math_luminance(bin.xyz), 0.0f), TONE_LIMIT);
    return l / (1.0f + l);
}
TRIAD_FUNCTION void noise_add(NoiseSums* s, float value) {
    s->values += value;
    s->squares = fma(value, value, s->squares);
    ++s->count;
}
TRIAD_FUNCTION void noise_add_pair(NoiseSums* s, float a, float b) {
    s->differences += math_square(a - b);
    ++s->pairs;
}

/* How much of the bins' variance is noise: neighbours differ by twice the variance of that, on average. */
TRIAD_FUNCTION float noise_share(const NoiseSums* s) {
    const float n = convert_float(s->count), mean = s->values / n;
    const float variance = (s->squares / n - mean * mean) * (n / (n - 1.0f));
    const float noise = 0.5f * s->differences / convert_float(s->pairs);
    return variance > 1e-9f ? math_saturate(noise / variance) : 0.0f;
}

/* Display-linear light of a bin. `pixel`: its pixel's record. */
TRIAD_FUNCTION float4 noise_display(global const DisplaySlab* slab, float4 bin, global const float* pixel) {
    const float4 alone = display_of_bin(slab, bin);
    const float share = pixel[8];
    if (share == 0.0f) return alone;
    const float4 mean = vload4(0, pixel), light = vload4(1, pixel);
    const float4 ahead = display_of_bin(slab, fma((float4)(NOISE_CHORD), bin - mean, mean));
    const float4 along = fma((float4)(1.0f / NOISE_CHORD), ahead - light, light);
    return fma((float4)(share), along - alone, alone);
}

#endif
