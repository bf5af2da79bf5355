/* From a hit to what shading needs: position, normals, material. Rebased world space. */
#ifndef TRIAD_SHADING_SURFACE_H
#define TRIAD_SHADING_SURFACE_H

#include "common/colour.h"
#include "shading/scene.h"
#include "shading/texture.h"

typedef struct Surface {
    float3 position;
    float3 start;            /* where rays leave from, before the offset: position, but not at an edge */
    float3 geometric_normal; /* unit, on the front side */
    float3 shading_normal;   /* unit, on the front side */
    float offset; /* how far a new ray starts off the surface: bounds the rounding error of position */
    uint geometry, material;
    uint touching; /* of a body's surface: the material of the body on the other side, or TRIAD_NONE */
    float2 uv0, uv1;
    float3 base_colour;
    float metallic, roughness, transmission, specular;
    float3 specular_colour;
#if TRIAD_HERO
    Colour base_values, specular_values; /* base_colour and specular_colour at the path's wavelengths */
#endif
} Surface;

/* UVs and vertex colour of a point, barycentric weights u, v of corners 1 and 2. */
TRIAD_FUNCTION void surface_attributes(const Scene* scene, const Geometry* g, const Triangle* t, float u,
                                       float v, float2* uv0, float2* uv1, float4* colour) {
    const float w = 1.0f - u - v;
    *uv0 = (float2)(0.0f);
    *uv1 = (float2)(0.0f);
    *colour = (float4)(1.0f);
#if TRIAD_TEXTURES
    if (g->uv[0] != TRIAD_NONE)
        *uv0 = w * vload2(g->uv[0] + t->vertex[0], scene->uvs) +
               u * vload2(g->uv[0] + t->vertex[1], scene->uvs) +
               v * vload2(g->uv[0] + t->vertex[2], scene->uvs);
    if (g->uv[1] != TRIAD_NONE)
        *uv1 = w * vload2(g->uv[1] + t->vertex[0], scene->uvs) +
               u * vload2(g->uv[1] + t->vertex[1], scene->uvs) +
               v * vload2(g->uv[1] + t->vertex[2], scene->uvs);
#endif
#if TRIAD_VERTEX_COLOURS
    if (g->colour != TRIAD_NONE)
        *colour = w * vload4(g->colour + t->vertex[0], scene->colours) +
                  u * vload4(g->colour + t->vertex[1], scene->colours) +
                  v * vload4(g->colour + t->vertex[2], scene->colours);
#endif
}

#if TRIAD_ALPHA_TEST
/* Share of the rays that a surface stops at a point: 1 opaque, 0 or 1 for MASK, between for BLEND. */
TRIAD_FUNCTION float surface_coverage(const Scene* scene, uint primitive, float u, float v) {
    const Triangle t = scene->triangles[primitive];
    const Geometry g = scene->geometries[t.geometry];
    global const Material* m = scene->materials + g.material;
    if (!(m->flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND))) return 1.0f;
    float2 uv0, uv1;
    float4 colour;
    surface_attributes(scene, &g, &t, u, v, &uv0, &uv1, &colour);
    float alpha = m->base_colour[3] * colour.w;
#if TRIAD_TEXTURES
    alpha *= texture_use_sample(scene, m->base_colour_use, uv0, uv1, (float4)(1.0f)).w;
#endif
    if (m->flags & MATERIAL_ALPHA_MASK) return alpha >= m->alpha_cutoff ? 1.0f : 0.0f;
    return alpha;
}
#endif

