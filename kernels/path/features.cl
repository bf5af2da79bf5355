/* What the camera's rays meet first, for the picture's feature channels. */
#include "common/language.h"

#include "path/rays.h"
#include "path/start.h"
#include "path/surface.h"

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
    const Camera camera = local_frame.camera;
    const Vec3 eye = VEC3_OF(camera.origin);
    const Vec3 forward = VEC3_OF(camera.forward);
    Vec3 albedo_sum = vec3_splat(0.0f), normal_sum = vec3_splat(0.0f), position_sum = vec3_splat(0.0f);
    float depth_sum = 0.0f;
    uint hits = 0u;
    Tally tally = tally_start();
    for (uint i = 0u; i < sample_count; ++i) {
        const CameraSample sample = camera_sample(&scene, &local_frame, x, y, i);
        PathState path = path_start(&scene, &sample);
        const Hit hit = path_closest(&scene, &path, &tally);
        if (hit.primitive == TRIAD_NONE) continue;
        const Vertex v = path_surface(&scene, &path, &hit, &tally);
        albedo_sum = vec3_add(albedo_sum, v.surface.base_colour);
        const Vec3 normal = v.surface.shading_normal;
        normal_sum = vec3_add(normal_sum, v.back ? vec3_negate(normal) : normal);
        position_sum = vec3_add(position_sum, v.surface.position);
        depth_sum += vec3_dot(vec3_sub(v.surface.position, eye), forward);
        ++hits;
    }
    const float scale = hits ? 1.0f / (float)hits : 0.0f;
    vec3_store(vec3_scale(albedo_sum, 1.0f / (float)sample_count), albedos, pixel);
    vec3_store(vec3_scale(normal_sum, scale), normal_means, pixel);
    vec3_store(vec3_scale(position_sum, scale), position_means, pixel);
    depths[pixel] = depth_sum * scale;
}
