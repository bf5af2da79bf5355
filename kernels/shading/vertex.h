/* What a path does at a vertex: which normal it shades with, how rays leave, and which body they pass. */
#ifndef TRIAD_SHADING_VERTEX_H
#define TRIAD_SHADING_VERTEX_H

#include "common/spectrum.h"
#include "shading/surface.h"

/* A ray that leaves a surface to the side of `normal`, and never hits the triangle that it leaves. */
TRIAD_FUNCTION Ray vertex_spawn(const Surface* s, Vec3 normal, const Hit* hit, Vec3 direction) {
    const Vec3 origin = vec3_add_scaled(s->start, normal, s->offset);
    Ray ray;
    ray.origin[0] = origin.x, ray.origin[1] = origin.y, ray.origin[2] = origin.z;
    ray.direction[0] = direction.x, ray.direction[1] = direction.y, ray.direction[2] = direction.z;
    ray.t_max = INFINITY;
    ray.skip_instance = hit->instance;
    ray.skip_primitive = hit->primitive;
    return ray;
}

/* The same towards a point, short of it by a rounding error. */
TRIAD_FUNCTION Ray vertex_spawn_to(const Surface* s, Vec3 normal, const Hit* hit, Vec3 target) {
    const Vec3 origin = vec3_add_scaled(s->start, normal, s->offset);
    Ray ray = vertex_spawn(s, normal, hit, vec3_sub(target, origin));
    ray.t_max = 1.0f - 0x1.0p-16f;
    return ray;
}

/* The bodies that a path is in, as materials: the one of the highest priority comes first, of equal ones the
 * one that was entered last; TRIAD_NONE where there is none. What fills the space is the first (Schmidt and
 * Budge 2002, "Simple Nested Dielectrics in Ray Traced Images"); the surface of another is passed as if it
 * were not there. So a body within another refracts against that one, and bodies that overlap meet without
 * air between them. */
typedef UVec4 Bodies;

TRIAD_FUNCTION Bodies bodies_none(void) { return uvec4_make(TRIAD_NONE, TRIAD_NONE, TRIAD_NONE, TRIAD_NONE); }

#if TRIAD_TRANSMISSION
/* What a body lets through over a distance (Beer-Lambert). */
TRIAD_FUNCTION Vec3 vertex_transmittance(global const Material* body, float distance) {
    return vec3_make(math_exp(-body->absorption[0] * distance), math_exp(-body->absorption[1] * distance),
                     math_exp(-body->absorption[2] * distance));
}

#if TRIAD_PRIORITIES
TRIAD_FUNCTION int bodies_before(const Scene* scene, uint a, uint b) {
    return a != TRIAD_NONE && scene->materials[a].priority > scene->materials[b].priority;
}
#endif

TRIAD_FUNCTION Bodies bodies_enter(const Scene* scene, Bodies b, uint body) {
#if TRIAD_PRIORITIES
    if (bodies_before(scene, b.x, body)) {
        if (!bodies_before(scene, b.y, body)) return uvec4_make(b.x, body, b.y, b.z);
        return bodies_before(scene, b.z, body) ? uvec4_make(b.x, b.y, b.z, body)
                                               : uvec4_make(b.x, b.y, body, b.z);
    }
#else
    (void)scene;
#endif
    return uvec4_make(body, b.x, b.y, b.z);
}

TRIAD_FUNCTION Bodies bodies_leave(Bodies b, uint body) {
    if (b.x == body) return uvec4_make(b.y, b.z, b.w, TRIAD_NONE);
    if (b.y == body) return uvec4_make(b.x, b.z, b.w, TRIAD_NONE);
    if (b.z == body) return uvec4_make(b.x, b.y, b.w, TRIAD_NONE);
    if (b.w == body) return uvec4_make(b.x, b.y, b.z, TRIAD_NONE);
    return b;
}

/* With the body whose inner side is seen: that is proof of where the path runs, wherever it was thought to
 * be. */
TRIAD_FUNCTION Bodies bodies_proved(const Scene* scene, Bodies b, uint inner) {
    const int known = b.x == inner || b.y == inner || b.z == inner || b.w == inner;
    return inner == TRIAD_NONE || known ? b : bodies_enter(scene, b, inner);
}

/* Beyond a surface with the body `inner` on this side and `outer` on the other (either may be TRIAD_NONE). */
TRIAD_FUNCTION Bodies bodies_beyond(const Scene* scene, Bodies b, uint inner, uint outer) {
    const Bodies left = inner != TRIAD_NONE ? bodies_leave(b, inner) : b;
    return outer != TRIAD_NONE ? bodies_enter(scene, left, outer) : left;
}

