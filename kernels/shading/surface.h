/* From a hit to what shading needs: position, normals, material. Rebased world space. */
#ifndef TRIAD_SHADING_SURFACE_H
#define TRIAD_SHADING_SURFACE_H

#include "shading/surface_extensions.h"

#if TRIAD_ALPHA_TEST
/* Share of the rays that a surface stops at a point: 1 opaque, 0 or 1 for MASK, between for BLEND. */
TRIAD_FUNCTION float surface_coverage(const Scene* scene, uint primitive, float u, float v) {
    const Triangle t = scene->triangles[primitive];
    const Geometry g = scene->geometries[t.geometry];
    global const Material* m = scene->materials + g.material;
    if (!(m->flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND))) return 1.0f;
    Vec2 uv0, uv1;
    Vec4 colour;
    surface_attributes(scene, &g, &t, u, v, &uv0, &uv1, &colour);
    float alpha = m->base_colour[3] * colour.w;
#if TRIAD_TEXTURES
    alpha *= texture_use_sample(scene, m->base_colour_use, uv0, uv1, vec4_splat(1.0f)).w;
#endif
    if (m->flags & MATERIAL_ALPHA_MASK) return alpha >= m->alpha_cutoff ? 1.0f : 0.0f;
    return alpha;
}
#endif

/* Corner c of the hit triangle, from the block that the walk has just read. */
TRIAD_FUNCTION Vec3 surface_corner(const Scene* scene, uint block, uint c) {
    global const float* p = &scene->blocks[block >> 2].vertex[3u * c][block & 3u];
    return vec3_make(p[0], p[4], p[8]);
}

/* A ray that leaves the triangle close to an edge where two walls meet at an acute angle would start beyond
 * the other wall: the offset along the normal passes it. So rays start at least eight offsets away from every
 * edge (a quarter of the height, where the triangle is smaller), which keeps them inside down to angles of 7
 * degrees. `twice_area` of the triangle p0, p0 + e1, p0 + e2; u, v: the weights of corners 1 and 2. */
TRIAD_FUNCTION Vec3 surface_start(Vec3 p0, Vec3 e1, Vec3 e2, float u, float v, Vec3 position,
                                  float twice_area, float offset) {
    const float w = 1.0f - u - v, most = 8.0f * offset;
    /* far from all edges, as nearly always: no edge is longer than this */
    const float longest = 1.75f * (vec3_largest_abs(e1) + vec3_largest_abs(e2));
    if (math_min(w, math_min(u, v)) * twice_area >= most * longest) return position;
    const float least = most / twice_area;
    const float w0 = math_min(least * vec3_length(vec3_sub(e2, e1)), 0.25f);
    const float w1 = math_min(least * vec3_length(e2), 0.25f), w2 = math_min(least * vec3_length(e1), 0.25f);
    if (w >= w0 && u >= w1 && v >= w2) return position;
    const float a = math_max(w, w0), b = math_max(u, w1), c = math_max(v, w2), inverse = 1.0f / (a + b + c);
    return vec3_add_scaled(vec3_add_scaled(p0, e1, b * inverse), e2, c * inverse);
}

/* What the material's core is at the point; colour: of the vertices. */
TRIAD_FUNCTION void surface_core(const Scene* scene, global const Material* m, Vec4 colour, Surface* s) {
    (void)scene;
    s->base_colour = vec3_mul(VEC3_OF(m->base_colour), vec4_xyz(colour));
    s->metallic = m->metallic;
    s->roughness = m->roughness;
    s->transmission = m->transmission;
    s->specular = m->specular;
    s->specular_colour = VEC3_OF(m->specular_colour);
#if TRIAD_TEXTURES
    const Vec4 one = vec4_splat(1.0f);
    const Vec2 covered = surface_covered(s);
    const Vec4 base = texture_use_mean(scene, m->base_colour_use, s->uv0, s->uv1, covered, one);
    s->base_colour = vec3_mul(s->base_colour, vec4_xyz(base));
    if (m->metallic_roughness_use != TRIAD_NONE) {
        const Vec4 mr = texture_use_sample(scene, m->metallic_roughness_use, s->uv0, s->uv1, one);
        s->roughness *= mr.y;
        s->metallic *= mr.z;
    }
    s->transmission *= texture_use_sample(scene, m->transmission_use, s->uv0, s->uv1, one).x;
    s->specular *= texture_use_sample(scene, m->specular_use, s->uv0, s->uv1, one).w;
    const Vec4 specular = texture_use_mean(scene, m->specular_colour_use, s->uv0, s->uv1, covered, one);
    s->specular_colour = vec3_mul(s->specular_colour, vec4_xyz(specular));
#endif
}

