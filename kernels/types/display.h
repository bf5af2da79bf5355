/* From bins to the drives of a display. Part of types.h. */
#ifndef TRIAD_TYPES_DISPLAY_H
#define TRIAD_TYPES_DISPLAY_H

#include "types/border.h"

TRIAD_TYPES_BEGIN

/* Tone maps of kernels/subpixel/tone_map.h */
#define TONE_MAP_NONE 0u
#define TONE_MAP_KHRONOS 1u
#define TONE_MAP_ACES 2u
#define TONE_MAP_AGX 3u

/* Tone maps of noisy bins (kernels/subpixel/noise.h): floats kept of a pixel, pixels looked at around. */
#define NOISE_RECORD 20
#define NOISE_REACH 3

/* When the pipeline from bins to drives (kernels/subpixel/) maps tones */
#define TONE_PER_PIXEL 0u   /* what the taps have added up */
#define TONE_PER_BIN 1u     /* every bin, so that the taps add light that a display shows */
#define TONE_NEVER 3u       /* scene-linear radiance goes through */
#define TONE_BIN_ENCODED 2u /* every bin, and the taps add its sRGB-encoded values */

/* Some rows of the picture on their way from bins to drives. Values lie in planes, one for each channel and
 * each column of a cell of pixels, [channel][column][row][cell]: neighbours in memory are the same column of
 * neighbouring cells, which share their taps. A plane has cells left and right of the picture, and rows above
 * and below, that taps reach. */
typedef struct DisplaySlab {
    uint width, height; /* of the picture, in pixels */
    uint columns, rows; /* of the source, in bins: reflected about its edges where it has no bin */
    uint bins[2];       /* per pixel */
    uint cell_x;        /* pixels of a cell, across */
    uint channels;      /* of the planes: 3, or 4 with alpha */
    uint left;          /* cells of a row before the picture's first */
    uint stride;        /* floats of a row of a plane of bins */
    uint plane;         /* floats of a plane of bins */
    int first_row;      /* of the planes of bins: a row of bins of the picture */
    uint source_row; /* first row that is in the source's buffer: of pixels of a film, of bins of an image */
    uint tone_map;   /* TONE_MAP_* */
    uint order;      /* TONE_PER_PIXEL ... */
    uint encoded;    /* 1: the source holds sRGB-encoded values, which are not to be tone-mapped again */
    float unit;      /* of a film's sums */
    float exposure;  /* factor of radiance */
    float background[4]; /* display-linear; the last is 1 where there is one, else 0 */
} DisplaySlab;
TRIAD_SIZE(DisplaySlab, 88);

TRIAD_TYPES_END

#endif
