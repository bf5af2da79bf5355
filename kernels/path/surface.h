/* Stage `surface`: the path looks at what its edge has met. */
#ifndef TRIAD_PATH_SURFACE_H
#define TRIAD_PATH_SURFACE_H

#include "path/record.h"
#include "shading/facing.h"
#include "shading/vertex_bsdf.h"

/* A surface may have to be looked at with each of the path's wavelengths. */
#define PATH_EACH (TRIAD_HERO && TRIAD_DISPERSION && BSDF_TRANSMISSION)

/* Stages that are launches look at a surface several times, and keep what takes long: means of films. */
#ifndef TRIAD_STAGES
#define TRIAD_STAGES 0
#endif
#define PATH_KEEPS_FILMS (TRIAD_STAGES && BSDF_FILM)

/* The end of an edge. */
typedef struct Vertex {
    Surface surface;
    Hit hit;
    Vec3 wo;             /* unit, back along the edge */
    Vec3 ng;             /* geometric normal on wo's side */
    int back;            /* that is the inner side of the surface */
    VertexBodies around; /* here: on wo's side */
#if PATH_EACH
    int each; /* every wavelength sees another BSDF: path_bsdf() */
#endif
#if PATH_KEEPS_FILMS
    global float* films; /* POOL_FILM_WORDS */
#endif
} Vertex;

/* How much of the surface the vertex stands for: of the solid angle in which the samples of its bin so far
 * have looked for it, an equal share of each. It shrinks with every sample, and with it what colours are
 * averaged over, so that the picture is the same in the limit. Of a pixel, where nothing blurred since the
 * camera; the edges before the last are left out, and the slant of the surface, since a mean over less is
 * right too. A factor from 1 to 4 is left to chance: it chooses between two levels of a texture, which have
 * texels of areas 1 to 4. */
TRIAD_FUNCTION float path_covers(const Scene* scene, const PathState* path, const Hit* hit) {
#if TRIAD_TEXTURE_LEVELS
    global const Frame* frame = scene->frame;
    const Sampler s = path_sampler(path);
    const float index = (float)random_reverse_bits(s.index_reversed); /* within a half of the film */
    const float samples = fma(2.0f, index, (float)(frame->bins[0] * frame->bins[1]));
    const float chance =
        random_float(random_mix(random_mix(s.key0 ^ s.index_reversed) + 0x9e3779b9u * path->edge));
    float area = math_square(hit->t);
    if (path->pdf > 0.0f)
        area /= path->pdf;
    else
        area = frame->camera.pixel_area * (frame->camera.projection == CAMERA_ORTHOGRAPHIC ? 1.0f : area);
    return area / samples * fma(3.0f, chance, 1.0f);
#else
    (void)scene, (void)path, (void)hit;
    return 0.0f;
#endif
}

/* What lies there. */
TRIAD_FUNCTION Vertex path_look(const Scene* scene, const PathState* path, const Hit* hit) {
    Vertex v;
    v.hit = *hit;
    v.surface = surface_make(scene, hit, path_covers(scene, path, hit));
#if TRIAD_HERO
    v.surface.base_values = path_colour(&path->colours, v.surface.base_colour);
    v.surface.specular_values = path_colour(&path->colours, v.surface.specular_colour);
#if TRIAD_SHEEN
    v.surface.sheen_values = path_colour(&path->colours, v.surface.sheen);
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    v.surface.through_values = path_colour(&path->colours, v.surface.through_colour);
#endif
#if TRIAD_IRIDESCENCE
    v.surface.wavelengths = path_wavelengths(&path->colours);
#endif
#endif
    v.wo = vec3_negate(path_direction(path));
    v.back = vec3_dot(v.wo, v.surface.geometric_normal) < 0.0f;
    v.ng = v.back ? vec3_negate(v.surface.geometric_normal) : v.surface.geometric_normal;
#if TRIAD_TRANSMISSION
    v.around = vertex_bodies(scene, &v.surface, v.back, path->bodies);
#else
    v.around = vertex_bodies(scene, &v.surface, v.back, bodies_none());
#endif
    return v;
}

/* The path is here; the body along the edge has absorbed its part. */
TRIAD_FUNCTION void path_reach(const Scene* scene, PathState* path, const Vertex* v) {
#if TRIAD_TRANSMISSION
    const uint body = v->around.here.x;
    path->bodies = v->around.here;
    if (body != TRIAD_NONE && !path_is_back(path))
        path->throughput = colour_mul(
            path->throughput, path_transmittance(&path->colours, scene->materials + body,
                                                 vec3_length(vec3_sub(v->surface.position, path->from))));
    path->from = v->surface.position;
#else
    (void)scene, (void)path, (void)v;
#endif
}

/* Where lights are picked for this vertex: light from behind is lost on what transmits nothing. After
 * path_emission(), which asks about the vertex before. */
TRIAD_FUNCTION void path_face(const Scene* scene, PathState* path, const Vertex* v) {
    (void)scene, (void)path, (void)v;
    int is_opaque = 1;
#if TRIAD_TRANSMISSION
    is_opaque = !(scene->materials[v->surface.material].transmission > 0.0f);
#endif
#if TRIAD_DIFFUSE_TRANSMISSION
    if (v->surface.through > 0.0f) is_opaque = 0;
#endif
    (void)is_opaque;
#if TRIAD_LIGHT_TREE
    path->normal = is_opaque ? v->ng : vec3_splat(0.0f);
#elif TRIAD_ENVIRONMENT_MAP
    const uint facing = facing_of(v->ng) << PATH_FACING_SHIFT;
    path->traits = (path->traits & ((1u << PATH_FACING_SHIFT) - 1u)) | (is_opaque ? facing : 0u);
#endif
}

TRIAD_FUNCTION Vertex path_surface(const Scene* scene, PathState* path, const Hit* hit, Tally* tally) {
    const Vertex v = path_look(scene, path, hit);
    record_vertex(tally, path, v.surface.position, hit, v.surface.material);
    path_reach(scene, path, &v);
    return v;
}

#endif
