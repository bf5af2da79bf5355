/* What the rays of pixels take: the path tracer itself, compiled so that it counts the nodes, leaves and
 * triangles that it visits. */
#define TRIAD_COUNT_WORK 1

#include "common/language.h"

#include "path/add.h"
#include "path/mega.h"

/* One work-item is one pixel. */
kernel void count_work(SCENE_PARAMETERS PARAMETERS(COUNT_WORK_LIST)) {
    const size_t item = get_global_id(0);
    if (item >= pixel_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    const Frame local_frame = *frame;
    const uint pixel = first_pixel + (uint)item;
    Tally tally = tally_start();
    tally.edges = edges;
    for (uint i = 0u; i < sample_count; ++i) {
        const CameraSample sample =
            camera_sample(&scene, &local_frame, pixel % local_frame.crop[2], pixel / local_frame.crop[2], i);
        PathState path = path_start(&scene, &sample);
        mega_follow(&scene, &path, 0, &tally);
    }
    work[pixel] = tally.work;
}
