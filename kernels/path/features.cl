/* What the camera's rays meet first, for the picture's feature channels. */
#include "common/language.h"

#include "path/camera_packet.h"
#include "path/surface.h"

/* What camera rays have met: sums of those that hit, `hits` of them. */
typedef struct FeatureSums {
    Vec3 albedo, normal, position;
    float depth;
    uint hits;
} FeatureSums;

TRIAD_FUNCTION void features_add(const Scene* scene, const CameraSample* sample, const Hit* hit,
                                 FeatureSums* sums, Tally* tally) {
    if (hit->primitive == TRIAD_NONE) return;
    PathState path = path_start(scene, sample);
    const Vertex v = path_surface(scene, &path, hit, tally);
    sums->albedo = vec3_add(sums->albedo, v.surface.base_colour);
    const Vec3 normal = v.surface.shading_normal;
    sums->normal = vec3_add(sums->normal, v.back ? vec3_negate(normal) : normal);
    sums->position = vec3_add(sums->position, v.surface.position);
    const Camera camera = scene->frame->camera;
    const Vec3 from_eye = vec3_sub(v.surface.position, VEC3_OF(camera.origin));
    sums->depth += vec3_dot(from_eye, VEC3_OF(camera.forward));
    ++sums->hits;
}

/* Means over samples [0, sample_count) of what the camera rays of the same samples meet first: albedo (3
 * floats per pixel), shading normal (3, world), position (3, rebased), depth along the view (1). Over the
 * samples that hit. */
kernel void trace_features(SCENE_PARAMETERS PARAMETERS(TRACE_FEATURES_LIST)) {
    const size_t item = get_global_id(0);
    if (item >= pixel_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    uint x, y;
    if (!sample_pixel(local_frame.crop, first_pixel + (uint)item, &x, &y)) return;
    const size_t pixel = (size_t)y * local_frame.crop[2] + x;
    FeatureSums sums = {vec3_splat(0.0f), vec3_splat(0.0f), vec3_splat(0.0f), 0.0f, 0u};
    Tally tally = tally_start();
#if TRIAD_PACKETS
    for (uint first = 0u; first < sample_count; first += PACKET_RAYS) {
        CameraPacket packet;
        packet.count = 0u;
        for (uint i = first; i < min(sample_count, first + PACKET_RAYS); ++i)
            packet_add(&packet, camera_sample(&scene, &local_frame, x, y, i));
        packet_trace(&scene, &packet, &tally);
        for (uint i = 0u; i < packet.count; ++i)
            features_add(&scene, &packet.samples[i], &packet.hits[i], &sums, &tally);
    }
#else
    for (uint i = 0u; i < sample_count; ++i) {
        const CameraSample sample = camera_sample(&scene, &local_frame, x, y, i);
        const Hit hit = rays_closest(&scene, sample.ray, coverage_ray(&sample.name.path, 1u), &tally);
        features_add(&scene, &sample, &hit, &sums, &tally);
    }
#endif
    const float scale = sums.hits ? 1.0f / (float)sums.hits : 0.0f;
    vec3_store(vec3_scale(sums.albedo, 1.0f / (float)sample_count), albedos, pixel);
    vec3_store(vec3_scale(sums.normal, scale), normal_means, pixel);
    vec3_store(vec3_scale(sums.position, scale), position_means, pixel);
    depths[pixel] = sums.depth * scale;
}
