/* A point of a surface, and what its vertices and textures say there. Rebased world space. */
#ifndef TRIAD_SHADING_SURFACE_POINT_H
#define TRIAD_SHADING_SURFACE_POINT_H

#include "common/colour.h"
#include "shading/scene.h"
#include "shading/texture.h"

#define SURFACE_EXTENSIONS \
    (TRIAD_CLEARCOAT || TRIAD_SHEEN || TRIAD_ANISOTROPY || TRIAD_IRIDESCENCE || TRIAD_DIFFUSE_TRANSMISSION)

typedef struct Surface {
    Vec3 position;
    Vec3 start;            /* where rays leave from, before the offset: position, but not at an edge */
    Vec3 geometric_normal; /* unit, on the front side */
    Vec3 shading_normal;   /* unit, on the front side */
    float offset; /* how far a new ray starts off the surface: bounds the rounding error of position */
    uint geometry, material;
    uint touching; /* of a body's surface: the material of the body on the other side, or TRIAD_NONE */
    Vec2 uv0, uv1;
#if TRIAD_TEXTURE_LEVELS
    Vec2 covered; /* area in each UV set over which colours may be averaged: path_covers() */
#endif
    Vec3 base_colour;
    float metallic, roughness, transmission, specular;
    Vec3 specular_colour;
#if TRIAD_CLEARCOAT
    float coat, coat_roughness;
    Vec3 coat_normal; /* as shading_normal */
#endif
#if TRIAD_SHEEN
    Vec3 sheen;
    float sheen_roughness;
#endif
#if TRIAD_ANISOTROPY
    float anisotropy;
    Vec3 grain; /* the direction that highlights are stretched along; any length */
#endif
#if TRIAD_IRIDESCENCE
    float film, film_ior, film_thickness; /* share, index, nm */
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    float through;
    Vec3 through_colour;
#endif
#if TRIAD_HERO
#if TRIAD_SHEEN
    Colour sheen_values;
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    Colour through_values;
#endif
#if TRIAD_IRIDESCENCE
    Vec4 wavelengths; /* of the path, nm */
#endif
    Colour base_values, specular_values; /* base_colour and specular_colour at the path's wavelengths */
#endif
} Surface;

/* A vertex's attribute at a point, from the arrays' places of its three corners. */
TRIAD_FUNCTION Vec2 surface_uv(const Scene* scene, uint first, const Triangle* t, float u, float v) {
    const Vec2 a = vec2_scale(vec2_load(scene->uvs, first + t->vertex[0]), 1.0f - u - v);
    const Vec2 b = vec2_scale(vec2_load(scene->uvs, first + t->vertex[1]), u);
    const Vec2 c = vec2_scale(vec2_load(scene->uvs, first + t->vertex[2]), v);
    return vec2_add(vec2_add(a, b), c);
}
TRIAD_FUNCTION Vec4 surface_colour(const Scene* scene, uint first, const Triangle* t, float u, float v) {
    const Vec4 a = vec4_scale(vec4_load(scene->colours, first + t->vertex[0]), 1.0f - u - v);
    const Vec4 b = vec4_scale(vec4_load(scene->colours, first + t->vertex[1]), u);
    const Vec4 c = vec4_scale(vec4_load(scene->colours, first + t->vertex[2]), v);
    return vec4_add(vec4_add(a, b), c);
}

#if TRIAD_TEXTURE_LEVELS
/* Twice the area of the triangle in a UV set, whose coordinates begin at `first`; 0: there is none. */
TRIAD_FUNCTION float surface_uv_area(const Scene* scene, uint first, const Triangle* t) {
    if (first == TRIAD_NONE) return 0.0f;
    const Vec2 a = vec2_load(scene->uvs, first + t->vertex[0]);
    const Vec2 b = vec2_sub(vec2_load(scene->uvs, first + t->vertex[1]), a),
               c = vec2_sub(vec2_load(scene->uvs, first + t->vertex[2]), a);
    return fabs(b.x * c.y - b.y * c.x);
}
#endif
TRIAD_FUNCTION Vec2 surface_covered(const Surface* s) {
#if TRIAD_TEXTURE_LEVELS
    return s->covered;
#else
    (void)s;
    return vec2_splat(0.0f);
#endif
}

