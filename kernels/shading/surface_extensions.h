/* What a material's extensions are at a point. */
#ifndef TRIAD_SHADING_SURFACE_EXTENSIONS_H
#define TRIAD_SHADING_SURFACE_EXTENSIONS_H

#include "shading/surface_point.h"

#if SURFACE_EXTENSIONS
TRIAD_FUNCTION Vec4 surface_texture(const Scene* scene, uint use, const Surface* s, Vec4 missing) {
#if TRIAD_TEXTURES
    return texture_use_sample(scene, use, s->uv0, s->uv1, missing);
#else
    (void)scene, (void)use, (void)s;
    return missing;
#endif
}

/* Of a colour: a mean. */
TRIAD_FUNCTION Vec3 surface_colour_texture(const Scene* scene, uint use, const Surface* s) {
#if TRIAD_TEXTURES
    return vec4_xyz(texture_use_mean(scene, use, s->uv0, s->uv1, surface_covered(s), vec4_splat(1.0f)));
#else
    (void)scene, (void)use, (void)s;
    return vec3_splat(1.0f);
#endif
}

#if TRIAD_CLEARCOAT
/* The varnish alone; n as of surface_extend(). Where there is none, s->coat is 0. */
TRIAD_FUNCTION void surface_coat(const Scene* scene, global const Material* m, const Geometry* g,
                                 const Triangle* t, float u, float v, uint instance, Vec3 n, Surface* s) {
    const Vec4 one = vec4_splat(1.0f);
    const int has = m->extensions != TRIAD_NONE;
    global const ClearcoatBlock* b = &scene->extensions[has ? m->extensions : 0u].clearcoat;
    s->coat = 0.0f;
    if (!(has && b->factor > 0.0f)) return;
    s->coat = b->factor * surface_texture(scene, b->factor_use, s, one).x;
    s->coat_roughness = b->roughness * surface_texture(scene, b->roughness_use, s, one).y;
    s->coat_normal = n;
#if TRIAD_NORMAL_MAPS
    if (b->normal_use != TRIAD_NONE && g->tangent != TRIAD_NONE) {
        const SurfaceTangents tangents = surface_tangents(scene, g, t, u, v, instance, n);
        s->coat_normal = surface_normal_map(scene, b->normal_use, b->normal_scale, &tangents, s, n);
    }
#else
    (void)g, (void)t, (void)u, (void)v, (void)instance;
#endif
    if (vec3_dot(s->coat_normal, s->geometric_normal) < 0.0f) s->coat_normal = vec3_negate(s->coat_normal);
}
#endif

/* n: unit, the vertices' normal; not turned. */
TRIAD_FUNCTION void surface_extend(const Scene* scene, global const Material* m, const Geometry* g,
                                   const Triangle* t, float u, float v, uint instance, Vec3 n, Surface* s) {
    const Vec4 one = vec4_splat(1.0f);
    const int has = m->extensions != TRIAD_NONE;
    global const MaterialExtensions* e = scene->extensions + (has ? m->extensions : 0u);
#if TRIAD_CLEARCOAT
    surface_coat(scene, m, g, t, u, v, instance, n, s);
#endif
#if TRIAD_SHEEN
    s->sheen = vec3_splat(0.0f);
    if (has) {
        global const SheenBlock* b = &e->sheen;
        s->sheen = vec3_mul(VEC3_OF(b->colour), surface_colour_texture(scene, b->colour_use, s));
        s->sheen_roughness = b->roughness * surface_texture(scene, b->roughness_use, s, one).w;
    }
#endif
#if TRIAD_ANISOTROPY
    s->anisotropy = 0.0f;
    s->grain = vec3_splat(0.0f);
    if (has && e->anisotropy.strength > 0.0f) {
        global const AnisotropyBlock* b = &e->anisotropy;
        /* without a texture: along the tangent */
        const Vec4 texel = surface_texture(scene, b->use, s, vec4_make(1.0f, 0.5f, 1.0f, 1.0f));
        const float x = fma(2.0f, texel.x, -1.0f), y = fma(2.0f, texel.y, -1.0f);
        s->anisotropy = b->strength * texel.z;
        if (g->tangent != TRIAD_NONE) {
            const SurfaceTangents tangents = surface_tangents(scene, g, t, u, v, instance, n);
            const float along = fma(b->direction[0], x, -b->direction[1] * y),
                        across = fma(b->direction[1], x, b->direction[0] * y);
            s->grain = vec3_add_scaled(vec3_scale(tangents.x, along), tangents.y, across);
        }
    }
#endif
#if TRIAD_IRIDESCENCE
    s->film = 0.0f;
    if (has && e->iridescence.factor > 0.0f) {
        global const IridescenceBlock* b = &e->iridescence;
        s->film = b->factor * surface_texture(scene, b->factor_use, s, one).x;
        s->film_ior = b->ior;
        s->film_thickness = math_mix(b->thickness_minimum, b->thickness_maximum,
                                     surface_texture(scene, b->thickness_use, s, one).y);
    }
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    s->through = 0.0f;
    if (has && e->diffuse_transmission.factor > 0.0f) {
        global const DiffuseTransmissionBlock* b = &e->diffuse_transmission;
        s->through = b->factor * surface_texture(scene, b->factor_use, s, one).w;
        s->through_colour = vec3_mul(VEC3_OF(b->colour), surface_colour_texture(scene, b->colour_use, s));
    }
#endif
    (void)n, (void)u, (void)v, (void)g, (void)t, (void)instance, (void)one, (void)e;
}
#endif

#endif
