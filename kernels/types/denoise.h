/* From noisy pixels to the denoised picture. Part of types.h. */
#ifndef TRIAD_TYPES_DENOISE_H
#define TRIAD_TYPES_DENOISE_H

#include "types/border.h"

TRIAD_TYPES_BEGIN

/* Guides of a pixel in a film, which follow from the first surface: albedo (3), shading normal (3), depth. */
#define DENOISE_GUIDES 7
/* Pixels on each side that a pixel looks at. */
#define DENOISE_REACH 5
#define DENOISE_SIDE (2 * DENOISE_REACH + 1)
/* Pixels on each side of a patch, at most. */
#define DENOISE_PATCH 3
/* Cells around the picture that planes have, which go on as its edge: those that are looked at, with their
 * patches, in whole vectors. */
#define DENOISE_MARGIN 16

/* Planes of what the samples say, one after the other. */
#define DENOISE_FIRST 0u    /* [3] mean of the first half */
#define DENOISE_SECOND 3u   /* [3] of the second */
#define DENOISE_VARIANCE 6u /* [3] of a half, from those around */
#define DENOISE_WEIGHT 9u   /* [3] of a squared error: 1 / (r^2 + 0.01), r from those around */
#define DENOISE_PLANES 12u

/* How planes lie: rows of `stride` floats, height + 2 DENOISE_MARGIN of them, DENOISE_MARGIN cells before the
 * picture's first in each. */
typedef struct DenoiseShape {
    uint width, height; /* of the picture */
    uint stride, plane; /* floats of a row, and of a plane */
    float middle_depth; /* half of the range of the guide of depth lies beyond it */
} DenoiseShape;
TRIAD_SIZE(DenoiseShape, 20);

TRIAD_TYPES_END

#endif
