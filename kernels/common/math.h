/* Scalar mathematics for every kernel: polynomials in + - * and fma, integer operations and conversions
 * alone, so that the bits are the same on every device and the cost is a few nanoseconds where the builtins
 * take 15 to 100.
 *
 * Policy: sqrt() and / are the builtins; they are correctly rounded where the device offers the build flag
 * (else 3 and 2.5 ulp). fma() is correctly rounded everywhere. min and max are ternaries: a NaN in the first
 * operand is dropped.
 *
 * Largest error against double, in ulp, found by the device test `Math` over dense samples of the stated
 * range:
 * - math_sin_turns, math_cos_turns: 1.1 of max(|result|, 2^-10); |turns| < 2^22
 * - math_sin, math_cos: 1.6 of max(|result|, 2^-10); |x| <= 1024
 * - math_exp2: 0.9; the result is normal, 0 below 2^-126, infinity from 2^128
 * - math_exp: 1.1; the result as of exp2
 * - math_log, math_log2: 1.2; x > 0 and normal
 * - math_pow: 1.6 for |y| <= 3, 0.2 |y| beyond; x > 0 and the result normal
 * - math_atan2: 1.7; finite, not both 0
 * - math_acos: 1.2 of max(result, 2^-10); |x| <= 1
 */
#ifndef TRIAD_COMMON_MATH_H
#define TRIAD_COMMON_MATH_H

#include "common/language.h"

#define MATH_PI 3.14159265358979f
#define MATH_TWO_PI 6.28318530717959f
#define MATH_INV_PI 0.318309886183791f

TRIAD_FUNCTION float math_min(float a, float b) { return a < b ? a : b; }
TRIAD_FUNCTION float math_max(float a, float b) { return a > b ? a : b; }
TRIAD_FUNCTION float math_saturate(float x) { return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; }
TRIAD_FUNCTION float math_clamp(float x, float lo, float hi) { return x > lo ? (x < hi ? x : hi) : lo; }
TRIAD_FUNCTION int math_clamp_int(int i, int lo, int hi) { return i > lo ? (i < hi ? i : hi) : lo; }
TRIAD_FUNCTION int math_min_int(int a, int b) { return b < a ? b : a; }
TRIAD_FUNCTION uint math_min_uint(uint a, uint b) { return b < a ? b : a; }
TRIAD_FUNCTION uint math_max_uint(uint a, uint b) { return a < b ? b : a; }
TRIAD_FUNCTION float math_square(float x) { return x * x; }
TRIAD_FUNCTION float math_mix(float a, float b, float t) { return fma(t, b - a, a); }

/* Square root of max(x, 0): rounding below zero is no NaN. */
TRIAD_FUNCTION float math_sqrt(float x) { return sqrt(x > 0.0f ? x : 0.0f); }

/* By bits, because a compiler may fold x == x. False for infinities and NaN. */
TRIAD_FUNCTION uint math_is_finite(float x) { return (as_uint(x) & 0x7f800000u) != 0x7f800000u; }

/* |x| < 2^31. */
TRIAD_FUNCTION int math_floor_int(float x) {
    int i = (int)x;
    return i - ((float)i > x);
}
TRIAD_FUNCTION float math_floor(float x) { return (float)math_floor_int(x); }
/* Nearest integer, halves upward; |x| < 2^22. */
TRIAD_FUNCTION int math_round_int(float x) { return math_floor_int(x + 0.5f); }

