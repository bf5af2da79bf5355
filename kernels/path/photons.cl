/* Photons: light that reaches a surface by mirrors and glass alone (L S+ D, Heckbert's notation). What the
 * camera sees directly of it is splatted to the film (light tracing, Dutre 1993); where paths meet it later,
 * they gather it from a map (map.cl, shading/photon_map.h). Paths themselves leave this light out
 * (shading/path.cl). For the classic map, every surface scatters photons. One work-item is one photon. */
#include "common/language.h"

#include "common/random.h"
#include "common/spectrum.h"
#include "shading/coverage.h"
#include "shading/emission.h"
#include "shading/photon_map.h"

#include "photon/splat.h"
#include "traversal/traverse.h"

/* From here on roulette never lets a photon survive for certain. */
#define PHOTON_ROULETTE_FROM 64u
#define PHOTON_ROULETTE 0.999f
/* Names the photons' random numbers apart from those of the pixels. */
#define PHOTON_STREAM 0xffffffffu

/* A piece of the film, as pairs of uints: pixels [first_pixel, first_pixel + pixels) of the crop. tiles: 1
 * for those of the picture that get the sample which the photons belong to. */
#define SPLAT_PARAMETERS                                                                                     \
    volatile global uint *sums, volatile global uint *half_sums, global const uint *tiles, uint first_pixel, \
        uint pixels

typedef struct PhotonTally {
    uint rays, not_finite, saturated;
} PhotonTally;

/* What a surface sends from wi towards `out`, of flux per area across wi: f |wi . ns| / |wi . ng| (the
 * adjoint BSDF of Veach 1997, section 5.3.2), evaluated as a path from the camera would, which comes from
 * `out`. */
TRIAD_FUNCTION float3 photon_scatter(const Scene* scene, const Surface* s, float3 wi, float3 out,
                                     const VertexBodies* around, float wavelength) {
    const float facing = math_dot(out, s->geometric_normal), lit = math_dot(wi, s->geometric_normal);
    if (facing == 0.0f || lit == 0.0f) return (float3)(0.0f);
    const int back = facing < 0.0f, through = facing * lit < 0.0f;
    const float3 ng = back ? -s->geometric_normal : s->geometric_normal;
    const VertexBsdf v = vertex_bsdf(scene, s, out, ng, back, through ? around->beyond : around->here,
                                     through ? around->here : around->beyond, wavelength);
    if (!bsdf_has_smooth(&v.bsdf)) return (float3)(0.0f);
    const float3 wi_local = frame_to_local(&v.frame, wi);
    /* light must not go through by the shading normal */
    if (!(wi_local.z * math_dot(wi, ng) > 0.0f)) return (float3)(0.0f);
    float pdf;
    return bsdf_eval(&v.bsdf, v.wo, wi_local, &pdf) * fabs(1.0f / lit);
}

/* Shows the camera what a photon of this power, which came from wi, leaves at the surface. */
TRIAD_FUNCTION void photon_splat(SPLAT_PARAMETERS, const Scene* scene, global const PhotonFrame* photon_frame,
                                 Traversal* traversal, const Surface* s, const Hit* hit, float3 wi,
                                 const VertexBodies* around, float wavelength, float3 power, float2 u,
                                 uint half_index, PhotonTally* tally) {
    global const Frame* frame = scene->frame;
    const Camera camera = frame->camera;
    const Sight sight = splat_sight(&camera, photon_frame->pixel_area, s->position, u);
    const float x = sight.x - (float)frame->crop[0], y = sight.y - (float)frame->crop[1];
    if (!(sight.importance > 0.0f && x >= 0.0f && y >= 0.0f && x < (float)frame->crop[2] &&
          y < (float)frame->crop[3]))
        return;
    const uint px = min((uint)x, frame->crop[2] - 1u), py = min((uint)y, frame->crop[3] - 1u);
    const uint across = (frame->crop[2] + FILM_TILE - 1u) / FILM_TILE;
    if (tiles[py / FILM_TILE * across + px / FILM_TILE] == 0u) return;
    const size_t pixel = (size_t)py * frame->crop[2] + px - first_pixel;
    if (pixel >= pixels) return; /* of another piece, on either side */
    const float facing = math_dot(sight.direction, s->geometric_normal);
    float3 value = power * photon_scatter(scene, s, wi, sight.direction, around, wavelength) *
                   (fabs(facing) * sight.importance);
    if (!(max_abs3(value) > 0.0f)) return; /* light of one wavelength is signed */
#if TRIAD_TRANSMISSION
    const uint body = facing * math_dot(wi, s->geometric_normal) < 0.0f ? around->beyond.s0 : around->here.s0;
    if (body != TRIAD_NONE)
        value *= vertex_transmittance(scene->materials + body, math_length(sight.target - s->position));
#endif
    ++tally->rays;
    const float3 ng = facing < 0.0f ? -s->geometric_normal : s->geometric_normal;
    if (traverse_occluded(traversal, vertex_spawn_to(s, ng, hit, sight.target))) return;
    if (!film_is_finite((float4)(value, 0.0f))) {
        ++tally->not_finite;
        return;
    }
    const uint bx = min((uint)((x - (float)px) * (float)frame->bins[0]), frame->bins[0] - 1u),
               by = min((uint)((y - (float)py) * (float)frame->bins[1]), frame->bins[1] - 1u);
    const size_t bin = pixel * (frame->bins[0] * frame->bins[1]) + by * frame->bins[0] + bx;
    const float channels[3] = {value.x, value.y, value.z};
    for (uint c = 0u; c < 3u; ++c) {
        const long fixed = film_fixed(channels[c], frame->quanta, &tally->saturated);
        splat_add(sums + 2u * (bin * FILM_CHANNELS + c), fixed);
        if (half_index == 0u) splat_add(half_sums + 2u * (pixel * 3u + c), fixed);
    }
}