/* UVs and vertex colour of a point, barycentric weights u, v of corners 1 and 2. */
TRIAD_FUNCTION void surface_attributes(const Scene* scene, const Geometry* g, const Triangle* t, float u,
                                       float v, Vec2* uv0, Vec2* uv1, Vec4* colour) {
    *uv0 = vec2_splat(0.0f);
    *uv1 = vec2_splat(0.0f);
    *colour = vec4_splat(1.0f);
#if TRIAD_TEXTURES
    if (g->uv[0] != TRIAD_NONE) *uv0 = surface_uv(scene, g->uv[0], t, u, v);
    if (g->uv[1] != TRIAD_NONE) *uv1 = surface_uv(scene, g->uv[1], t, u, v);
#endif
#if TRIAD_VERTEX_COLOURS
    if (g->colour != TRIAD_NONE) *colour = surface_colour(scene, g->colour, t, u, v);
#endif
}

/* Of the vertices, unit and not turned; n, the triangle's, where they have none. */
TRIAD_FUNCTION Vec3 surface_smooth_normal(const Scene* scene, const Geometry* g, const Triangle* t, float u,
                                          float v, uint instance, Vec3 n) {
    if (g->normal == TRIAD_NONE) return n;
    const Vec3 n0 = vec3_load(scene->normals, g->normal + t->vertex[0]);
    const Vec3 n1 = vec3_load(scene->normals, g->normal + t->vertex[1]);
    const Vec3 n2 = vec3_load(scene->normals, g->normal + t->vertex[2]);
    Vec3 ns = vec3_add_scaled(vec3_add_scaled(n0, vec3_sub(n1, n0), u), vec3_sub(n2, n0), v);
#if TRIAD_INSTANCES
    if (instance != 0u) ns = transform_normal(scene->instances[instance].to_object, ns);
#else
    (void)instance;
#endif
    return normalize_or(ns, n);
}

#if TRIAD_NORMAL_MAPS || TRIAD_ANISOTROPY
/* Across the unit normal n, right- or left-handed as the vertices say: x; y. Zero where there is none. */
typedef struct SurfaceTangents {
    Vec3 x, y;
} SurfaceTangents;

TRIAD_FUNCTION SurfaceTangents surface_tangents(const Scene* scene, const Geometry* g, const Triangle* t,
                                                float u, float v, uint instance, Vec3 n) {
    SurfaceTangents s;
    const Vec4 t0 = vec4_load(scene->tangents, g->tangent + t->vertex[0]);
    const Vec4 t1 = vec4_load(scene->tangents, g->tangent + t->vertex[1]);
    const Vec4 t2 = vec4_load(scene->tangents, g->tangent + t->vertex[2]);
    const Vec3 a0 = vec4_xyz(t0), a1 = vec3_sub(vec4_xyz(t1), a0), a2 = vec3_sub(vec4_xyz(t2), a0);
    Vec3 tangent = vec3_add_scaled(vec3_add_scaled(a0, a1, u), a2, v);
    float handedness = t0.w;
#if TRIAD_INSTANCES
    if (instance != 0u) {
        global const float* a = scene->instances[instance].to_world;
        tangent = transform_vector(a, tangent);
        const float determinant = a[0] * (a[5] * a[10] - a[6] * a[9]) - a[1] * (a[4] * a[10] - a[6] * a[8]) +
                                  a[2] * (a[4] * a[9] - a[5] * a[8]);
        handedness = determinant < 0.0f ? -handedness : handedness;
    }
#endif
    s.x = normalize_or(vec3_add_scaled(tangent, n, -vec3_dot(n, tangent)), vec3_splat(0.0f));
    s.y = vec3_scale(vec3_cross(n, s.x), handedness);
    return s;
}
#endif

#if TRIAD_NORMAL_MAPS
/* The unit normal n perturbed by a normal map, in the tangent frame of the vertices. */
TRIAD_FUNCTION Vec3 surface_normal_map(const Scene* scene, uint normal_use, float scale,
                                       const SurfaceTangents* tangents, const Surface* s, Vec3 n) {
    const Vec4 texel =
        texture_use_sample(scene, normal_use, s->uv0, s->uv1, vec4_make(0.5f, 0.5f, 1.0f, 1.0f));
    const Vec3 mapped = vec3_make(fma(2.0f, texel.x, -1.0f) * scale, fma(2.0f, texel.y, -1.0f) * scale,
                                  fma(2.0f, texel.z, -1.0f));
    const Vec3 in_plane = vec3_add_scaled(vec3_scale(tangents->x, mapped.x), tangents->y, mapped.y);
    return normalize_or(vec3_add_scaled(in_plane, n, mapped.z), n);
}
#endif

#endif