/* a b - c d with an error of at most 1.5 ulp of the result (Kahan; Jeannerod, Louvet, Muller 2013). */
TRIAD_FUNCTION float math_difference_of_products(float a, float b, float c, float d) {
    float cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

/* sin and cos of 2 pi turns; |turns| < 2^22. */
TRIAD_FUNCTION void math_sincos_turns(float turns, float* s, float* c) {
    int k = math_round_int(4.0f * turns);
    float r = fma((float)k, -0.25f, turns); /* exact, in [-1/8, 1/8] */
    float q = r * r;
    float p =
        fma(fma(fma(4.158954239e+01f, q, -7.670128632e+01f), q, 8.160523224e+01f), q, -4.134170151e+01f);
    float sine = fma(r, 6.283185482f, r * fma(q, p, -1.748455531e-07f));
    p = fma(fma(fma(5.942410660e+01f, q, -8.544882202e+01f), q, 6.493936920e+01f), q, -1.973920822e+01f);
    float cosine = fma(q, p, 1.0f);
    float a = k & 1 ? cosine : sine;
    float b = k & 1 ? sine : cosine;
    *s = k & 2 ? -a : a;
    *c = (k + 1) & 2 ? -b : b;
}
TRIAD_FUNCTION float math_sin_turns(float turns) {
    float s, c;
    math_sincos_turns(turns, &s, &c);
    return s;
}
TRIAD_FUNCTION float math_cos_turns(float turns) {
    float s, c;
    math_sincos_turns(turns, &s, &c);
    return c;
}

/* sin and cos for |x| <= pi / 4, without range reduction. */
TRIAD_FUNCTION void math_sincos_octant(float x, float* s, float* c) {
    float q = x * x;
    float p = fma(fma(-1.958789071e-04f, q, 8.332747966e-03f), q, -1.666666418e-01f);
    *s = fma(x * q, p, x);
    p = fma(fma(2.454794230e-05f, q, -1.388830249e-03f), q, 4.166666418e-02f);
    *c = fma(q * q, p, fma(-0.5f, q, 1.0f));
}

/* sin and cos of x in radians; |x| <= 1024 (Cody and Waite's reduction, pi / 2 in two parts). */
TRIAD_FUNCTION void math_sincos(float x, float* s, float* c) {
    int k = math_round_int(x * 6.366197467e-01f);
    float n = (float)k;
    float r = fma(n, -1.570796371f, x);
    r = fma(n, 4.371138829e-08f, r);
    float sine, cosine;
    math_sincos_octant(r, &sine, &cosine);
    float a = k & 1 ? cosine : sine;
    float b = k & 1 ? sine : cosine;
    *s = k & 2 ? -a : a;
    *c = (k + 1) & 2 ? -b : b;
}
TRIAD_FUNCTION float math_sin(float x) {
    float s, c;
    math_sincos(x, &s, &c);
    return s;
}
TRIAD_FUNCTION float math_cos(float x) {
    float s, c;
    math_sincos(x, &s, &c);
    return c;
}

/* 2^n (1 + small): the tail shared by exp and exp2. 2^f for f in [-1/2, 1/2], n in [-126, 128]. */
TRIAD_FUNCTION float math_exp2_parts(int n, float f) {
    float p = fma(1.529732435e-05f, f, 1.546144485e-04f);
    p = fma(p, f, 1.333350199e-03f);
    p = fma(p, f, 9.618056938e-03f);
    p = fma(p, f, 5.550410971e-02f);
    p = fma(p, f, 2.402265072e-01f);
    p = fma(p, f, 6.931471825e-01f);
    p = fma(p, f, 1.0f);
    int half_n = n >> 1; /* two steps, so that n = 128 does not overflow before p < 1 is applied */
    return p * as_float((half_n + 127) << 23) * as_float((n - half_n + 127) << 23);
}
TRIAD_FUNCTION float math_exp2(float x) {
    if (!(x >= -126.0f)) return x != x ? x : 0.0f;
    if (x >= 128.0f) return INFINITY;
    int n = math_round_int(x);
    return math_exp2_parts(n, x - (float)n);
}
TRIAD_FUNCTION float math_exp(float x) {
    if (!(x >= -87.336544f)) return x != x ? x : 0.0f;
    if (x > 88.722839f) return INFINITY;
    int n = math_round_int(x * 1.442695022f);
    float r = fma((float)n, -6.931471825e-01f, x); /* exact: ln 2 in two parts */
    r = fma((float)n, 1.904654212e-09f, r);
    return math_exp2_parts(n, fma(r, 1.442695022f, r * 1.925963034e-08f));
}

/* x = 2^e (1 + f), 1 + f in [sqrt 1/2, sqrt 2): returns f, log(1 + f) = f + *tail. x positive and normal. */
TRIAD_FUNCTION float math_log_parts(float x, int* e, float* tail) {
    uint bits = as_uint(x) + (0x3f800000u - 0x3f3504f3u);
    *e = (int)(bits >> 23) - 127;
    float f = as_float((bits & 0x007fffffu) + 0x3f3504f3u) - 1.0f;
    float q = f * f;
    float p = fma(6.971611828e-02f, f, -1.147973388e-01f);
    p = fma(p, f, 1.168541983e-01f);
    p = fma(p, f, -1.242568716e-01f);
    p = fma(p, f, 1.424905807e-01f);
    p = fma(p, f, -1.666780263e-01f);
    p = fma(p, f, 2.000071555e-01f);
    p = fma(p, f, -2.499999702e-01f);
    p = fma(p, f, 3.333333135e-01f);
    *tail = fma(-0.5f, q, f * q * p);
    return f;
}
/* x > 0 and normal; -infinity at 0 and below the normal range. */
TRIAD_FUNCTION float math_log(float x) {
    if (!(x >= 1.17549435e-38f)) return -INFINITY;
    int e;
    float tail;
    float f = math_log_parts(x, &e, &tail);
    float n = (float)e;
    return fma(n, 6.931471825e-01f, f + fma(n, -1.904654212e-09f, tail));
}
/* log2(1 + f) = result + *lo, not rounded to one float, from f and the tail of math_log_parts. */
TRIAD_FUNCTION float math_log2_fraction(float f, float tail, float* lo) {
    float product = f * 1.442695022f;
    float rest = fma(f, 1.442695022f, -product) + fma(tail, 1.442695022f, f * 1.925963034e-08f);
    float hi = product + rest;
    *lo = (product - hi) + rest;
    return hi;
}
TRIAD_FUNCTION float math_log2(float x) {
    if (!(x >= 1.17549435e-38f)) return -INFINITY;
    int e;
    float tail, lo;
    float f = math_log_parts(x, &e, &tail);
    float hi = math_log2_fraction(f, tail, &lo);
    return ((float)e + hi) + lo;
}
/* x^y for x >= 0; 0^0 = 1. */
TRIAD_FUNCTION float math_pow(float x, float y) {
    if (y == 0.0f) return 1.0f;
    if (!(x >= 1.17549435e-38f)) return x != x ? x : (y > 0.0f ? 0.0f : INFINITY);
    int e;
    float tail, lo;
    float f = math_log_parts(x, &e, &tail);
    float hi = math_log2_fraction(f, tail, &lo);
    /* y log2 x = whole + rest: the product with the exponent and the high part keep their rounding errors */
    float a = y * (float)e, a_lo = fma(y, (float)e, -a);
    float b = y * hi, b_lo = fma(y, lo, fma(y, hi, -b));
    if (a + b >= 129.0f) return INFINITY;
    if (a + b < -127.0f) return 0.0f;
    float n_a = math_floor(a + 0.5f);
    float rest = (a - n_a) + b;
    float n_b = math_floor(rest + 0.5f);
    rest = ((b - n_b) + (a - n_a)) + (a_lo + b_lo);
    int n = (int)(n_a + n_b);
    if (n > 128) return INFINITY;
    return n < -126 ? 0.0f : math_exp2_parts(n, rest);
}

/* Angle of (x, y) in (-pi, pi]; 0 for (0, 0). */
TRIAD_FUNCTION float math_atan2(float y, float x) {
    float ax = fabs(x), ay = fabs(y);
    float lo = math_min(ax, ay), hi = math_max(ax, ay);
    float z = hi > 0.0f ? lo / hi : 0.0f;
    float q = z * z;
    float p = fma(-2.386997221e-03f, q, 1.350777131e-02f);
    p = fma(p, q, -3.587153926e-02f);
    p = fma(p, q, 6.250169128e-02f);
    p = fma(p, q, -8.656880260e-02f);
    p = fma(p, q, 1.103376448e-01f);
    p = fma(p, q, -1.427856833e-01f);
    p = fma(p, q, 1.999973953e-01f);
    p = fma(p, q, -3.333333135e-01f);
    float angle = fma(z * q, p, z);
    angle = ay > ax ? 1.570796371f - (angle + 4.371138829e-08f) : angle;
    angle = as_int(x) < 0 ? 3.141592741f - (angle + 8.742277657e-08f) : angle;
    return as_int(y) < 0 ? -angle : angle;
}
/* acos of x clamped to [-1, 1]. */
TRIAD_FUNCTION float math_acos(float x) {
    float a = math_min(fabs(x), 1.0f);
    uint outer = a > 0.5f;
    float q = outer ? 0.5f * (1.0f - a) : a * a; /* asin(a) = pi/2 - 2 asin(sqrt((1 - a) / 2)) */
    float z = outer ? sqrt(q) : a;
    float p = fma(3.369084746e-02f, q, 1.714923792e-02f);
    p = fma(p, q, 3.110066243e-02f);
    p = fma(p, q, 4.459940270e-02f);
    p = fma(p, q, 7.500094175e-02f);
    p = fma(p, q, 1.666666567e-01f);
    float arc_sine = fma(z * q, p, z);
    if (outer) return x > 0.0f ? 2.0f * arc_sine : 3.141592741f - (2.0f * arc_sine + 8.742277657e-08f);
    return 1.570796371f - (x > 0.0f ? arc_sine + 4.371138829e-08f : 4.371138829e-08f - arc_sine);
}

#endif
