/* Ties the alpha test of shading to the walk of traversal: include before traversal/traverse.h. */
#ifndef TRIAD_SHADING_COVERAGE_H
#define TRIAD_SHADING_COVERAGE_H

#include "common/random.h"
#include "shading/surface.h"

/* Names the edge-th ray of a path for the alpha test. The shadow ray from its end has the number after. */
TRIAD_FUNCTION uint coverage_ray(const Sampler* sampler, uint edge) {
    return random_mix(sampler->key0 ^ sampler->index_reversed) + 2u * edge;
}

#if TRIAD_ALPHA_TEST
typedef struct Coverage {
    const Scene* scene;
    uint ray; /* names the ray: the decision about a triangle is a function of (ray, instance, primitive)
                 alone */
} Coverage;

/* Stochastic coverage: 1 when the ray stops at this point. */
TRIAD_FUNCTION int coverage_accept(const Coverage* c, uint instance, uint primitive, float u, float v) {
    const float coverage = surface_coverage(c->scene, primitive, u, v);
    return coverage >= 1.0f ||
           (coverage > 0.0f &&
            random_float(random_hash(uvec4_make(c->ray, instance, primitive, 0u))) < coverage);
}

#define TRAVERSAL_CONTEXT const Coverage*
#define TRAVERSAL_ACCEPT(context, instance, primitive, u, v) \
    coverage_accept(context, instance, primitive, u, v)
#endif

#endif
