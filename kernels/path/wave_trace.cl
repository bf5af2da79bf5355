/* The launches of the driver `wave` that trace rays (path/wave.h). */
#include "common/language.h"

#include "path/rays.h"
#include "path/wave.h"

/* Where the edges of paths end. */
kernel void trace_edges(SCENE_PARAMETERS PARAMETERS(TRACE_EDGES_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    Tally tally = tally_start();
    TRIAD_ITEMS(i, path_count) {
        if (states[i] == WAVE_EDGE) {
            PathState path;
            WAVE_LOAD(path, paths, &path);
            Hit hit = path_closest(&scene, &path, &tally);
            WAVE_STORE(hit, hits, &hit);
            states[i] = hit.primitive == TRIAD_NONE ? WAVE_MISS : WAVE_HIT;
        }
    }
    tally_add(counters, &tally);
}

/* The light of vertices arrives where nothing is in its way. */
kernel void trace_shadows(SCENE_PARAMETERS PARAMETERS(TRACE_SHADOWS_LIST)) {
    const Scene scene = SCENE_FROM_PARAMETERS;
    Tally tally = tally_start();
    TRIAD_ITEMS(i, path_count) {
        if (states[i] & WAVE_LIGHT) {
            states[i] &= ~WAVE_LIGHT;
            PendingLight light;
            WAVE_LOAD(light, pending, &light);
            if (!path_occluded(&scene, &light, &tally)) {
                PathState path;
                WAVE_LOAD(path, paths, &path);
                path_arrive(&scene, &path, &light, &tally);
                WAVE_STORE(found, paths, &path);
            }
        }
    }
    tally_add(counters, &tally);
}