/* |cos| of a direction at the shading normal over that at the surface. */
TRIAD_FUNCTION float photon_tilt(float shading, float geometric) {
    return geometric != 0.0f ? fabs(shading / geometric) : 0.0f;
}

#if TRIAD_DISPERSION
/* From here on the photon has one wavelength, in nm. */
TRIAD_FUNCTION float photon_draw_wavelength(const Scene* scene, uint light_spectrum, const Sampler* sampler,
                                            float3* filter, float3* per_density) {
    float carried;
    const float wavelength =
        spectrum_draw_light(scene->spectrum, light_spectrum, sampler_2d(sampler, 2u).x, &carried);
    *per_density = (float3)(carried);
    *filter = spectrum_filter(scene->spectrum, wavelength) * carried;
    return wavelength;
}
#endif

#define PHOTON_PARAMETERS                                                                                   \
    SCENE_PARAMETERS, volatile global uint *sums, volatile global uint *half_sums,                          \
        volatile global uint *counters, global const PhotonFrame *photon_frame,                             \
        global const uint *photon_lights, global const Caster *casters, uint sample_low, uint sample_high,  \
        uint first_photon, uint photon_count, float share, global Photon *landed, global const uint *tiles, \
        uint first_pixel, uint pixels

TRIAD_FUNCTION_ONCE void trace_photon(PHOTON_PARAMETERS, size_t item) {
    if (item >= photon_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    /* the halves of the film take turns as in sample_name() */
    const uint bins = frame->bins[0] * frame->bins[1];
    const ulong sample = ((ulong)sample_high << 32) | sample_low, round = sample / bins;
    const uint half_index = (uint)(round & 1ul);
    const ulong index =
        ((round >> 1) * bins + sample % bins) * photon_frame->count + first_photon + (uint)item;
    Sampler sampler = sampler_make(PHOTON_STREAM, (uint)index, (uint)(index >> 32), half_index, frame->seed);
    sampler.first_block = frame->first_block;

    SamplerBlock u = sampler_block(&sampler, 0u);
    const PhotonSource source = photon_emit(&scene, photon_frame, photon_lights, casters, &u);
    const uint scatter = photon_frame->scatter;
    float3 throughput = (float3)(1.0f);
    PhotonTally tally = {0u, 0u, 0u};
    Traversal traversal = traversal_make(nodes, blocks, instances, frame->root);
#if TRIAD_ALPHA_TEST
    Coverage coverage;
    coverage.scene = &scene;
    coverage.ray = random_mix(sampler.key0 ^ sampler.index_reversed);
    traversal.context = &coverage;
#endif
    Photon kept; /* one of the places where it landed, all equally likely */
    kept.direction = 0u;
    uint landings = 0u;
    Bodies bodies = (uint4)(TRIAD_NONE);
    float wavelength = 0.0f; /* nm; 0: all of them together */
    float3 filter = (float3)(1.0f);
    float3 per_density = (float3)(1.0f); /* nm: of the wavelength; in gathering, the filter is the path's */
#if TRIAD_DISPERSION
    /* light with a spectrum of its own has a wavelength from its start */
    if (frame->wavelength_from_camera || source.spectrum != 0u)
        wavelength = photon_draw_wavelength(&scene, source.spectrum, &sampler, &filter, &per_density);
#else
    filter = per_density = spectrum_colour_of_light(scene.spectrum, source.spectrum);
#endif
    float length = 0.0f; /* of the way, for the range of punctual lights */
    int specular = 1;    /* mirrors and glass alone so far */
    Ray ray = source.ray;
    float3 from = (float3)(ray.origin[0], ray.origin[1], ray.origin[2]);
    for (uint edge = 1u; max_abs3(source.power) > 0.0f; ++edge) {
        /* the camera sees path edge + 1 of a path with max_depth edges at most */
        if (frame->max_depth != 0u && edge + 1u > frame->max_depth) break;
        const Hit hit = traverse_closest(&traversal, ray);
        ++tally.rays;
        if (hit.primitive == TRIAD_NONE) break;
        const Surface s = surface_make(&scene, &hit);
        if (scene.materials[s.material].flags & MATERIAL_UNLIT) break;
        const float3 wi = -(float3)(ray.direction[0], ray.direction[1], ray.direction[2]);
        const int back = math_dot(wi, s.geometric_normal) < 0.0f;
        const float3 ng = back ? -s.geometric_normal : s.geometric_normal;
        const float distance = math_length(s.position - from);
        length += distance;
        if (source.range > 0.0f && length >= source.range) break;
        from = s.position;
        const VertexBodies around = vertex_bodies(&scene, &s, back, bodies);
        bodies = around.here;
#if TRIAD_TRANSMISSION
        if (bodies.s0 != TRIAD_NONE)
            throughput *= vertex_transmittance(scene.materials + bodies.s0, distance);
#endif
#if TRIAD_DISPERSION && TRIAD_TRANSMISSION
        /* the first surface that tells wavelengths apart: from here on the photon has one */
        if (wavelength == 0.0f && vertex_disperses(&scene, &s, &around))
            wavelength = photon_draw_wavelength(&scene, source.spectrum, &sampler, &filter, &per_density);
#endif
        u = sampler_block(&sampler, edge);
        float3 power = source.power * throughput * share;
        if (source.range > 0.0f) power *= 1.0f - math_square(math_square(length / source.range));
        if (edge > 1u && !scatter) {
#if TRIAD_ALPHA_TEST
            coverage.ray += 1u;
#endif
            photon_splat(sums, half_sums, tiles, first_pixel, pixels, &scene, photon_frame, &traversal, &s,
                         &hit, wi, &around, wavelength, power * filter,
                         (float2)(random_float(u.x.s2), random_float(u.y.s2)), half_index, &tally);
        }
        const VertexBsdf v = vertex_bsdf(&scene, &s, wi, ng, back, bodies, around.beyond, wavelength);
#if TRIAD_GATHER
        if (frame->photon_map && (edge > 1u || scatter) && bsdf_has_smooth(&v.bsdf)) {
            ++landings;
            if (random_float(u.x.s3) * convert_float(landings) < 1.0f) {
                const int baked = frame->wavelength_from_camera != 0u; /* as it was published: counts twice */
                kept = photon_make(s.position,
                                   power * (baked ? filter : per_density) * (1.0f / math_dot(wi, ng)), wi, ng,
                                   edge, specular && edge > 1u, baked ? 0.0f : wavelength);
            }
        }
#endif
        const BsdfSample sample_out = bsdf_sample(&v.bsdf, v.wo, random_float(u.x.s1),
                                                  (float2)(random_float(u.x.s0), random_float(u.y.s0)));
        const int delta = (sample_out.event & BSDF_DELTA) != 0u;
        if (sample_out.event == BSDF_NONE || !(delta || scatter)) break;
        const float3 direction = frame_to_world(&v.frame, sample_out.wi);
        const float side = math_dot(direction, ng);
        if (!(side * sample_out.wi.z > 0.0f)) break;
        if (delta) {
            throughput *= sample_out.weight;
            /* the adjoint of refraction: flux does not change as radiance does; and of shading normals */
            throughput *= photon_tilt(v.wo.z, math_dot(wi, ng)) / photon_tilt(sample_out.wi.z, side);
#if BSDF_TRANSMISSION
            if (sample_out.event & BSDF_TRANSMIT) throughput *= 1.0f / v.bsdf.body_scale;
#endif
        } else {
            throughput *= photon_scatter(&scene, &s, wi, direction, &around, wavelength) *
                          (fabs(side) / sample_out.pdf);
            specular = 0;
        }
#if BSDF_TRANSMISSION
        if (sample_out.event & BSDF_TRANSMIT) bodies = around.beyond;
#endif
        const float most = edge >= PHOTON_ROULETTE_FROM ? PHOTON_ROULETTE : 1.0f;
        const float survive = math_min(math_max3(throughput) * frame->roulette, most);
        if (!(random_float(u.y.s1) < survive)) break;
        throughput *= 1.0f / survive;
#if TRIAD_ALPHA_TEST
        coverage.ray += 1u;
#endif
        ray = vertex_spawn(&s, side > 0.0f ? ng : -ng, &hit, direction);
    }
#if TRIAD_GATHER
    if (frame->photon_map) {
        for (uint c = 0u; c < 3u; ++c) kept.power[c] *= convert_float(landings);
        landed[first_photon + item] = kept;
    }
#else
    (void)kept, (void)landings, (void)specular, (void)per_density;
#endif
    counter_add(counters, COUNTER_RAYS, tally.rays);
    counter_add(counters, COUNTER_NOT_FINITE, tally.not_finite);
    counter_add(counters, COUNTER_SATURATED, tally.saturated);
}

/* Photons [first_photon, first_photon + photon_count) of a sample of the picture, for a piece of the film.
 * share: one over the number of photons that are traced for the sample. landed: a place for each photon of
 * the sample, or null; no edges: it landed nowhere. */
kernel void trace_photons(PHOTON_PARAMETERS) {
    trace_photon(SCENE_ARGUMENTS, sums, half_sums, counters, photon_frame, photon_lights, casters, sample_low,
                 sample_high, first_photon, photon_count, share, landed, tiles, first_pixel, pixels,
                 get_global_id(0));
}
