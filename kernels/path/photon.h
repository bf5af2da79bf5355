/* The driver of photons: light that reaches a surface by mirrors and glass alone (L S+ D, Heckbert's
 * notation); for the classic map, every surface scatters photons. Photons are paths from a light, and go
 * through the stages of paths; what differs is said here. */
#ifndef TRIAD_PATH_PHOTON_H
#define TRIAD_PATH_PHOTON_H

#include "shading/emission.h"

#include "path/bsdf.h"
#include "path/photon_splat.h"
#include "path/survive.h"

/* Names the photons' random numbers apart from those of the pixels. */
#define PHOTON_STREAM 0xffffffffu

typedef struct PhotonState {
    PathState path; /* its throughput is of flux: radiance over what bodies scale it by */
    PhotonSource source;
    float length;     /* of the way, for the range of punctual lights */
    Vec3 per_density; /* nm: of the wavelength; in gathering, the filter is the path's */
    uint ray_name;
    Photon kept; /* one of the places where it landed, all equally likely */
    uint landings;
} PhotonState;

/* From here on the photon has one wavelength. */
TRIAD_FUNCTION void photon_draw_wavelength(const Scene* scene, PhotonState* photon) {
#if TRIAD_DISPERSION
    float carried;
    const float wavelength =
        spectrum_draw_light(scene->spectrum, photon->source.spectrum,
                            sampler_2d(&photon->path.sampler, PATH_WAVELENGTH_SET).x, &carried);
    photon->path.colours.wavelength = wavelength;
    photon->per_density = vec3_splat(carried);
#else
    (void)scene, (void)photon;
#endif
}

/* index: of the photon in the sequence of a half of the film. */
TRIAD_FUNCTION PhotonState photon_start(const Scene* scene, global const PhotonFrame* photon_frame,
                                        global const uint* lights, global const Caster* casters, ulong index,
                                        uint half_index) {
    global const Frame* frame = scene->frame;
    Sampler sampler = sampler_make(PHOTON_STREAM, (uint)index, (uint)(index >> 32), half_index, frame->seed);
    sampler.first_block = frame->first_block;
    const SamplerBlock u = sampler_block(&sampler, 0u);
    PhotonState photon;
    photon.source = photon_emit(scene, photon_frame, lights, casters, &u);
    const Ray ray = photon.source.ray;
    photon.path = path_state(&sampler, ray, path_colour_white());
    photon.length = 0.0f;
    photon.ray_name = coverage_ray(&sampler, 0u);
    photon.kept.direction = 0u;
    photon.landings = 0u;
#if TRIAD_DISPERSION
    photon.per_density = vec3_splat(1.0f);
    /* light with a spectrum of its own has a wavelength from its start */
    if (frame->wavelength_from_camera || photon.source.spectrum != 0u) photon_draw_wavelength(scene, &photon);
#else
    photon.per_density = spectrum_colour_of_light(scene->spectrum, photon.source.spectrum);
#endif
    return photon;
}

/* The first surface that tells wavelengths apart. */
TRIAD_FUNCTION void photon_disperse(const Scene* scene, PhotonState* photon, const Vertex* vertex) {
#if TRIAD_DISPERSION && TRIAD_TRANSMISSION
    if (path_wavelength(&photon->path.colours) == 0.0f &&
        vertex_disperses(scene, &vertex->surface, &vertex->around))
        photon_draw_wavelength(scene, photon);
#else
    (void)scene, (void)photon, (void)vertex;
#endif
}

/* 0: the surface gets none of it: it is unlit, or out of the light's range. */
TRIAD_FUNCTION int photon_arrives(const Scene* scene, PhotonState* photon, const Vertex* vertex) {
    photon->length += vertex->hit.t;
    return !(scene->materials[vertex->surface.material].flags & MATERIAL_UNLIT) &&
           !(photon->source.range > 0.0f && photon->length >= photon->source.range);
}

/* What it brings there. share: one over the photons of the sample. */
TRIAD_FUNCTION Vec3 photon_power(const PhotonState* photon, float share) {
    const Vec3 power = vec3_scale(vec3_mul(photon->source.power, photon->path.throughput), share);
    const float range = photon->source.range;
    return range > 0.0f ? vec3_scale(power, 1.0f - math_square(math_square(photon->length / range))) : power;
}

/* What it adds to the film, of its power. */
TRIAD_FUNCTION Vec3 photon_filter(const Scene* scene, const PhotonState* photon) {
#if TRIAD_DISPERSION
    const float wavelength = path_wavelength(&photon->path.colours);
    if (wavelength > 0.0f) return vec3_mul(spectrum_filter(scene->spectrum, wavelength), photon->per_density);
#else
    (void)scene;
#endif
    return photon->per_density;
}

