/* The path tracer as a megakernel: one work-item is one pixel, and loops over the samples of the launch.
 * Unidirectional paths with next-event estimation, multiple importance sampling and Russian roulette. */
#include "common/language.h"

#include "common/film.h"
#include "common/random.h"
#include "shading/coverage.h"
#include "shading/light.h"
#include "shading/path_colour.h"
#include "shading/path_state.h"
#include "shading/photon_map.h"
#include "shading/record.h"
#include "shading/sample.h"
#include "traversal/traverse.h"

/* From here on roulette never lets a path survive for certain, so that none is endless (a ray caught in clear
 * glass). */
#define ROULETTE_ALWAYS_FROM 64u
#define ROULETTE_ALWAYS 0.999f

/* A surface may have to be looked at with each of the path's wavelengths. */
#define PATH_EACH (TRIAD_HERO && TRIAD_DISPERSION && BSDF_TRANSMISSION)
/* What one work-item counts, in registers, for COUNTER_*. */
typedef struct Tally {
    uint rays, not_finite, saturated, truncated, cut_energy;
    RECORD(Recorder recorder;)
} Tally;

/* Radiance and alpha along one camera ray. */
TRIAD_FUNCTION_PER_CALL float4 path_trace(const Scene* scene, const Sampler* sampler, Ray ray, Tally* tally) {
    global const Frame* frame = scene->frame;
    const uint max_depth = frame->max_depth;
    Colour radiance = (Colour)(0.0f);
    float alpha = 1.0f;
#if PATH_GATHERS
    const uint map_use = frame->photon_map;
#else
    const uint map_use = 0u;
#endif
    PathState path = path_start(ray);
#if PATH_FORKS
    PathFork fork = path_fork_start(path);
#endif
    Sampler random = *sampler;
    PathColour colours = path_colour_start(scene, sampler);
    Traversal traversal = traversal_make(scene->nodes, scene->blocks, scene->instances, frame->root);
#if TRIAD_ALPHA_TEST
    Coverage coverage;
    coverage.scene = scene;
    traversal.context = &coverage;
#endif
    do {
        for (;; ++path.edge) {
#if PATH_FORKS
            if (colours.wavelength == 0.0f) fork.path = path;
            const int again = path_is_at_fork(&fork, &path);
#else
            const int again = 0;
#endif
#if TRIAD_ALPHA_TEST
            coverage.ray = random_mix(random.key0 ^ random.index_reversed) + 2u * path.edge;
#endif
            const SamplerBlock u = sampler_block(&random, path.edge);
#if TRIAD_ENVIRONMENT_MAP
            if (frame->environment.light != TRIAD_NONE) environment_prefetch_columns(scene, u.set[3]);
#endif
#if PATH_FORKS
            const Hit hit = again ? fork.hit : traverse_closest(&traversal, path.ray);
#else
            const Hit hit = traverse_closest(&traversal, path.ray);
#endif
            if (!again) ++tally->rays;
            const float3 wo = -(float3)(path.ray.direction[0], path.ray.direction[1], path.ray.direction[2]);
            if (hit.primitive == TRIAD_NONE) {
                RECORD(record_vertex(&tally->recorder, path.edge, path_wavelength(&colours), -wo, &hit,
                                     TRIAD_NONE);)
                RECORD(record_end(&tally->recorder, PATH_LEFT_SCENE);)
                if (path.straight && frame->transparent) {
                    /* weights above 1 make up for paths that ended in a surface: no clamping */
                    alpha -= path_share(&colours) * colour_average(path.throughput) / path.body_scale;
                    break;
                }
                float light_pdf;
                const Colour sky = path_colour(&colours, environment_radiance(scene, -wo, &light_pdf));
                float weight = path.pdf > 0.0f ? power_heuristic(light_pdf / path.pdf) : 1.0f;
#if TRIAD_PHOTONS
                if (path.pdf == 0.0f && (map_use ? !path.specular : path.caustic) &&
                    frame->environment.photons)
                    weight = 0.0f;
#endif
                const Colour found = path.throughput * sky * weight;
                radiance += found;
                RECORD(record_found(&tally->recorder, path_found(&colours, found));)
                break;
            }

#if TRIAD_HERO
            Surface s = surface_make(scene, &hit);
            s.base_values = path_colour(&colours, s.base_colour);
            s.specular_values = path_colour(&colours, s.specular_colour);
#else
            const Surface s = surface_make(scene, &hit);
#endif
            RECORD(record_vertex(&tally->recorder, path.edge, again ? 0.0f : path_wavelength(&colours),
                                 s.position, &hit, s.material);)
            global const Material* material = scene->materials + s.material;
            const uint flags = material->flags;
            const int back = math_dot(wo, s.geometric_normal) < 0.0f;
            const float3 ng = back ? -s.geometric_normal : s.geometric_normal;
            const VertexBodies around = vertex_bodies(scene, &s, back, path.bodies);
            path.bodies = around.here;
            const Bodies beyond = around.beyond;
#if TRIAD_TRANSMISSION
            if (path.bodies.s0 != TRIAD_NONE)
                path.throughput *= path_transmittance(&colours, scene->materials + path.bodies.s0,
                                                      math_length(s.position - path.from));
            path.from = s.position;
#endif
#if TRIAD_UNLIT
            if (flags & MATERIAL_UNLIT) { /* shows its colour to the camera, directly or in mirrors; black to
                                             all else */
                const Colour found =
                    path.specular ? path.throughput * path_colour(&colours, s.base_colour) : (Colour)(0.0f);
                radiance += found;
                RECORD(record_found(&tally->recorder, path_found(&colours, found));)
                RECORD(record_end(&tally->recorder, PATH_UNLIT);)
                break;
            }
#endif
#if TRIAD_TRIANGLE_LIGHTS
            const uint first_light = scene->geometries[s.geometry].first_light;
            if (!again && first_light != TRIAD_NONE && (!back || (flags & MATERIAL_DOUBLE_SIDED))) {
                float weight = 1.0f;
                global const Light* found_light = scene->lights + first_light + hit.primitive -
                                                  scene->geometries[s.geometry].first_triangle;
#if TRIAD_PHOTONS
                if (path.pdf == 0.0f && (map_use ? !path.specular : path.caustic) &&
                    (found_light->flags & LIGHT_PHOTONS))
                    weight = 0.0f;
#endif
                if (path.pdf > 0.0f) {
                    const Light light = *found_light;
                    weight = power_heuristic(
                        1.0f / (path.pdf * light_triangle_inverse_pdf(&light, 1.0f / (hit.t * hit.t),
                                                                      math_dot(ng, wo))));
                }
                const Colour found = path.throughput *
                                     path_light(scene, &colours, found_light->flags,
                                                surface_emission(scene, material, s.uv0, s.uv1)) *
                                     weight;
                radiance += found;
                RECORD(record_found(&tally->recorder, path_found(&colours, found));)
            }
#endif
            if (path.edge == max_depth) {
                ++tally->truncated;
                tally->cut_energy +=
                    (uint)(math_min(path_share(&colours) * colour_luminance(path.throughput), 65535.0f) *
                           65536.0f);
                RECORD(record_end(&tally->recorder, PATH_LONGEST);)
                break;
            }

#if TRIAD_DISPERSION && TRIAD_TRANSMISSION
            const int disperses = vertex_disperses(scene, &s, &around);
#if !TRIAD_HERO
            if (disperses && (colours.wavelength == 0.0f || again)) {
                fork.hit = hit;
                path_draw_wavelength(&colours, scene, sampler, fork.branch, &radiance);
                random = path_branch_sampler(sampler, fork.branch);
            }
#endif
#endif
            const VertexBsdf vertex =
                vertex_bsdf(scene, &s, wo, ng, back, path.bodies, beyond, path_wavelength(&colours));
            const float3 wo_local = vertex.wo;
            const Bsdf bsdf = vertex.bsdf;
#if PATH_EACH
            int each = disperses && path_has_others(&colours); /* wavelengths are looked at one by one */
            if (each && bsdf.smooth) {
                path_end_others(&colours, &path.throughput);
                each = 0;
            }
#endif

#if PATH_GATHERS
            /* the photons here bring all light, also what light sampling would */
            const int ends_in_map = map_use == PHOTON_MAP_FINAL_GATHER && !path.specular;
            if (map_use && bsdf_has_smooth(&bsdf))
                radiance += path.throughput * path_gather(scene, &s, ng, &vertex, path.edge, path.specular,
                                                          path_wavelength(&colours));
            if (frame->light_count != 0u && !ends_in_map && bsdf_has_smooth(&bsdf)) {
#else
            if (frame->light_count != 0u && bsdf_has_smooth(&bsdf)) {
#endif
                LightSample light;
                if (light_sample(scene, s.position, u.set[2].x, u.set[3], &light)) {
                    const float side = math_dot(light.direction, ng);
                    const float3 wi = frame_to_local(&vertex.frame, light.direction);
                    /* the shading normal must not move light through the surface */
                    int lit = side * wi.z > 0.0f;
#if TRIAD_ENVIRONMENT_MAP
                    /* what the camera sees through the surface is alpha, however it is found (pdf 0: no map)
                     */
                    if (path.straight && side < 0.0f && frame->transparent && light.distant &&
                        light.inverse_pdf > 0.0f)
                        lit = 0;
#endif
                    if (lit) {
                        float bsdf_pdf;
                        Colour direct = bsdf_eval(&bsdf, wo_local, wi, &bsdf_pdf);
#if PATH_EACH
                        if (each) {
                            float4 densities;
                            direct = path_eval_each(scene, &colours, &s, wo, ng, back, path.bodies, beyond,
                                                    wi, &densities);
                            bsdf_pdf = path_mean_density(&colours, densities);
                        }
#endif
                        direct = path.throughput * direct;
#if TRIAD_TRANSMISSION
                        const uint around_light = side < 0.0f ? beyond.s0 : path.bodies.s0;
                        if (around_light != TRIAD_NONE && !light.distant)
                            direct *= path_transmittance(&colours, scene->materials + around_light,
                                                         math_length(light.target - s.position));
#endif
                        /* the colour of a light with a spectrum is signed */
                        if (colour_max(fabs(direct *
                                            path_light(scene, &colours, light.flags, light.weight))) > 0.0f) {
                            const float3 away = side > 0.0f ? ng : -ng;
#if TRIAD_ALPHA_TEST
                            coverage.ray += 1u;
#endif
                            const Ray shadow = light.distant ? vertex_spawn(&s, away, &hit, light.direction)
                                                             : vertex_spawn_to(&s, away, &hit, light.target);
                            ++tally->rays;
                            if (!traverse_occluded(&traversal, shadow) && light_complete(scene, &light)) {
#if PATH_GATHERS
                                if (map_use == PHOTON_MAP_VISUALISED)
                                    bsdf_pdf = 0.0f; /* no path goes there */
#endif
                                direct *= path_light(scene, &colours, light.flags, light.weight) *
                                          power_heuristic(bsdf_pdf * light.inverse_pdf);
                                radiance += direct;
                                RECORD(record_direct(&tally->recorder, path_found(&colours, direct), scene,
                                                     u.set[2].x);)
                            }
                        }
                    }
                }
            }

            RECORD(record_end(&tally->recorder, PATH_ABSORBED);)
            const BsdfSample sample =
                bsdf_sample(&bsdf, wo_local, random_float(u.set[1].x), random_point(u.set[0]));
            if (sample.event == BSDF_NONE) break;
#if PATH_GATHERS
            if ((ends_in_map || map_use == PHOTON_MAP_VISUALISED) && !(sample.event & BSDF_DELTA)) break;
#endif
            const float3 direction = frame_to_world(&vertex.frame, sample.wi);
            const float side = math_dot(direction, ng);
            if (!(side * sample.wi.z > 0.0f)) break;
            Colour weight = sample.weight;
            float density = sample.pdf;
#if PATH_EACH
            if (each) {
                float4 densities;
                weight = path_eval_each(scene, &colours, &s, wo, ng, back, path.bodies, beyond, sample.wi,
                                        &densities);
                density = path_mean_density(&colours, densities);
                if (!(density > 0.0f)) break;
                weight *= 1.0f / density;
                colours.share *= densities / density;
            }
#endif
            path.throughput *= weight;
#if BSDF_TRANSMISSION
            if (sample.event & BSDF_TRANSMIT) {
                path.body_scale *= bsdf.body_scale;
                path.bodies = beyond;
            }
#endif
            path.pdf = (sample.event & BSDF_DELTA) ? 0.0f : density;
            path.straight = path.straight && (sample.event & BSDF_TRANSMIT);
            path.specular = path.specular && (sample.event & BSDF_DELTA);
#if TRIAD_PHOTONS
            path.caustic =
                path.edge == 1u ? !(sample.event & BSDF_DELTA) : path.caustic && (sample.event & BSDF_DELTA);
#endif

            const float most = path.edge >= ROULETTE_ALWAYS_FROM ? ROULETTE_ALWAYS : 1.0f;
            const float survive =
                math_min(colour_max(path.throughput) * frame->roulette / path.body_scale, most);
            RECORD(record_end(&tally->recorder, PATH_ROULETTE);)
            if (!(random_float(u.set[1].y) < survive)) break;
            path.throughput *= 1.0f / survive;
            RECORD(record_end(&tally->recorder, PATH_GOES_ON);)
            RECORD(record_event(&tally->recorder, sample.event, path_found(&colours, path.throughput));)
            path.ray = vertex_spawn(&s, side > 0.0f ? ng : -ng, &hit, direction);
        }
    } while (path_next_branch(&fork, &path, &colours));
    return (float4)(path_rgb(&colours, radiance), alpha);
}

/* What a pixel (x, y) of the crop is called by its samples: its index in the full picture. */
TRIAD_FUNCTION uint film_pixel(const Frame* frame, uint x, uint y) {
    return (frame->crop[1] + y) * (uint)frame->camera.pixels[0] + frame->crop[0] + x;
}

#if !TRIAD_RECORD
#define TRACE_PARAMETERS                                                                               \
    SCENE_PARAMETERS, global long *sums, global long *half_sums, global uint *samples,                 \
        volatile global uint *counters, global const TileWork *work, uint first_work, uint work_count, \
        uint first_sample_low, uint first_sample_high, uint first_pixel

/* What one item of trace_paths does. */
TRIAD_FUNCTION_ONCE void trace_pixel(TRACE_PARAMETERS, size_t item) {
    if (item >= (size_t)work_count * FILM_TILE_PIXELS) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    work += first_work + item / FILM_TILE_PIXELS;
    uint x, y;
    if (!sample_pixel(local_frame.crop, work->tile * FILM_TILE_PIXELS + item % FILM_TILE_PIXELS, &x, &y))
        return;
    const uint set = (x ^ y) & 1u, sample_count = work->sample_count[set];
    const uint full_pixel = film_pixel(&local_frame, x, y);
    const size_t pixel = (size_t)y * local_frame.crop[2] + x;
    const uint bins = local_frame.bins[0] * local_frame.bins[1];
    const ulong first = (((ulong)first_sample_high << 32) | first_sample_low) + work->first_sample[set];
    Tally tally = {0u, 0u, 0u, 0u, 0u};
    for (uint i = 0u; i < sample_count; ++i) {
        const SampleName name = sample_name(&local_frame, full_pixel, first + i);
        SampleWeight weight;
        const Ray ray = sample_camera_ray(&local_frame, ray_filter, &name, x, y, &weight);
        const float4 value = sample_weighted(path_trace(&scene, &name.path, ray, &tally), weight);
        if (!film_is_finite(value)) {
            ++tally.not_finite;
            continue;
        }
        uint saturated = 0u;
        const long r = film_fixed(value.x, local_frame.quanta, &saturated);
        const long g = film_fixed(value.y, local_frame.quanta, &saturated);
        const long b = film_fixed(value.z, local_frame.quanta, &saturated);
        const long a = film_fixed(value.w, local_frame.quanta, &saturated);
        tally.saturated += saturated;
        global long* sum = sums + ((pixel - first_pixel) * bins + name.bin) * FILM_CHANNELS;
        sum[0] = add_sat(sum[0], r), sum[1] = add_sat(sum[1], g), sum[2] = add_sat(sum[2], b),
        sum[3] = add_sat(sum[3], a);
        if (name.half_index == 0u) {
            global long* half_sum = half_sums + (pixel - first_pixel) * 3;
            half_sum[0] = add_sat(half_sum[0], r), half_sum[1] = add_sat(half_sum[1], g),
            half_sum[2] = add_sat(half_sum[2], b);
        }
    }
    samples[pixel] += sample_count;
    counter_add(counters, COUNTER_RAYS, tally.rays);
    counter_add(counters, COUNTER_NOT_FINITE, tally.not_finite);
    counter_add(counters, COUNTER_SATURATED, tally.saturated);
    counter_add(counters, COUNTER_TRUNCATED, tally.truncated);
    counter_add(counters, COUNTER_CUT_ENERGY, tally.cut_energy);
}

/* Adds to the film the samples that work[first_work, first_work + work_count) names, from first_sample on. */
kernel void trace_paths(TRACE_PARAMETERS) {
    trace_pixel(SCENE_ARGUMENTS, sums, half_sums, samples, counters, work, first_work, work_count,
                first_sample_low, first_sample_high, first_pixel, get_global_id(0));
}
#endif
