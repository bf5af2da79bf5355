/* Neighbours in memory that a work-item does at once. LANES, defined before this is included: 16, as many as
 * a CPU's vectors hold, or 1, where neighbours in memory are to be neighbours in a work-group. */
#ifndef TRIAD_COMMON_LANES_H
#define TRIAD_COMMON_LANES_H

#include "common/language.h"

#if LANES == 16
#ifdef __clang__ /* functions are copied into callers: none hands a vector over as the warning fears */
#pragma clang diagnostic ignored "-Wpsabi"
#endif
typedef float16 Lanes;
#define LANES_LOAD(p) vload16(0, p)
#define LANES_STORE(v, p) vstore16(v, 0, p)
#define LANES_INDICES ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#define LANES_WHERE(condition, v) select((Lanes)(0.0f), v, condition)
#elif LANES == 1
typedef float Lanes;
#define LANES_LOAD(p) (*(p))
#define LANES_STORE(v, p) (*(p) = (v))
#define LANES_INDICES 0
#define LANES_WHERE(condition, v) ((condition) ? (v) : 0.0f)
#endif

#endif
