/* What the stages of the denoiser share: where things lie in planes. The method: docs/denoise.md. */
#ifndef TRIAD_DENOISE_H
#define TRIAD_DENOISE_H

#include "common/language.h"

/* Neighbouring pixels that a work-item does at once: as many as a CPU's vectors hold; 1 where neighbours in
 * memory are to be neighbours in a work-group. */
#ifndef DENOISE_LANES
#define DENOISE_LANES 16
#endif
/* Guides of a pixel; 0: colours alone. */
#ifndef DENOISE_USED
#define DENOISE_USED DENOISE_GUIDES
#endif
/* Of a regression: a constant, and one term for each guide. */
#define DENOISE_TERMS (DENOISE_USED + 1)
#define DENOISE_GRAM (DENOISE_TERMS * (DENOISE_TERMS + 1) / 2)

/* Pixels on each side over which a half's variance, r, and errors are averaged. */
#define DENOISE_VARIANCE_REACH 3
#define DENOISE_ERROR_REACH 2
/* So many times as bright as what is around is a spark. */
#ifndef DENOISE_SPARK
#define DENOISE_SPARK 16.0f
#endif

/* Of a pixel, which may lie in the margin. */
TRIAD_FUNCTION size_t denoise_at(global const DenoiseShape* shape, int x, int y) {
    return (size_t)(y + DENOISE_MARGIN) * shape->stride + (size_t)(x + DENOISE_MARGIN);
}
TRIAD_FUNCTION int denoise_inside(int i, uint size) { return clamp(i, 0, (int)size - 1); }
/* Of entry (i, j), j <= i, in a lower triangle. */
#define DENOISE_ENTRY(i, j) ((i) * ((i) + 1) / 2 + (j))

#endif
