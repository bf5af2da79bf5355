/* The film: order-free sums in 64-bit fixed point. One work-item owns a pixel during a launch, so no atomics.
 */
#ifndef TRIAD_COMMON_FILM_H
#define TRIAD_COMMON_FILM_H

#include "common/vector.h"

/* x in units of the quantum, rounded to nearest; sets *saturated when it would not leave room for other
 * samples. */
TRIAD_FUNCTION long film_fixed(float x, float quanta, uint* saturated) {
    const float q = x * quanta;
    if (q >= 0x1.0p62f || q <= -0x1.0p62f) {
        *saturated = 1u;
        return q > 0.0f ? 0x4000000000000000L : -0x4000000000000000L;
    }
    /* convert_long_rte, which PoCL emulates with branches: adding 2^23 leaves no fraction, rounded to even */
    const float shift = copysign(0x1.0p23f, q);
    return (long)(fabs(q) < 0x1.0p23f ? (q + shift) - shift : q);
}

TRIAD_FUNCTION int film_is_finite(Vec4 c) {
    return math_is_finite(c.x) && math_is_finite(c.y) && math_is_finite(c.z) && math_is_finite(c.w);
}

/* Adds to a 64-bit counter kept as two uints. */
TRIAD_FUNCTION void counter_add(volatile global uint* counters, uint which, uint amount) {
    if (amount == 0u) return;
    const uint old = atomic_add(counters + 2u * which, amount);
    if (old + amount < old) atomic_inc(counters + 2u * which + 1u);
}

#endif
