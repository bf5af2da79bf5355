/* The BSDF of a vertex, for one direction wo that a path or a photon came from or goes to. */
#ifndef TRIAD_SHADING_VERTEX_BSDF_H
#define TRIAD_SHADING_VERTEX_BSDF_H

#include "common/frame.h"
#include "shading/bsdf.h"
#include "shading/vertex.h"

typedef struct VertexBsdf {
    ShadingFrame frame; /* z is the shading normal on wo's side */
    Vec3 wo;            /* in the frame */
    Bsdf bsdf;
} VertexBsdf;

/* What extensions change of the core. */
TRIAD_FUNCTION void vertex_core_extensions(const Scene* scene, const Surface* s, BsdfInput* input) {
    (void)scene, (void)s, (void)input;
#if BSDF_STRETCHED
    input->anisotropy = s->anisotropy;
#endif
#if BSDF_FILM
    input->film = s->film;
    input->film_input.ior = s->film_ior;
    input->film_input.thickness = s->film_thickness;
    input->has_film_means = 0u;
#if TRIAD_HERO
    input->film_input.wavelengths = s->wavelengths;
#else
    input->film_input.responses = scene->film_responses;
#endif
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    input->through = s->through;
#if TRIAD_HERO
    input->through_colour = s->through_values;
#else
    input->through_colour = s->through_colour;
#endif
#endif
}

/* Varnish and fibres; they are on the outside of a body, and `inner` is its other side. */
TRIAD_FUNCTION void vertex_layers(const Surface* s, const ShadingFrame* frame, Vec3 wo, Vec3 ng, int back,
                                  int inner, BsdfInput* input) {
    (void)s, (void)frame, (void)wo, (void)ng, (void)back, (void)inner, (void)input;
#if TRIAD_CLEARCOAT
    input->coat = inner ? 0.0f : s->coat;
    if (input->coat > 0.0f) {
        input->coat_roughness = s->coat_roughness;
        input->coat_normal = frame_to_local(
            frame, vertex_shading_normal(back ? vec3_negate(s->coat_normal) : s->coat_normal, ng, wo, 1.0f));
    }
#endif
#if TRIAD_SHEEN
#if TRIAD_HERO
    input->sheen = s->sheen_values;
#else
    input->sheen = s->sheen;
#endif
    input->sheen_roughness = s->sheen_roughness;
    if (inner) input->sheen = colour_splat(0.0f);
#endif
}

/* ng: the geometric normal on wo's side. back: that is the inner side of the surface. bodies and beyond: what
 * the path is in on wo's side and on the other. wavelength: in nm, or 0 for all of them together. Returns all
 * but the BSDF, which is made from `input`. */
TRIAD_FUNCTION VertexBsdf vertex_seen(const Scene* scene, const Surface* s, Vec3 wo, Vec3 ng, int back,
                                      Bodies bodies, Bodies beyond, float wavelength, BsdfInput* input) {
    global const Material* material = scene->materials + s->material;
    const uint solid = material->flags & MATERIAL_SOLID;
#if TRIAD_HERO
    input->base_colour = s->base_values;
    input->specular_colour = s->specular_values;
#else
    input->base_colour = s->base_colour;
    input->specular_colour = s->specular_colour;
#endif
    input->metallic = s->metallic;
    input->roughness = s->roughness;
    input->ior = material->ior;
    input->specular = s->specular;
    input->transmission = s->transmission;
    input->solid = solid != 0u;
    input->inside = (uint)(back && solid);
#if TRIAD_TRANSMISSION
    if (solid && material->ior >= 1.0f) { /* against what is around: from the denser side it is seen */
        const float here = bodies_index(scene, bodies, wavelength),
                    there = bodies_index(scene, beyond, wavelength);
        input->inside = there < here;
        input->ior = input->inside ? here / there : there / here;
    }
#else
    (void)bodies, (void)beyond, (void)wavelength;
#endif
#if TRIAD_TRANSMISSION && TRIAD_PRIORITIES
    if (solid && bodies.x == beyond.x && bodies_before(scene, bodies.x, s->material)) {
        /* within a body of higher priority there is no surface: equal indices on both sides, and clear */
        input->base_colour = colour_splat(1.0f);
        input->metallic = 0.0f;
        input->transmission = 1.0f;
    }
#endif
    vertex_core_extensions(scene, s, input);
    const float mirror = fma(1.0f - s->metallic, s->transmission, s->metallic);
    VertexBsdf v;
    const Vec3 normal =
        vertex_shading_normal(back ? vec3_negate(s->shading_normal) : s->shading_normal, ng, wo, mirror);
    v.frame = frame_make(normal);
#if TRIAD_ANISOTROPY
    if (s->anisotropy > 0.0f) v.frame = frame_make_along(normal, s->grain);
#endif
    v.wo = frame_to_local(&v.frame, wo);
    vertex_layers(s, &v.frame, wo, ng, back, back && solid, input);
    return v;
}

/* The same with its BSDF. */
TRIAD_FUNCTION VertexBsdf vertex_bsdf(const Scene* scene, const Surface* s, Vec3 wo, Vec3 ng, int back,
                                      Bodies bodies, Bodies beyond, float wavelength) {
    BsdfInput input;
    VertexBsdf v = vertex_seen(scene, s, wo, ng, back, bodies, beyond, wavelength, &input);
    v.bsdf = bsdf_make(&input, v.wo, scene->albedo);
    return v;
}

#endif
