/* Tone maps of bins that hold few rays. A tone map is bent, so that the mean of tone-mapped noise is not the
 * tone-mapped mean: alone, a bin of one ray is too dark. Where the bins of a pixel differ by noise, they are
 * therefore evened out and mapped along a tangent, which keeps their mean; where they differ by structure,
 * one by one, which keeps bright edges tame. The mean itself is noisy too: what its tone map loses by that is
 * told from halves of the rays and given back. docs/decisions/subpixel.md says why. */
#ifndef TRIAD_SUBPIXEL_NOISE_H
#define TRIAD_SUBPIXEL_NOISE_H

#include "subpixel/display.h"

/* What is kept of a pixel, NOISE_RECORD floats: mean radiance and alpha of its bins; where the tangent
 * touches; what a display shows of that; and from these indices on */
#define NOISE_SHARE 12 /* the share of noise */
#define NOISE_LOST 13  /* what noise takes from its tone-mapped mean */
#define NOISE_LEFT 16  /* how much of that the tangent leaves to be mended */
#define NOISE_MEND 17  /* what is added for that */

/* The tangent is a chord of this share of the way to the bin: every tone map has one. */
#define NOISE_CHORD 0.03125f

/* Sums over some bins, and over pairs of neighbours among them. */
typedef struct NoiseSums {
    float values, squares, differences; /* the last squared */
    uint count, pairs;
} NoiseSums;

/* A bin's brightness, bent so that a few bright rays do not decide alone. */
TRIAD_FUNCTION float noise_value(Vec4 bin) {
    const float l = math_min(math_max(vec3_luminance(vec4_xyz(bin)), 0.0f), TONE_LIMIT);
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

TRIAD_FUNCTION float noise_variance(const NoiseSums* s) {
    const float n = (float)s->count, mean = s->values / n;
    return (s->squares / n - mean * mean) * (n / (n - 1.0f));
}

/* Variance of one bin of a pixel of `bins`, from that of the pixel's mean, which its halves tell. weight: of
 * HalfMeans (host/scene/film.h). The samples of a pixel even each other out, so that it is rather too low. */
TRIAD_FUNCTION float noise_of_halves(Vec3 first, Vec3 second, float weight, float bins) {
    const float difference = noise_value(vec3_with(first, 1.0f)) - noise_value(vec3_with(second, 1.0f));
    return bins * math_square(weight * difference);
}

/* How much of the variance of bins of `rays` rays each is noise; and that variance. Neighbours differ by
 * twice the variance of that, on average; but fine structure is not alike in neighbours either. What there is
 * more than rays can bring is structure: values from 0 to 1 have at most the variance mean (1 - mean) (Bhatia
 * and Davis 2000), and means of n of them the nth part. Rays much brighter than the bend bring more, which
 * halves show. */
TRIAD_FUNCTION float noise_share(const NoiseSums* s, float rays, float halves, float* variance) {
    const float mean = s->values / (float)s->count;
    *variance = noise_variance(s);
    const float rough = 0.5f * s->differences / (float)s->pairs;
    const float possible = math_max(mean * (1.0f - mean) / rays, halves);
    return *variance > 1e-9f ? math_saturate(rough / *variance) * math_saturate(possible / *variance) : 0.0f;
}

/* What noise takes from the tone-mapped mean of all rays on average, by two halves of them. If these differ
 * by noise alone, the tone map f of their mean is above the mean of their f by 1 / 4 of their squared
 * difference times -f''/2; the loss is `weight` of it, where `weight` times the squared difference is the
 * variance of the mean: the jackknife (Quenouille 1956, "Notes on Bias in Estimation"). */
TRIAD_FUNCTION Vec3 noise_lost(global const DisplaySlab* slab, Vec3 first, Vec3 second, float alpha,
                               float weight) {
    const Vec3 a = vec4_xyz(display_of_bin(slab, vec3_with(first, alpha)));
    const Vec3 b = vec4_xyz(display_of_bin(slab, vec3_with(second, alpha)));
    const Vec3 middle = vec3_scale(vec3_add(first, second), 0.5f);
    const Vec3 whole = vec4_xyz(display_of_bin(slab, vec3_with(middle, alpha)));
    return vec3_scale(vec3_sub(whole, vec3_scale(vec3_add(a, b), 0.5f)), 4.0f * weight);
}

/* Display-linear light of a bin. `pixel`: its pixel's record. */
TRIAD_FUNCTION Vec4 noise_display(global const DisplaySlab* slab, Vec4 bin, global const float* pixel) {
    const Vec4 alone = display_of_bin(slab, bin);
    const float share = pixel[NOISE_SHARE];
    if (share == 0.0f) return alone;
    const Vec4 mean = vec4_load(pixel, 0), point = vec4_load(pixel, 1), light = vec4_load(pixel, 2);
    /* Of what differs by noise alone nothing is worth keeping; of a mixture the share of structure. That is
     * told from noise by few bins, and to lose it is worse: hence the square. */
    const Vec4 even = vec4_mix(bin, mean, share * share);
    const Vec4 ahead = display_of_bin(slab, vec4_mix(point, even, NOISE_CHORD));
    const Vec4 along = vec4_mix(light, ahead, 1.0f / NOISE_CHORD);
    const Vec3 mended = vec3_add(vec4_xyz(along), vec3_load(pixel + NOISE_MEND, 0));
    return vec4_mix(alone, vec3_with(mended, along.w), share);
}

#endif
