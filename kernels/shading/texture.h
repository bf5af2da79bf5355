/* Textures in buffers: 8 bits stay 8 bits, sRGB is decoded before filtering, through a table. */
#ifndef TRIAD_SHADING_TEXTURE_H
#define TRIAD_SHADING_TEXTURE_H

#include "shading/scene.h"

/* Index of a texel along one axis; i may be any int (glTF 2.0 section 3.8.4.5; mirroring as OpenGL's). */
TRIAD_FUNCTION uint texture_wrap(int i, int size, uint wrap) {
    if (wrap == WRAP_CLAMP) return (uint)math_clamp_int(i, 0, size - 1);
    const int period = wrap == WRAP_MIRROR ? 2 * size : size;
    int m = i % period;
    m = m < 0 ? m + period : m;
    return (uint)(m < size ? m : 2 * size - 1 - m);
}

TRIAD_FUNCTION Vec4 texture_texel(const Scene* scene, const Texture* t, uint x, uint y) {
    const uint i = y * t->width + x;
    if (t->format == TEXTURE_RGBA16) {
        const uint lo = scene->texels[t->first_texel + 2u * i],
                   hi = scene->texels[t->first_texel + 2u * i + 1u];
        return vec4_scale(
            vec4_make((float)(lo & 0xffffu), (float)(lo >> 16), (float)(hi & 0xffffu), (float)(hi >> 16)),
            1.0f / 65535.0f);
    }
    const uint texel = scene->texels[t->first_texel + i];
    const uint r = texel & 0xffu, g = texel >> 8 & 0xffu, b = texel >> 16 & 0xffu;
    const float alpha = (float)(texel >> 24) * (1.0f / 255.0f);
    if (t->format == TEXTURE_RGBA8_SRGB)
        return vec4_make(scene->srgb[r], scene->srgb[g], scene->srgb[b], alpha);
    return vec4_make((float)r * (1.0f / 255.0f), (float)g * (1.0f / 255.0f), (float)b * (1.0f / 255.0f),
                     alpha);
}

/* Keeps huge and non-finite coordinates from overflowing the conversion to int. */
TRIAD_FUNCTION float texture_coordinate(float x) { return x > -1e9f && x < 1e9f ? x : 0.0f; }

TRIAD_FUNCTION Vec4 texture_sample(const Scene* scene, uint texture, Vec2 uv) {
    const Texture t = scene->textures[texture];
    const int w = (int)t.width, h = (int)t.height;
    /* The coordinate is bounded before it is scaled: (int) of a float beyond 2^31 is undefined. */
    const float x = texture_coordinate(texture_coordinate(uv.x) * (float)w);
    const float y = texture_coordinate(texture_coordinate(uv.y) * (float)h);
    if (!t.linear) {
        const int i = (int)math_floor(x), j = (int)math_floor(y);
        return texture_texel(scene, &t, texture_wrap(i, w, t.wrap_u), texture_wrap(j, h, t.wrap_v));
    }
    const float fx = math_floor(x - 0.5f), fy = math_floor(y - 0.5f);
    const float ax = x - 0.5f - fx, ay = y - 0.5f - fy;
    const uint x0 = texture_wrap((int)fx, w, t.wrap_u), x1 = texture_wrap((int)fx + 1, w, t.wrap_u);
    const uint y0 = texture_wrap((int)fy, h, t.wrap_v), y1 = texture_wrap((int)fy + 1, h, t.wrap_v);
    const Vec4 a = texture_texel(scene, &t, x0, y0), b = texture_texel(scene, &t, x1, y0);
    const Vec4 c = texture_texel(scene, &t, x0, y1), d = texture_texel(scene, &t, x1, y1);
    return vec4_blend(vec4_blend(a, b, ax), vec4_blend(c, d, ax), ay);
}

/* Where a use looks into its texture, at the two UV sets of a point. */
TRIAD_FUNCTION Vec2 texture_use_place(const TextureUse* t, Vec2 uv0, Vec2 uv1) {
    const Vec2 uv = t->uv_set ? uv1 : uv0;
    return vec2_make(fma(t->m[0], uv.x, fma(t->m[1], uv.y, t->m[2])),
                     fma(t->m[3], uv.x, fma(t->m[4], uv.y, t->m[5])));
}

/* Value of a texture use at a point; `missing` when the use is TRIAD_NONE. */
TRIAD_FUNCTION Vec4 texture_use_sample(const Scene* scene, uint use, Vec2 uv0, Vec2 uv1, Vec4 missing) {
    if (use == TRIAD_NONE) return missing;
    const TextureUse t = scene->texture_uses[use];
    return texture_sample(scene, t.texture, texture_use_place(&t, uv0, uv1));
}

/* The level of which a lookup, four texels, covers `texels` of the image's, or less: a texel of a level
 * covers four of the one before. */
TRIAD_FUNCTION uint texture_level(float texels, uint levels) {
    if (!(texels >= 16.0f)) return 0u;
    return math_min_uint(((as_uint(texels) >> 23) - 129u) >> 1,
                         levels); /* half of the exponent of a quarter */
}

/* The same of a colour, of which a mean is asked for: over areas of `covered` in the two UV sets. */
TRIAD_FUNCTION Vec4 texture_use_mean(const Scene* scene, uint use, Vec2 uv0, Vec2 uv1, Vec2 covered,
                                     Vec4 missing) {
#if TRIAD_TEXTURE_LEVELS
    if (use == TRIAD_NONE) return missing;
    const TextureUse t = scene->texture_uses[use];
    global const Texture* image = scene->textures + t.texture;
    const float scale = fabs(t.m[0] * t.m[4] - t.m[1] * t.m[3]) * (float)image->width * (float)image->height;
    const uint level = texture_level((t.uv_set ? covered.y : covered.x) * scale, image->levels);
    return texture_sample(scene, t.texture + level, texture_use_place(&t, uv0, uv1));
#else
    (void)covered;
    return texture_use_sample(scene, use, uv0, uv1, missing);
#endif
}

#endif
