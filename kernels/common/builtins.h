/* fma, fabs, floor, ceil, sqrt and copysign as instructions: the compiler's own builtins where it knows them;
 * so too, where OpenCL's are not copied into their callers, loads and stores of vectors and the few functions
 * of integers that kernels use. OpenCL's are calls in some drivers (PoCL 6), which cost nanoseconds and keep
 * loops over work-items from being vectorised. Bits are the same (`triad check`, M11 to M13). Where all
 * operands are of one type they take vectors too, except copysign and sqrt with compilers that have them for
 * scalars alone.
 *
 * Some drivers have macros of these names. min, max and clamp of floats are ternaries of math.h, and
 * conversions are casts: no calls on any driver. */
#ifndef TRIAD_COMMON_BUILTINS_H
#define TRIAD_COMMON_BUILTINS_H

/* Only where the driver compiles for the processor itself (PoCL): not all that read SPIR know the builtins'
 * intrinsics (Oclgrind stops at them). */
#if defined(__has_builtin) && (defined(__x86_64__) || defined(__aarch64__))
#define TRIAD_HAS_BUILTIN(name) __has_builtin(name)
#else
#define TRIAD_HAS_BUILTIN(name) 0
#endif

/* Before the name is taken from OpenCL's, which is one instruction for eight in PoCL 3.1. */
static inline float8 builtin_sqrt8(float8 x) { return sqrt(x); }

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

/* PoCL with LLVM 17 or later. Vectors are read and written at the alignment of their elements; for a type or
 * an address space that is not listed here, add a line. */
#if TRIAD_HAS_BUILTIN(__builtin_elementwise_fma)
#define BUILTIN static inline __attribute__((always_inline, overloadable))
#define BUILTIN_LOAD(type, lanes)                                                                        \
    typedef type Unaligned_##type##lanes __attribute__((ext_vector_type(lanes), aligned(sizeof(type)))); \
    BUILTIN type##lanes builtin_load##lanes(size_t i, const global type* p) {                            \
        return *(const global Unaligned_##type##lanes*)(p + lanes * i);                                  \
    }
#define BUILTIN_STORE(type, lanes, space)                                       \
    BUILTIN void builtin_store##lanes(type##lanes v, size_t i, space type* p) { \
        *(space Unaligned_##type##lanes*)(p + lanes * i) = v;                   \
    }
BUILTIN_LOAD(float, 4)
BUILTIN_LOAD(float, 8)
BUILTIN_LOAD(float, 16)
BUILTIN_LOAD(uint, 4)
BUILTIN_LOAD(uint, 8)
BUILTIN_LOAD(ushort, 16)
BUILTIN_STORE(float, 4, private)
BUILTIN_STORE(float, 8, private)
BUILTIN_STORE(float, 16, global)
#undef vload4
#undef vload8
#undef vload16
#undef vstore4
#undef vstore8
#undef vstore16
#define vload4 builtin_load4
#define vload8 builtin_load8
#define vload16 builtin_load16
#define vstore4 builtin_store4
#define vstore8 builtin_store8
#define vstore16 builtin_store16

BUILTIN uint builtin_clz(uint x) { return x ? (uint)__builtin_clz(x) : 32u; }
BUILTIN ulong builtin_clz(ulong x) { return x ? (ulong)__builtin_clzl(x) : 64u; }
BUILTIN ulong builtin_popcount(ulong x) { return (ulong)__builtin_popcountl(x); }
BUILTIN long builtin_add_sat(long a, long b) { return __builtin_elementwise_add_sat(a, b); }
BUILTIN ulong builtin_min(ulong a, ulong b) { return b < a ? b : a; }
BUILTIN ulong builtin_max(ulong a, ulong b) { return a < b ? b : a; }
#undef clz
#undef popcount
#undef add_sat
#undef min
#undef max
#define clz builtin_clz
#define popcount builtin_popcount
#define add_sat builtin_add_sat
#define min builtin_min
#define max builtin_max
#endif

#endif
