/* Included first by every program: the dialect that all of Triad's kernels are written in. */
#ifndef TRIAD_LANGUAGE_H
#define TRIAD_LANGUAGE_H

/* Contraction would change bits between programs that share a function, and breaks watertightness: fma() is
 * written where it is meant. */
#pragma OPENCL FP_CONTRACT OFF

/* 0: rays walk nodes of eight boxes, all at once in vectors (types.h, Bvh8Node). 1: of four, one at a time,
 * with a short stack (Bvh4Node). Hits are the same bit for bit. */
#ifndef TRIAD_BVH4
#define TRIAD_BVH4 0
#endif

/* 1: the camera's rays are walked in packets (traversal/packet.h), which takes nodes of eight boxes and pays
 * on CPUs (host/trace/node_format.h). Hits are the same bit for bit. */
#if !defined(TRIAD_PACKETS) || TRIAD_BVH4
#undef TRIAD_PACKETS
#define TRIAD_PACKETS 0
#endif

#include "common/builtins.h"
#include "features.h"
#include "types.h"

/* 1: vector lanes lie within an item, which follows whole paths. 0: the items of a stage are the lanes, and
 * everything on the way is scalar, inlined and without loops (docs/kernels.md). */
#ifndef TRIAD_ITEM_LANES
#define TRIAD_ITEM_LANES 1
#endif

/* 1: functions are copied into their callers, with what they hand to each other (docs/kernels.md). */
#ifndef TRIAD_INLINED
#define TRIAD_INLINED !TRIAD_ITEM_LANES
#endif

/* Device functions. `static` keeps OpenCL C 1.2 and 3.0 from asking for an external definition of an inline
 * function. None writes to a struct that it takes by value: Mesa's drivers (22.3.6) make no copy of it, and
 * the caller's variable would change (docs/kernels.md). */
#if TRIAD_INLINED && !defined(TRIAD_CALLS)
#define TRIAD_FUNCTION static inline __attribute__((always_inline))
#else
#define TRIAD_FUNCTION static inline
#endif
/* Copied into every caller however large it is: callers pass constants that decide its shape, or the call
 * costs more than the copy. */
#ifdef TRIAD_CALLS /* tests/drivers/oclgrind.sh: Oclgrind 21.10 stops at what inlining a struct leaves \
                      behind */
#define TRIAD_FUNCTION_PER_CALL static inline
#else
#define TRIAD_FUNCTION_PER_CALL static inline __attribute__((always_inline))
#endif
/* Compiled once: drivers that make several entry points of a kernel (PoCL makes two) would compile its body
 * for each. */
#define TRIAD_FUNCTION_ONCE static __attribute__((noinline))
/* All that a kernel does; where functions are copied, into the kernel: its arguments then lie in no memory of
 * the item. */
#if TRIAD_INLINED && !defined(TRIAD_CALLS)
#define TRIAD_FUNCTION_WHOLE TRIAD_FUNCTION
#else
#define TRIAD_FUNCTION_WHOLE TRIAD_FUNCTION_ONCE
#endif

/* A loop of `length` rounds, at most a constant `most`: where items are the lanes it is no loop, for only the
 * innermost one is vectorised, and that is to be the one over items. */
#if TRIAD_ITEM_LANES
#define TRIAD_FOR(i, length, most) for (uint i = 0u; i < (length); ++i)
#else
#define TRIAD_FOR(i, length, most) _Pragma("unroll") for (uint i = 0u; i < (most); ++i) if (i < (length))
#endif

/* The items of a kernel, which are independent: a work-item takes TRIAD_RUN of them, one after the other.
 * With more than one, the compiler makes them lanes, also where the driver would not (docs/kernels.md). No
 * return, break or continue within. */
#ifndef TRIAD_RUN
#define TRIAD_RUN 1
#endif
#if TRIAD_RUN > 1
#pragma clang diagnostic ignored "-Wpass-failed" /* where it cannot: triad bench kernels shows that */
#define TRIAD_ITEMS(i, count)                                                                 \
    const size_t i##_first = get_global_id(0) * TRIAD_RUN,                                    \
                 i##_end = i##_first + TRIAD_RUN < (count) ? i##_first + TRIAD_RUN : (count); \
    _Pragma("clang loop vectorize(assume_safety)") for (size_t i = i##_first; i < i##_end; ++i)
#else
#define TRIAD_ITEMS(i, count)          \
    const size_t i = get_global_id(0); \
    if (i < (count))
#endif

/* Asks for the cache line of a global address that is read some hundred cycles later. Only where it is one
 * instruction and the language's prefetch() does nothing (PoCL 3.1 on x86), and keeps no vectoriser away. */
#if defined(__x86_64__) && TRIAD_ITEM_LANES
#define TRIAD_PREFETCH(address) __builtin_prefetch((const void*)(size_t)(address))
#else
#define TRIAD_PREFETCH(address) ((void)(address))
#endif

#endif
