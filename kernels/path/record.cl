/* The paths of one pixel, vertex by vertex: the path tracer itself, compiled so that it writes down what it
 * does. Bits are those of trace_paths. */
#define TRIAD_RECORD 1

#include "common/language.h"

#include "path/add.h"
#include "path/mega.h"

/* One work-item is one sample. */
kernel void record_paths(SCENE_PARAMETERS PARAMETERS(RECORD_PATHS_LIST)) {
    const size_t item = get_global_id(0);
    if (item >= sample_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    const ulong first = ((ulong)first_sample_high << 32) | first_sample_low;
    const CameraSample sample = camera_sample(&scene, &local_frame, x, y, first + item);
    PathState path = path_start(&scene, &sample);
    Tally tally = tally_start();
    tally.path = vertices + item * PATH_VERTICES;
    mega_follow(&scene, &path, 0, &tally);
    PathRecord record;
    const Vec4 value = path_value(&path, sample.weight);
    record.value[0] = value.x, record.value[1] = value.y, record.value[2] = value.z,
    record.value[3] = value.w;
    record.vertices = tally.vertices;
    record.rays = tally.rays;
    record.bin = sample.name.bin;
    record.half_index = sample.name.half_index;
    records[item] = record;
}