/* The index of refraction of what fills the space, at a wavelength in nm (0: all of them, at the d line). */
TRIAD_FUNCTION float bodies_index(const Scene* scene, Bodies b, float wavelength) {
    if (b.x == TRIAD_NONE) return 1.0f;
    global const Material* body = scene->materials + b.x;
#if TRIAD_DISPERSION
    if (wavelength > 0.0f && body->dispersion != TRIAD_NONE)
        return spectrum_index(scene->indices, body->dispersion, wavelength);
#else
    (void)wavelength;
#endif
    return math_max(body->ior, 1.0f); /* an index of 0 lets nothing in */
}

#if TRIAD_DISPERSION
TRIAD_FUNCTION int bodies_disperse(const Scene* scene, Bodies b) {
    return b.x != TRIAD_NONE && scene->materials[b.x].dispersion != TRIAD_NONE;
}
#endif
#endif

/* The bodies on the side of a surface that a path comes from, and those on the other. */
typedef struct VertexBodies {
    Bodies here, beyond;
} VertexBodies;

/* bodies: what the path is thought to be in; back: it meets the inner side. */
TRIAD_FUNCTION VertexBodies vertex_bodies(const Scene* scene, const Surface* s, int back, Bodies bodies) {
    VertexBodies v;
#if TRIAD_TRANSMISSION
    /* the body of the surface, and one that touches it */
    const uint solid = scene->materials[s->material].flags & MATERIAL_SOLID ? s->material : TRIAD_NONE;
    const uint touching = solid == TRIAD_NONE ? TRIAD_NONE : s->touching;
    const uint inner = back ? solid : touching, outer = back ? touching : solid;
    v.here = bodies_proved(scene, bodies, inner);
    v.beyond = bodies_beyond(scene, v.here, inner, outer);
#else
    (void)scene, (void)s, (void)back;
    v.here = v.beyond = bodies;
#endif
    return v;
}

#if TRIAD_DISPERSION && TRIAD_TRANSMISSION
/* Whether the surface tells wavelengths apart. */
TRIAD_FUNCTION int vertex_disperses(const Scene* scene, const Surface* s, const VertexBodies* v) {
    return scene->materials[s->material].flags & MATERIAL_SOLID && s->transmission > 0.0f &&
           s->metallic < 1.0f && (bodies_disperse(scene, v->here) || bodies_disperse(scene, v->beyond));
}
#endif

/* The local frame's normal: the shading normal on the side of wo. `mirror` is the share of the material that
 * has microfacets alone (metal, glass): theirs is turned towards the geometric normal (on wo's side) just so
 * far that the mirror direction of wo leaves the surface, else they would be black where a normal map or
 * interpolation tilts it further. With N = (sqrt(1 - w), 0, sqrt(w)) and R.z = t, w is a root of 2 a w^2 - b
 * w + c / 2 = 0: Cycles' ensure_valid_specular_reflection. */
TRIAD_FUNCTION Vec3 vertex_shading_normal(Vec3 ns, Vec3 ng, Vec3 wo, float mirror) {
    /* a normal that hardly faces wo is turned until it does, but never farther than the surface itself */
    const float facing = vec3_dot(ns, wo), least = math_min(0.02f, vec3_dot(ng, wo));
    Vec3 n = ns;
    if (facing < least) {
        n = normalize_or(vec3_add_scaled(ns, wo, least - facing), ng);
        if (!(vec3_dot(n, wo) > 0.0f)) return ng;
    }
    const float cosine = vec3_dot(n, ng), z = vec3_dot(wo, ng);
    const float t = math_min(0.9f * z, 0.01f); /* never asks for more than the geometric normal gives */
    if (mirror == 0.0f || fma(2.0f * vec3_dot(n, wo), cosine, -z) >= t) return n;
    const Vec3 axis = normalize_or(vec3_add_scaled(n, ng, -cosine), vec3_splat(0.0f));
    const float x = vec3_dot(wo, axis);
    const float a = fma(x, x, z * z), b = 2.0f * fma(z, t, a), c = math_square(t + z);
    const float root = math_sqrt(fma(b, b, -4.0f * a * c));
    const float w = math_clamp(0.25f * (b + (x < 0.0f ? root : -root)) / a, 0.0f, 1.0f);
    const Vec3 turned = vec3_add_scaled(vec3_scale(axis, sqrt(1.0f - w)), ng, sqrt(w));
    return normalize_or(vec3_blend(n, turned, mirror), ng);
}

#endif