#if TRIAD_NORMAL_MAPS
/* The unit normal n perturbed by the material's normal map, in the tangent frame of the vertices. */
TRIAD_FUNCTION float3 surface_normal_map(const Scene* scene, const Geometry* g, const Triangle* t, float u,
                                         float v, const Surface* s, uint instance, float3 n) {
    global const Material* m = scene->materials + g->material;
    if (m->normal_use == TRIAD_NONE || g->tangent == TRIAD_NONE) return n;
    const float4 t0 = vload4(g->tangent + t->vertex[0], scene->tangents);
    const float4 t1 = vload4(g->tangent + t->vertex[1], scene->tangents);
    const float4 t2 = vload4(g->tangent + t->vertex[2], scene->tangents);
    float3 tangent = t0.xyz + (t1.xyz - t0.xyz) * u + (t2.xyz - t0.xyz) * v;
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
    tangent = normalize_or(tangent - n * math_dot(n, tangent), (float3)(0.0f));
    const float3 bitangent = math_cross(n, tangent) * handedness;
    const float4 texel =
        texture_use_sample(scene, m->normal_use, s->uv0, s->uv1, (float4)(0.5f, 0.5f, 1.0f, 1.0f));
    const float3 mapped = (float3)(fma(2.0f, texel.x, -1.0f) * m->normal_scale,
                                   fma(2.0f, texel.y, -1.0f) * m->normal_scale, fma(2.0f, texel.z, -1.0f));
    return normalize_or(tangent * mapped.x + bitangent * mapped.y + n * mapped.z, n);
}
#endif

/* Corner c of the hit triangle, from the block that the walk has just read. */
TRIAD_FUNCTION float3 surface_corner(const Scene* scene, uint block, uint c) {
    global const float* p = &scene->blocks[block >> 2].vertex[3u * c][block & 3u];
    return (float3)(p[0], p[4], p[8]);
}

/* A ray that leaves the triangle close to an edge where two walls meet at an acute angle would start beyond
 * the other wall: the offset along the normal passes it. So rays start at least eight offsets away from every
 * edge (a quarter of the height, where the triangle is smaller), which keeps them inside down to angles of 7
 * degrees. `twice_area` of the triangle p0, p0 + e1, p0 + e2; u, v: the weights of corners 1 and 2. */
TRIAD_FUNCTION float3 surface_start(float3 p0, float3 e1, float3 e2, float u, float v, float3 position,
                                    float twice_area, float offset) {
    const float w = 1.0f - u - v, most = 8.0f * offset;
    /* far from all edges, as nearly always: no edge is longer than this */
    const float longest = 1.75f * (max_abs3(e1) + max_abs3(e2));
    if (math_min(w, math_min(u, v)) * twice_area >= most * longest) return position;
    const float least = most / twice_area;
    const float w0 = math_min(least * math_length(e2 - e1), 0.25f);
    const float w1 = math_min(least * math_length(e2), 0.25f), w2 = math_min(least * math_length(e1), 0.25f);
    if (w >= w0 && u >= w1 && v >= w2) return position;
    const float a = math_max(w, w0), b = math_max(u, w1), c = math_max(v, w2), inverse = 1.0f / (a + b + c);
    return p0 + e1 * (b * inverse) + e2 * (c * inverse);
}

