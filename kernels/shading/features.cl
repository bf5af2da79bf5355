/* What the camera's rays meet first, for the picture's feature channels. */
#include "common/language.h"

#include "common/random.h"
#include "shading/coverage.h"
#include "shading/sample.h"
#include "shading/surface.h"
#include "traversal/traverse.h"

/* Means over samples [0, sample_count) of what the camera rays of the same samples meet first: albedo (3
 * floats per pixel), shading normal (3, world), position (3, rebased), depth along the view (1). Over the
 * samples that hit. */
kernel void trace_features(SCENE_PARAMETERS, global float* albedos, global float* normal_means,
                           global float* position_means, global float* depths, uint first_pixel,
                           uint pixel_count, uint sample_count) {
    const size_t item = get_global_id(0);
    if (item >= pixel_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    uint x, y;
    if (!sample_pixel(local_frame.crop, first_pixel + (uint)item, &x, &y)) return;
    const uint full_pixel =
        (local_frame.crop[1] + y) * (uint)local_frame.camera.pixels[0] + local_frame.crop[0] + x;
    const size_t pixel = (size_t)y * local_frame.crop[2] + x;
    const Camera camera = local_frame.camera;
    const float3 eye = (float3)(camera.origin[0], camera.origin[1], camera.origin[2]);
    const float3 forward = (float3)(camera.forward[0], camera.forward[1], camera.forward[2]);
    Traversal traversal = traversal_make(nodes, blocks, instances, frame->root);
#if TRIAD_ALPHA_TEST
    Coverage coverage;
    coverage.scene = &scene;
    traversal.context = &coverage;
#endif
    float3 albedo_sum = (float3)(0.0f), normal_sum = (float3)(0.0f), position_sum = (float3)(0.0f);
    float depth_sum = 0.0f;
    uint hits = 0u;
    for (uint i = 0u; i < sample_count; ++i) {
        const SampleName name = sample_name(&local_frame, full_pixel, i);
        SampleWeight weight;
        const Ray ray = sample_camera_ray(&local_frame, ray_filter, &name, x, y, &weight);
#if TRIAD_ALPHA_TEST
        coverage.ray = random_mix(name.path.key0 ^ name.path.index_reversed) + 2u;
#endif
        const Hit hit = traverse_closest(&traversal, ray);
        if (hit.primitive == TRIAD_NONE) continue;
        const Surface s = surface_make(&scene, &hit);
        const float3 wi = (float3)(ray.direction[0], ray.direction[1], ray.direction[2]);
        albedo_sum += s.base_colour;
        normal_sum += math_dot(wi, s.geometric_normal) > 0.0f ? -s.shading_normal : s.shading_normal;
        position_sum += s.position;
        depth_sum += math_dot(s.position - eye, forward);
        ++hits;
    }
    const float scale = hits ? 1.0f / (float)hits : 0.0f;
    vstore3(albedo_sum * (1.0f / (float)sample_count), pixel, albedos);
    vstore3(normal_sum * scale, pixel, normal_means);
    vstore3(position_sum * scale, pixel, position_means);
    depths[pixel] = depth_sum * scale;
}
