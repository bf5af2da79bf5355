/* Included first by every program: the dialect that all of Triad's kernels are written in. */
#ifndef TRIAD_LANGUAGE_H
#define TRIAD_LANGUAGE_H

/* Contraction would change bits between programs that share a function, and breaks watertightness: fma() is
 * written where it is meant. */
#pragma OPENCL FP_CONTRACT OFF

#include "common/builtins.h"
#include "features.h"
#include "types.h"

/* Device functions. `static` keeps OpenCL C 1.2 and 3.0 from asking for an external definition of an inline
 * function. */
#define TRIAD_FUNCTION static inline
/* Copied into every caller however large it is: callers pass constants that decide its shape, or the call
 * costs more than the copy. */
#define TRIAD_FUNCTION_PER_CALL static inline __attribute__((always_inline))
/* Compiled once: drivers that make several entry points of a kernel (PoCL makes two) would compile its body
 * for each. */
#define TRIAD_FUNCTION_ONCE static __attribute__((noinline))

/* 1: vector lanes lie within an item, whose program loops over whole paths. 0: items are the lanes of the
 * driver, and each is written in scalars (docs/kernels.md). */
#ifndef TRIAD_ITEM_LANES
#define TRIAD_ITEM_LANES 1
#endif

/* Asks for the cache line of a global address that is read some hundred cycles later. Only where it is one
 * instruction and the language's prefetch() does nothing (PoCL 3.1 on x86). */
#ifdef __x86_64__
#define TRIAD_PREFETCH(address) __builtin_prefetch((const void*)(size_t)(address))
#else
#define TRIAD_PREFETCH(address) ((void)(address))
#endif

#endif