TRIAD_FUNCTION Surface surface_make(const Scene* scene, const Hit* hit) {
    const float u = hit->u, v = hit->v;
    const uint instance = hit->instance;
    Surface s;
    s.geometry = scene->blocks[hit->block >> 2].geometry[hit->block & 3u];
    const Geometry g = scene->geometries[s.geometry];
    /* the corners' indices are asked for only where a vertex has attributes: one cache line less for the
     * others */
    const int attributes = g.normal != TRIAD_NONE || g.tangent != TRIAD_NONE || g.uv[0] != TRIAD_NONE ||
                           g.uv[1] != TRIAD_NONE || g.colour != TRIAD_NONE;
    Triangle t = {{0u, 0u, 0u}, 0u};
    if (attributes) t = scene->triangles[hit->primitive];
    s.material = g.material;
    s.touching = g.touching;
    float3 p0 = surface_corner(scene, hit->block, 0u);
    float3 p1 = surface_corner(scene, hit->block, 1u);
    float3 p2 = surface_corner(scene, hit->block, 2u);
    float reach = 0.0f; /* largest coordinate that takes part in computing the position */
    float mirrored = 1.0f;
#if TRIAD_INSTANCES
    if (instance != 0u) {
        global const Instance* placed = scene->instances + instance;
        const float3 object_normal = math_cross(p1 - p0, p2 - p0);
        reach = 2.0f * max_abs3((float3)(placed->to_world[3], placed->to_world[7], placed->to_world[11]));
        p0 = transform_point(placed->to_world, p0);
        p1 = transform_point(placed->to_world, p1);
        p2 = transform_point(placed->to_world, p2);
        /* The front of a mirrored mesh stays its front: normals follow the inverse transpose, not the
         * corners. */
        mirrored =
            math_dot(math_cross(p1 - p0, p2 - p0), transform_normal(placed->to_object, object_normal)) < 0.0f
                ? -1.0f
                : 1.0f;
    }
#endif
    const float3 e1 = p1 - p0, e2 = p2 - p0;
    const float3 any = (float3)(0.0f, 1.0f, 0.0f); /* keeps numbers finite where no normal exists */
    /* The edges are scaled first: the product of tiny ones would underflow. */
    const float3 product = math_cross(e1, e2);
    float3 across = product;
    if (!(max_abs3(across) > 0x1.0p-40f)) across = math_cross(scale_to_one(e1), scale_to_one(e2));
    const float3 n = mirrored * normalize_or(across, any);
    s.geometric_normal = n;
    s.position = p0 + e1 * u + e2 * v;
    reach = math_max3((float3)(reach, max_abs3(p0), math_max3((float3)(max_abs3(p1), max_abs3(p2), 0.0f))));
    s.offset = 32.0f * 0x1.0p-23f * reach;
    s.start = surface_start(p0, e1, e2, u, v, s.position, fabs(math_dot(n, product)), s.offset);

    float4 colour;
    surface_attributes(scene, &g, &t, u, v, &s.uv0, &s.uv1, &colour);
    float3 ns = n;
    if (g.normal != TRIAD_NONE) {
        const float3 n0 = load3(scene->normals, g.normal + t.vertex[0]);
        const float3 n1 = load3(scene->normals, g.normal + t.vertex[1]);
        const float3 n2 = load3(scene->normals, g.normal + t.vertex[2]);
        ns = n0 + (n1 - n0) * u + (n2 - n0) * v;
#if TRIAD_INSTANCES
        if (instance != 0u) ns = transform_normal(scene->instances[instance].to_object, ns);
#endif
        ns = normalize_or(ns, n);
    }
#if TRIAD_NORMAL_MAPS
    ns = surface_normal_map(scene, &g, &t, u, v, &s, instance, ns);
#endif
    s.shading_normal = math_dot(ns, n) < 0.0f ? -ns : ns;

    global const Material* m = scene->materials + g.material;
    s.base_colour = (float3)(m->base_colour[0], m->base_colour[1], m->base_colour[2]) * colour.xyz;
    s.metallic = m->metallic;
    s.roughness = m->roughness;
    s.transmission = m->transmission;
    s.specular = m->specular;
    s.specular_colour = (float3)(m->specular_colour[0], m->specular_colour[1], m->specular_colour[2]);
#if TRIAD_TEXTURES
    const float4 one = (float4)(1.0f);
    s.base_colour *= texture_use_sample(scene, m->base_colour_use, s.uv0, s.uv1, one).xyz;
    if (m->metallic_roughness_use != TRIAD_NONE) {
        const float4 mr = texture_use_sample(scene, m->metallic_roughness_use, s.uv0, s.uv1, one);
        s.roughness *= mr.y;
        s.metallic *= mr.z;
    }
    s.transmission *= texture_use_sample(scene, m->transmission_use, s.uv0, s.uv1, one).x;
    s.specular *= texture_use_sample(scene, m->specular_use, s.uv0, s.uv1, one).w;
    s.specular_colour *= texture_use_sample(scene, m->specular_colour_use, s.uv0, s.uv1, one).xyz;
#endif
    return s;
}

/* Radiance that the material emits at a point with these UVs. */
TRIAD_FUNCTION float3 surface_emission(const Scene* scene, global const Material* m, float2 uv0, float2 uv1) {
    float3 e = (float3)(m->emission[0], m->emission[1], m->emission[2]);
#if TRIAD_TEXTURES
    e *= texture_use_sample(scene, m->emission_use, uv0, uv1, (float4)(1.0f)).xyz;
#endif
    return e;
}

#endif
