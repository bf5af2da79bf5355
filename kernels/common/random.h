/* Random numbers as a function of their name: (pixel, sample index, stream, seed, set of two dimensions).
 * Nothing is stored, so that a picture does not depend on batch size, order, resume or merge. Integers only
 * up to the last step: the same bits on every device.
 *
 * Sets come in blocks of four, which are computed together: where a program follows whole
 * paths, as four lanes of a vector (TRIAD_ITEM_LANES). The sets of the first SAMPLER_SOBOL_BLOCKS blocks are
 * the first two dimensions of Sobol's sequence, Owen-scrambled, with the index shuffled anew for each set
 * (Burley 2020, "Practical Hash-based Owen Scrambling"; the hash is Laine and Karras's with Vegdahl's
 * constants, as in pbrt-v4's FastOwenScrambler). Sets beyond are hashed.
 *
 * The plan of the path tracer: block 0 is pixel, lens, (wavelength, time), spare; block b, for the b-th
 * vertex of the path, is (lobe and direction of the BSDF), (through a boundary, roulette), (light and point
 * on it), spare (of photons: landing).
 */
#ifndef TRIAD_COMMON_RANDOM_H
#define TRIAD_COMMON_RANDOM_H

#include "common/vector.h"

#define SAMPLER_SOBOL_SETS (4u * SAMPLER_SOBOL_BLOCKS)

/* 24 bits, in [0, 1 - 2^-24]: float(u) * 2^-32 would reach 1. */
TRIAD_FUNCTION float random_float(uint bits) { return (float)(bits >> 8) * 5.9604644775390625e-8f; }