/* covers: area of the surface over which colours may be averaged. */
TRIAD_FUNCTION Surface surface_make(const Scene* scene, const Hit* hit, float covers) {
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
    Vec3 p0 = surface_corner(scene, hit->block, 0u);
    Vec3 p1 = surface_corner(scene, hit->block, 1u);
    Vec3 p2 = surface_corner(scene, hit->block, 2u);
    float reach = 0.0f; /* largest coordinate that takes part in computing the position */
    float mirrored = 1.0f;
#if TRIAD_INSTANCES
    if (instance != 0u) {
        global const Instance* placed = scene->instances + instance;
        const Vec3 object_normal = vec3_cross(vec3_sub(p1, p0), vec3_sub(p2, p0));
        reach = 2.0f *
                vec3_largest_abs(vec3_make(placed->to_world[3], placed->to_world[7], placed->to_world[11]));
        p0 = transform_point(placed->to_world, p0);
        p1 = transform_point(placed->to_world, p1);
        p2 = transform_point(placed->to_world, p2);
        /* The front of a mirrored mesh stays its front: normals follow the inverse transpose, not the
         * corners. */
        const Vec3 turned = vec3_cross(vec3_sub(p1, p0), vec3_sub(p2, p0));
        mirrored = vec3_dot(turned, transform_normal(placed->to_object, object_normal)) < 0.0f ? -1.0f : 1.0f;
    }
#endif
    const Vec3 e1 = vec3_sub(p1, p0), e2 = vec3_sub(p2, p0);
    const Vec3 any = vec3_make(0.0f, 1.0f, 0.0f); /* keeps numbers finite where no normal exists */
    /* The edges are scaled first: the product of tiny ones would underflow. */
    const Vec3 product = vec3_cross(e1, e2);
    Vec3 across = product;
    if (!(vec3_largest_abs(across) > 0x1.0p-40f)) across = vec3_cross(scale_to_one(e1), scale_to_one(e2));
    const Vec3 n = vec3_scale(normalize_or(across, any), mirrored);
    s.geometric_normal = n;
    s.position = vec3_add_scaled(vec3_add_scaled(p0, e1, u), e2, v);
    reach =
        math_max(math_max(reach, vec3_largest_abs(p0)), math_max(vec3_largest_abs(p1), vec3_largest_abs(p2)));
    s.offset = 32.0f * 0x1.0p-23f * reach;
    s.start = surface_start(p0, e1, e2, u, v, s.position, fabs(vec3_dot(n, product)), s.offset);

    Vec4 colour;
    surface_attributes(scene, &g, &t, u, v, &s.uv0, &s.uv1, &colour);
#if TRIAD_TEXTURE_LEVELS
    const float per_area = covers / vec3_length(product); /* of the triangle, whose area may be 0 */
    s.covered = vec2_make(per_area * surface_uv_area(scene, g.uv[0], &t),
                          per_area * surface_uv_area(scene, g.uv[1], &t));
#else
    (void)covers;
#endif
    Vec3 ns = surface_smooth_normal(scene, &g, &t, u, v, instance, n);
    global const Material* m = scene->materials + g.material;
    const Vec3 smooth_normal = ns;
#if TRIAD_NORMAL_MAPS
    if (m->normal_use != TRIAD_NONE && g.tangent != TRIAD_NONE) {
        const SurfaceTangents tangents = surface_tangents(scene, &g, &t, u, v, instance, ns);
        ns = surface_normal_map(scene, m->normal_use, m->normal_scale, &tangents, &s, ns);
    }
#endif
    s.shading_normal = vec3_dot(ns, n) < 0.0f ? vec3_negate(ns) : ns;
    surface_core(scene, m, colour, &s);
#if SURFACE_EXTENSIONS
    surface_extend(scene, m, &g, &t, u, v, instance, smooth_normal, &s);
#else
    (void)smooth_normal;
#endif
    return s;
}

/* Radiance that the material emits at a point with these UVs; covered: as Surface.covered. */
TRIAD_FUNCTION Vec3 surface_emission(const Scene* scene, global const Material* m, Vec2 uv0, Vec2 uv1,
                                     Vec2 covered) {
    Vec3 e = VEC3_OF(m->emission);
#if TRIAD_TEXTURES
    const Vec4 texel = texture_use_mean(scene, m->emission_use, uv0, uv1, covered, vec4_splat(1.0f));
    e = vec3_mul(e, vec4_xyz(texel));
#else
    (void)scene, (void)uv0, (void)uv1, (void)covered;
#endif
    return e;
}

#endif
