/* From scene-linear radiance (linear Rec.709, exposure applied) to display-linear light in [0, 1].
 * Any float may come: NaN counts as 0, and what is beyond TONE_LIMIT as that. Colours outside Rec.709, which
 * single wavelengths are, are brought into it first; this is the only place where that happens. */
#ifndef TRIAD_TONE_MAP_H
#define TRIAD_TONE_MAP_H

#include "common/vector.h"

#define TONE_LIMIT 1e10f /* squares of it, which the ACES fit takes, are still finite */

TRIAD_FUNCTION float tone_map_input(float x) {
    return x > -TONE_LIMIT ? (x < TONE_LIMIT ? x : TONE_LIMIT) : x <= -TONE_LIMIT ? -TONE_LIMIT : 0.0f;
}

/* A colour with negative channels, mixed with the grey of its luminance until none is: brightness and hue
 * stay. Without luminance it is black. */
TRIAD_FUNCTION Vec3 tone_map_gamut(Vec3 c) {
    const float least = math_min(c.x, math_min(c.y, c.z));
    if (least >= 0.0f) return c;
    const float y = vec3_luminance(c);
    const Vec3 grey = vec3_splat(y), mixed = vec3_fma_scale(y / (y - least), vec3_sub(c, grey), grey);
    return y > 0.0f ? vec3_at_least(mixed, vec3_splat(0.0f)) : vec3_splat(0.0f);
}

/* Khronos PBR Neutral Tone Mapper, specification of 2024 (github.com/KhronosGroup/ToneMapping). Keeps the
 * colours of materials lit in grey light: below the start of compression only the Fresnel reflection F90 =
 * .04 is taken away. */
TRIAD_FUNCTION Vec3 tone_map_khronos(Vec3 colour) {
    const float start = 0.8f - 0.04f, d = 1.0f - start, desaturation = 0.15f;
    const float x = math_min(colour.x, math_min(colour.y, colour.z));
    Vec3 c = vec3_sub(colour, vec3_splat(x < 0.08f ? x - 6.25f * x * x : 0.04f));
    const float peak = vec3_largest(c);
    if (peak < start) return c;
    const float new_peak = 1.0f - d * d / (peak + d - start);
    c = vec3_scale(c, new_peak / peak);
    const float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return vec3_make(math_mix(c.x, new_peak, g), math_mix(c.y, new_peak, g), math_mix(c.z, new_peak, g));
}

/* Stephen Hill's fit of the ACES 1.0 RRT and the 100 nits Rec.709 ODT (BakingLab, ACES.hlsl), without the
 * exposure boost of 1 / .6 that some viewers put before it. */
TRIAD_FUNCTION float tone_map_aces_curve(float v) {
    return fma(v, v + 0.0245786f, -0.000090537f) / fma(v, fma(0.983729f, v, 0.4329510f), 0.238081f);
}
TRIAD_FUNCTION Vec3 tone_map_aces(Vec3 c) {
    const float r = tone_map_aces_curve(vec3_dot(vec3_make(0.59719f, 0.35458f, 0.04823f), c));
    const float g = tone_map_aces_curve(vec3_dot(vec3_make(0.07600f, 0.90834f, 0.01566f), c));
    const float b = tone_map_aces_curve(vec3_dot(vec3_make(0.02840f, 0.13383f, 0.83777f), c));
    const Vec3 v = vec3_make(r, g, b);
    return vec3_make(vec3_dot(vec3_make(1.60475f, -0.53108f, -0.07367f), v),
                     vec3_dot(vec3_make(-0.10208f, 1.10813f, -0.00605f), v),
                     vec3_dot(vec3_make(-0.00327f, -0.07276f, 1.07602f), v));
}

/* Troy Sobotka's AgX, base look, in Benjamin Wrensch's form (iolite-engine.com, "Minimal AgX
 * Implementation"): inset, log2 over 16.5 stops, a sixth-degree fit of the sigmoid, outset, and the 2.2 power
 * that makes it display-linear. */
TRIAD_FUNCTION float tone_map_agx_curve(float v) {
    const float low = -12.47393f, high = 4.026069f;
    const float stops = math_log2(v);
    const float x = math_saturate((stops - low) * (1.0f / (high - low)));
    float p = fma(15.5f, x, -40.14f);
    p = fma(p, x, 31.96f);
    p = fma(p, x, -6.868f);
    p = fma(p, x, 0.4298f);
    p = fma(p, x, 0.1191f);
    return fma(p, x, -0.00232f);
}
TRIAD_FUNCTION Vec3 tone_map_agx(Vec3 c) {
    const float r = tone_map_agx_curve(
        vec3_dot(vec3_make(0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f), c));
    const float g = tone_map_agx_curve(
        vec3_dot(vec3_make(0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f), c));
    const float b =
        tone_map_agx_curve(vec3_dot(vec3_make(0.0423756549057051f, 0.0784336f, 0.879142973793104f), c));
    const Vec3 v = vec3_make(r, g, b);
    const float x = vec3_dot(vec3_make(1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f), v);
    const float y = vec3_dot(vec3_make(-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f), v);
    const float z = vec3_dot(vec3_make(-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f), v);
    return vec3_make(math_pow(math_saturate(x), 2.2f), math_pow(math_saturate(y), 2.2f),
                     math_pow(math_saturate(z), 2.2f));
}

/* The curve `which` (TONE_MAP_* of types.h), cut to the display's [0, 1]. */
TRIAD_FUNCTION Vec3 tone_map(uint which, Vec3 radiance) {
    Vec3 c = vec3_make(tone_map_input(radiance.x), tone_map_input(radiance.y), tone_map_input(radiance.z));
    c = tone_map_gamut(c);
    if (which == TONE_MAP_KHRONOS) c = tone_map_khronos(c);
    if (which == TONE_MAP_ACES) c = tone_map_aces(c);
    if (which == TONE_MAP_AGX) c = tone_map_agx(c);
    return vec3_make(math_saturate(c.x), math_saturate(c.y), math_saturate(c.z));
}

/* The same for a colour that is associated with its coverage: what is covered has colour rgb / alpha, and
 * light without coverage has nothing to be shown on. */
TRIAD_FUNCTION Vec4 tone_map_associated(uint which, Vec4 v) {
    const float alpha = math_saturate(v.w);
    if (alpha == 0.0f) return vec4_splat(0.0f);
    if (alpha == 1.0f) return vec3_with(tone_map(which, vec4_xyz(v)), 1.0f);
    const Vec3 colour = vec3_div(vec4_xyz(v), vec3_splat(alpha));
    return vec3_with(vec3_scale(tone_map(which, colour), alpha), alpha);
}

#endif
