/* Stage `surface`: the path looks at what its edge has met. */
#ifndef TRIAD_PATH_SURFACE_H
#define TRIAD_PATH_SURFACE_H

#include "path/record.h"
#include "shading/vertex_bsdf.h"

/* A surface may have to be looked at with each of the path's wavelengths. */
#define PATH_EACH (TRIAD_HERO && TRIAD_DISPERSION && BSDF_TRANSMISSION)

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
} Vertex;

/* The bodies that meet here; the one along the edge has absorbed its part. */
TRIAD_FUNCTION VertexBodies path_bodies(const Scene* scene, PathState* path, const Surface* s, int back) {
#if TRIAD_TRANSMISSION
    const VertexBodies around = vertex_bodies(scene, s, back, path->bodies);
    path->bodies = around.here;
    if (around.here.x != TRIAD_NONE && !path_is_back(path))
        path->throughput =
            colour_mul(path->throughput, path_transmittance(&path->colours, scene->materials + around.here.x,
                                                            vec3_length(vec3_sub(s->position, path->from))));
    path->from = s->position;
    return around;
#else
    (void)path;
    return vertex_bodies(scene, s, back, bodies_none());
#endif
}

TRIAD_FUNCTION Vertex path_surface(const Scene* scene, PathState* path, const Hit* hit, Tally* tally) {
    Vertex v;
    v.hit = *hit;
    v.surface = surface_make(scene, hit);
#if TRIAD_HERO
    v.surface.base_values = path_colour(&path->colours, v.surface.base_colour);
    v.surface.specular_values = path_colour(&path->colours, v.surface.specular_colour);
#endif
    record_vertex(tally, path, v.surface.position, hit, v.surface.material);
    v.wo = vec3_negate(path_direction(path));
    v.back = vec3_dot(v.wo, v.surface.geometric_normal) < 0.0f;
    v.ng = v.back ? vec3_negate(v.surface.geometric_normal) : v.surface.geometric_normal;
    v.around = path_bodies(scene, path, &v.surface, v.back);
    return v;
}

#endif
