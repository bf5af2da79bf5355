/* Stage `survive`: whether a path goes on. */
#ifndef TRIAD_PATH_SURVIVE_H
#define TRIAD_PATH_SURVIVE_H

#include "path/scatter.h"

/* From this edge on roulette never lets a path survive for certain, so that none is endless (a ray caught in
 * clear glass). */
#define ROULETTE_ALWAYS_FROM 64u
#define ROULETTE_ALWAYS 0.999f

/* Whether this edge is the last one that Frame.max_depth allows. */
TRIAD_FUNCTION int path_is_longest(const Scene* scene, const PathState* path) {
    return path->edge == scene->frame->max_depth;
}

/* The path ends after such an edge: what it would have gone on with is counted. */
TRIAD_FUNCTION void path_cut(const PathState* path, Tally* tally) {
    ++tally->truncated;
    tally->cut_energy +=
        (uint)(math_min(path_share(&path->colours) * colour_luminance(path->throughput), 65535.0f) *
               CUT_ENERGY_ONE);
    record_end(tally, PATH_LONGEST);
}

/* Russian roulette; who survives goes on with the next edge. */
TRIAD_FUNCTION int path_survive(const Scene* scene, PathState* path, const Vertex* vertex,
                                const Scatter* scatter, const SamplerBlock* u, Tally* tally) {
    const float most = path->edge >= ROULETTE_ALWAYS_FROM ? ROULETTE_ALWAYS : 1.0f;
    /* in this order NaN stays NaN, and the path ends */
    const float survive =
        math_min(most, colour_largest(path->throughput) * scene->frame->roulette / path_body_scale(path));
    record_end(tally, PATH_ROULETTE);
    if (!(random_float(u->set[1].y) < survive)) return 0;
    path->throughput = colour_scale(path->throughput, 1.0f / survive);
    record_event(tally, path, scatter->sample.event);
    path->ray = vertex_spawn(&vertex->surface, scatter->side > 0.0f ? vertex->ng : vec3_negate(vertex->ng),
                             &vertex->hit, scatter->direction);
    ++path->edge;
    return 1;
}

#endif
