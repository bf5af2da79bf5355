/* fma, fabs, floor, ceil, sqrt and copysign as instructions: the compiler's own builtins where it knows them.
 * OpenCL's are calls in some drivers (PoCL 6), which cost nanoseconds and keep loops over work-items from
 * being vectorised. Bits are the same (`triad check`, M11). Where all operands are of one type they take
 * vectors too, except copysign and sqrt with compilers that have them for scalars alone.
 *
 * Some drivers have macros of these names. min, max and clamp are ternaries of math.h, and conversions are
 * casts: no calls on any driver. */
#ifndef TRIAD_COMMON_BUILTINS_H
#define TRIAD_COMMON_BUILTINS_H

/* Only where the driver compiles for the processor itself (PoCL): not all that read SPIR know the builtins'
 * intrinsics (Oclgrind stops at them). */
#if defined(__has_builtin) && (defined(__x86_64__) || defined(__aarch64__))
#define TRIAD_HAS_BUILTIN(name) __has_builtin(name)
#else
#define TRIAD_HAS_BUILTIN(name) 0
#endif

#if TRIAD_HAS_BUILTIN(__builtin_elementwise_fma)
#undef fma
#define fma(a, b, c) __builtin_elementwise_fma(a, b, c)
#endif
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_abs)
#undef fabs
#define fabs(x) __builtin_elementwise_abs(x)
#endif
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_floor)
#undef floor
#define floor(x) __builtin_elementwise_floor(x)
#endif
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_ceil)
#undef ceil
#define ceil(x) __builtin_elementwise_ceil(x)
#endif
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_sqrt)
#undef sqrt
#define sqrt(x) __builtin_elementwise_sqrt(x)
#elif TRIAD_HAS_BUILTIN(__builtin_sqrtf)
#undef sqrt
#define sqrt(x) __builtin_sqrtf(x)
#endif
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_copysign)
#undef copysign
#define copysign(x, y) __builtin_elementwise_copysign(x, y)
#elif TRIAD_HAS_BUILTIN(__builtin_copysignf)
#undef copysign
#define copysign(x, y) __builtin_copysignf(x, y)
#endif

#endif
