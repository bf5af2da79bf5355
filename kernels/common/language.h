/* Included first by every program: the dialect that all of Triad's kernels are written in. */
#ifndef TRIAD_LANGUAGE_H
#define TRIAD_LANGUAGE_H

/* Contraction would change bits between programs that share a function, and breaks watertightness: fma() is written
 * where it is meant. */
#pragma OPENCL FP_CONTRACT OFF

#include "types.h"
#include "features.h"

/* Device functions. `static` keeps OpenCL C 1.2 and 3.0 from asking for an external definition of an inline function. */
#define TRIAD_FUNCTION static inline

#endif