/* lowbias32 (Wellons): a bijection whose every output bit depends on every input bit. */
TRIAD_FUNCTION uint random_mix(uint x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
/* pcg4d (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"). */
TRIAD_FUNCTION UVec4 random_pcg4d(UVec4 name) {
    UVec4 v = name;
    v.x = v.x * 1664525u + 1013904223u;
    v.y = v.y * 1664525u + 1013904223u;
    v.z = v.z * 1664525u + 1013904223u;
    v.w = v.w * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v.x ^= v.x >> 16;
    v.y ^= v.y >> 16;
    v.z ^= v.z >> 16;
    v.w ^= v.w >> 16;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}
/* One number from four, for choices that must be the same whenever they are asked again (stochastic
 * coverage). */
TRIAD_FUNCTION uint random_hash(UVec4 name) { return random_pcg4d(name).x; }

/* One number, or those of the four sets of a block at once: the same text for both. */
#if TRIAD_ITEM_LANES
typedef uint4 RandomLanes;
#define RANDOM_FIRST_LANE(v) (v).x
#else
typedef uint RandomLanes;
#define RANDOM_FIRST_LANE(v) (v)
#endif

TRIAD_FUNCTION RandomLanes random_reverse_lanes(RandomLanes v) {
    v = (v << 16) | (v >> 16);
    v = ((v & 0x00ff00ffu) << 8) | ((v >> 8) & 0x00ff00ffu);
    v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
    v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
    return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}
TRIAD_FUNCTION uint random_reverse_bits(uint v) {
    return RANDOM_FIRST_LANE(random_reverse_lanes((RandomLanes)(v)));
}
/* Owen's nested uniform scramble of numbers whose bits are reversed: a bit is flipped by a hash of the bits
 * below. */
TRIAD_FUNCTION RandomLanes random_owen_reversed(RandomLanes v, RandomLanes seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
}
/* Dimension 1 of Sobol's sequence with its bits reversed, from the index: Pascal's triangle modulo 2 as five
 * masked shifts. Dimension 0 with its bits reversed is the index itself. */
TRIAD_FUNCTION RandomLanes random_sobol1_reversed(RandomLanes index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

typedef struct Sampler {
    uint index_reversed;
    uint key0, key1;  /* of pixel, stream, seed and the upper half of the index */
    uint first_block; /* added to blocks that are asked for; SAMPLER_SOBOL_BLOCKS: all are hashed */
} Sampler;

/* pixel: index in the full picture. index, index_high: the 64-bit number of the sample within its stream;
 * after 2^32 samples a stream goes on with another scramble. stream: what is scrambled independently within a
 * pixel (bin, half). */
TRIAD_FUNCTION Sampler sampler_make(uint pixel, uint index, uint index_high, uint stream, uint seed) {
    UVec4 key = random_pcg4d(uvec4_make(pixel, index_high, stream, seed));
    Sampler s;
    s.index_reversed = random_reverse_bits(index);
    s.key0 = key.x;
    s.key1 = key.y;
    s.first_block = 0u;
    return s;
}

/* The four sets of a block: sets 4 block to 4 block + 3. */
typedef struct SamplerBlock {
    UVec2 set[4];
} SamplerBlock;

/* The first sets of a sample, scrambled and shuffled each for itself: both dimensions of set number `set`. */
TRIAD_FUNCTION void sampler_sobol(const Sampler* s, RandomLanes set, RandomLanes* x, RandomLanes* y) {
    /* lowbias32 */
    RandomLanes hash = s->key0 ^ (set * 0x9e3779b9u);
    hash = (hash ^ (hash >> 16)) * 0x7feb352du;
    hash = (hash ^ (hash >> 15)) * 0x846ca68bu;
    hash ^= hash >> 16;
    /* Owen-scrambled van der Corput numbers are a shuffled index with its bits reversed */
    const RandomLanes index =
        random_reverse_lanes(random_owen_reversed((RandomLanes)(s->index_reversed), hash));
    *x = random_reverse_lanes(random_owen_reversed(index, hash * 0x2c1b3c6du + s->key1));
    *y = random_reverse_lanes(
        random_owen_reversed(random_sobol1_reversed(index), (hash * 0x297a2d39u) ^ s->key1));
}

TRIAD_FUNCTION SamplerBlock sampler_block(const Sampler* s, uint block) {
    SamplerBlock b;
#if TRIAD_INDEPENDENT_SAMPLES
    block += s->first_block;
#endif
    if (block >= SAMPLER_SOBOL_BLOCKS) {
        /* pcg4d carries upwards only: the low bits of a reversed index would not see its neighbour's high
         * ones */
        const uint index = random_mix(s->index_reversed ^ s->key1);
        const UVec4 x = random_pcg4d(uvec4_make(s->key0, index, 2u * block, s->key1));
        const UVec4 y = random_pcg4d(uvec4_make(s->key0, index, 2u * block + 1u, s->key1));
        b.set[0] = uvec2_make(x.x, y.x), b.set[1] = uvec2_make(x.y, y.y);
        b.set[2] = uvec2_make(x.z, y.z), b.set[3] = uvec2_make(x.w, y.w);
        return b;
    }
#if TRIAD_ITEM_LANES
    uint4 x, y;
    sampler_sobol(s, 4u * block + (uint4)(0u, 1u, 2u, 3u), &x, &y);
    b.set[0] = uvec2_make(x.s0, y.s0), b.set[1] = uvec2_make(x.s1, y.s1);
    b.set[2] = uvec2_make(x.s2, y.s2), b.set[3] = uvec2_make(x.s3, y.s3);
#else
    /* no loop: only the innermost is vectorised, and that is to be the one over items */
    sampler_sobol(s, 4u * block, &b.set[0].x, &b.set[0].y);
    sampler_sobol(s, 4u * block + 1u, &b.set[1].x, &b.set[1].y);
    sampler_sobol(s, 4u * block + 2u, &b.set[2].x, &b.set[2].y);
    sampler_sobol(s, 4u * block + 3u, &b.set[3].x, &b.set[3].y);
#endif
    return b;
}

/* One set alone. */
TRIAD_FUNCTION UVec2 sampler_2d_bits(const Sampler* s, uint set) {
    const SamplerBlock b = sampler_block(s, set >> 2);
    const uint which = set & 3u;
    return which == 0u ? b.set[0] : which == 1u ? b.set[1] : which == 2u ? b.set[2] : b.set[3];
}
/* A set as a point in [0, 1)^2. */
TRIAD_FUNCTION Vec2 random_point(UVec2 bits) { return vec2_make(random_float(bits.x), random_float(bits.y)); }
TRIAD_FUNCTION Vec2 sampler_2d(const Sampler* s, uint set) { return random_point(sampler_2d_bits(s, set)); }

#endif
