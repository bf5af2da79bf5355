/* Where the pixels of tiles lie, and what a sample of a pixel is called: bin, half, random numbers, camera
 * ray.
 */
#ifndef TRIAD_SHADING_SAMPLE_H
#define TRIAD_SHADING_SAMPLE_H

#include "common/random.h"
#include "shading/camera.h"
#include "shading/ray_filter.h"

/* Film position of pixel i of the crop, counted tile by tile, so that neighbours in a work-group are
 * neighbours in the picture. Outside the crop (ragged edges): returns 0. */
TRIAD_FUNCTION int sample_pixel(const uint crop[4], uint i, uint* x, uint* y) {
    const uint tiles = (crop[2] + FILM_TILE - 1u) / FILM_TILE;
    const uint tile = i / FILM_TILE_PIXELS, in_tile = i % FILM_TILE_PIXELS;
    *x = tile % tiles * FILM_TILE + in_tile % FILM_TILE;
    *y = tile / tiles * FILM_TILE + in_tile / FILM_TILE;
    return *x < crop[2] && *y < crop[3];
}

/* Sample s of a pixel: which bin and half it falls into, and its samplers. Within a pixel the bins take
 * turns, each pixel from another one; the halves take turns after every bin had one. */
typedef struct SampleName {
    uint bin, half_index;
    Sampler position; /* of the film position within the bin */
    Sampler path;     /* of everything else */
} SampleName;

TRIAD_FUNCTION SampleName sample_name(const Frame* frame, uint pixel, ulong s) {
    SampleName name;
    const uint bins = frame->bins[0] * frame->bins[1];
#if TRIAD_BINS
    const ulong round = s / bins;
    const uint turn = (uint)(s % bins);
    name.bin = (turn + random_mix(pixel ^ frame->seed) % bins) % bins;
#else
    const ulong round = s;
    const uint turn = 0u;
    name.bin = 0u;
#endif
    name.half_index = (uint)(round & 1ul);
    const ulong index = (round >> 1) * bins + turn;
    name.path = sampler_make(pixel, (uint)index, (uint)(index >> 32), name.half_index, frame->seed);
    name.path.first_block = frame->first_block;
#if TRIAD_BINS
    if (bins > 1u) {
        name.position = sampler_make(pixel, (uint)(round >> 1), (uint)(round >> 33),
                                     2u + 2u * name.bin + name.half_index, frame->seed);
        name.position.first_block = frame->first_block;
        return name;
    }
#endif
    name.position = name.path;
    return name;
}

/* Of what comes along a ray, in R, G, B and alpha: what counts for the film. Set only where TRIAD_RAY_STARTS.
 */
typedef Vec4 SampleWeight;

TRIAD_FUNCTION Vec4 sample_weighted(Vec4 value, SampleWeight weight) {
#if TRIAD_RAY_STARTS
    return vec4_mul(value, weight);
#else
    (void)weight;
    return value;
#endif
}

TRIAD_FUNCTION Ray sample_camera_ray(const Frame* frame, global const float* ray_filter,
                                     const SampleName* name, uint x, uint y, SampleWeight* weight) {
    const SamplerBlock u = sampler_block(&name->position, 0u);
    Vec2 at = random_point(u.set[0]);
    Camera camera = frame->camera;
    *weight = vec4_splat(1.0f);
#if TRIAD_RAY_STARTS
    if (frame->ray_start == RAY_START_FILTER) {
        Vec3 counts;
        at = ray_filter_sample(frame, ray_filter, frame->crop[0] + x, frame->crop[1] + y, name->bin, at,
                               &counts);
        *weight = vec3_with(counts, vec3_average(counts));
    } else
#endif
    {
#if TRIAD_BINS
        at.x = (at.x + (float)(name->bin % frame->bins[0])) / (float)frame->bins[0];
        at.y = (at.y + (float)(name->bin / frame->bins[0])) / (float)frame->bins[1];
#endif
    }
    Vec2 position = vec2_make((float)(frame->crop[0] + x) + at.x, (float)(frame->crop[1] + y) + at.y);
#if TRIAD_RAY_STARTS
    if (frame->ray_start == RAY_START_CENTRE) {
        /* The centre of a pixel of the picture whose pixels are the bins: the same bits as of that picture.
         */
        const UVec2 bins = uvec2_make(frame->bins[0], frame->bins[1]);
        position.x = (float)((frame->crop[0] + x) * bins.x + name->bin % bins.x) + 0.5f;
        position.y = (float)((frame->crop[1] + y) * bins.y + name->bin / bins.x) + 0.5f;
        camera.pixels[0] *= (float)bins.x, camera.pixels[1] *= (float)bins.y;
    }
#endif
    return camera_ray(&camera, position.x, position.y,
#if TRIAD_LENS
                      sampler_2d(&name->path, 1u)
#else
                      vec2_splat(0.0f)
#endif
    );
}

#endif