/* The photon may be kept for the map as it landed here. */
TRIAD_FUNCTION void photon_land(const Scene* scene, PhotonState* photon, const Vertex* vertex,
                                const VertexBsdf* v, Vec3 power, const SamplerBlock* u) {
#if TRIAD_GATHER
    const PathState* path = &photon->path;
    if (scene->frame->photon_map == 0u || !bsdf_has_smooth(&v->bsdf)) return;
    ++photon->landings;
    if (!(random_float(u->set[3].x) * (float)photon->landings < 1.0f)) return;
    const int baked = scene->frame->wavelength_from_camera != 0u; /* as it was published: counts twice */
    const Vec3 flux = vec3_mul(power, baked ? photon_filter(scene, photon) : photon->per_density);
    photon->kept =
        photon_make(vertex->surface.position, vec3_scale(flux, 1.0f / vec3_dot(vertex->wo, vertex->ng)),
                    vertex->wo, vertex->ng, path->edge, (path->traits & PATH_SPECULAR) && path->edge > 1u,
                    baked ? 0.0f : path_wavelength(&path->colours));
#else
    (void)scene, (void)photon, (void)vertex, (void)v, (void)power, (void)u;
#endif
}

/* |cos| of a direction at the shading normal over that at the surface. */
TRIAD_FUNCTION float photon_tilt(float shading, float geometric) {
    return geometric != 0.0f ? fabs(shading / geometric) : 0.0f;
}

/* path_scatter() for flux. everywhere: else by mirrors and glass alone. 0: the photon is absorbed. */
TRIAD_FUNCTION int photon_scatter(const Scene* scene, PathState* path, const Vertex* vertex,
                                  const VertexBsdf* v, const SamplerBlock* u, int everywhere,
                                  Scatter* scatter) {
    if (!scatter_sample(vertex, v, u, scatter)) return 0;
    const uint event = scatter->sample.event;
    if (event & BSDF_DELTA) {
        path->throughput = vec3_mul(path->throughput, scatter->sample.weight);
        /* the adjoint of refraction: flux does not change as radiance does; and of shading normals */
        path->throughput =
            vec3_scale(path->throughput, photon_tilt(v->wo.z, vec3_dot(vertex->wo, vertex->ng)) /
                                             photon_tilt(scatter->sample.wi.z, scatter->side));
#if BSDF_TRANSMISSION
        if ((event & BSDF_TRANSMIT) && !(event & BSDF_DIFFUSE))
            path->throughput = vec3_scale(path->throughput, 1.0f / bsdf_body_scale(&v->bsdf));
#endif
    } else if (everywhere) {
        const Vec3 value = photon_bsdf(scene, &vertex->surface, vertex->wo, scatter->direction,
                                       &vertex->around, path_wavelength(&path->colours));
        path->throughput =
            vec3_mul(path->throughput, vec3_scale(value, fabs(scatter->side) / scatter->sample.pdf));
    } else {
        return 0;
    }
    scatter_bodies(path, vertex, event);
    path->traits = scatter_traits(path->traits, path->edge, event);
    return 1;
}

/* An edge and the vertex at its end. 0: the photon's way ends there. */
TRIAD_FUNCTION_PER_CALL int photon_edge(const Scene* scene, global const PhotonFrame* photon_frame,
                                        const SplatFilm* film, float share, PhotonState* photon,
                                        Tally* tally) {
    PathState* path = &photon->path;
    const uint max_depth = scene->frame->max_depth;
    /* the camera sees path edge + 1 of a path with max_depth edges at most */
    if (max_depth != 0u && path->edge + 1u > max_depth) return 0;
    const Hit hit = rays_closest(scene, path->ray, photon->ray_name, tally);
    if (hit.primitive == TRIAD_NONE) return 0;
    Vertex vertex = path_surface(scene, path, &hit, tally);
    if (!photon_arrives(scene, photon, &vertex)) return 0;
    photon_disperse(scene, photon, &vertex);

    const SamplerBlock u = path_numbers(path);
    const Vec3 power = photon_power(photon, share);
    const int everywhere = photon_frame->scatter != 0u;
    if (path->edge > 1u && !everywhere)
        photon_splat(scene, film, photon_frame->pixel_area, &vertex, path_wavelength(&path->colours),
                     vec3_mul(power, photon_filter(scene, photon)), random_point(u.set[2]),
                     ++photon->ray_name, tally);
    const VertexBsdf bsdf = path_bsdf(scene, path, &vertex);
    if (path->edge > 1u || everywhere) photon_land(scene, photon, &vertex, &bsdf, power, &u);

    Scatter scatter;
    ++photon->ray_name;
    return photon_scatter(scene, path, &vertex, &bsdf, &u, everywhere, &scatter) &&
           path_survive(scene, path, &vertex, &scatter, &u, tally);
}

#endif
