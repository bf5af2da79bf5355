/* The paths of one pixel, vertex by vertex: the path tracer itself, compiled so that it writes down what it
 * does. Bits are those of trace_paths. */
#define TRIAD_RECORD 1

#include "shading/path.cl"

/* One work-item is one sample: [first_sample, first_sample + sample_count) of the pixel (x, y) of the crop.
 * paths: PATH_VERTICES for every sample. */
kernel void record_paths(SCENE_PARAMETERS, global PathRecord* records, global PathVertex* paths, uint x,
                         uint y, uint first_sample_low, uint first_sample_high, uint sample_count) {
    const size_t item = get_global_id(0);
    if (item >= sample_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    const ulong first = ((ulong)first_sample_high << 32) | first_sample_low;
    const SampleName name = sample_name(&local_frame, film_pixel(&local_frame, x, y), first + item);
    SampleWeight weight;
    const Ray ray = sample_camera_ray(&local_frame, ray_filter, &name, x, y, &weight);
    Tally tally = {0u, 0u, 0u, 0u, 0u, {paths + item * PATH_VERTICES, 0u}};
    const float4 value = sample_weighted(path_trace(&scene, &name.path, ray, &tally), weight);
    PathRecord record;
    record.value[0] = value.x, record.value[1] = value.y, record.value[2] = value.z,
    record.value[3] = value.w;
    record.vertices = tally.recorder.vertices;
    record.rays = tally.rays;
    record.bin = name.bin;
    record.half_index = name.half_index;
    records[item] = record;
}
