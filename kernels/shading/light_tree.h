/* Many lights: a tree over them, which is walked from its root by what each child may send to a point
 * (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", without
 * the splitting). Choices are made in whole shares of a range that shrinks on the way down, so that the
 * probability of a light is exact however small it is. */
#ifndef TRIAD_SHADING_LIGHT_TREE_H
#define TRIAD_SHADING_LIGHT_TREE_H

#include "common/random.h"
#include "shading/scene.h"

/* Where light is wanted. */
typedef struct Receiver {
    Vec3 position;
    Vec3 normal; /* unit: only light from its side counts; 0: from anywhere */
    uint facing; /* that light from the environment map is drawn for (shading/facing.h); 0: for any */
} Receiver;

#if TRIAD_LIGHT_TREE

/* Shares that a choice is made in: at least so many, and, the spare left for rounding, at most 2^30. */
#define LIGHT_TREE_SHARES 0x400000u
#define LIGHT_TREE_SPARE 512u
/* Bounds are bounds to within this cosine: what lies beyond sends nothing. */
#define LIGHT_TREE_SLACK 1e-3f

/* Children side by side, or, where the items of a stage are the lanes, one after the other: what they need
 * lies in fewer registers. The shares are the same. */
#if TRIAD_BVH4
typedef float LightLanes;
#define LIGHT_LANES(of_children) ((of_children)[child])
TRIAD_FUNCTION LightLanes light_lanes_sqrt(LightLanes x) { return sqrt(x); }
#else
typedef float8 LightLanes;
#define LIGHT_LANES(of_children) vload8(child, of_children)
TRIAD_FUNCTION LightLanes light_lanes_sqrt(LightLanes x) { return builtin_sqrt8(x); }
#endif

TRIAD_FUNCTION LightLanes light_lanes_max(LightLanes a, LightLanes b) { return a > b ? a : b; }
TRIAD_FUNCTION LightLanes light_lanes_dot(LightLanes ax, LightLanes ay, LightLanes az, LightLanes bx,
                                          LightLanes by, LightLanes bz) {
    return fma(ax, bx, fma(ay, by, az * bz));
}
/* Of an angle whose cosine or sine this is: the other one. */
TRIAD_FUNCTION LightLanes light_lanes_other(LightLanes x) {
    return light_lanes_sqrt(light_lanes_max(fma(-x, x, (LightLanes)(1.0f)), (LightLanes)(0.0f)));
}
/* Cosine of max(a - b, 0), of angles in [0, pi]. */
TRIAD_FUNCTION LightLanes light_lanes_less(LightLanes cos_a, LightLanes sin_a, LightLanes cos_b,
                                           LightLanes sin_b) {
    return cos_a >= cos_b ? (LightLanes)(1.0f) : fma(cos_a, cos_b, sin_a * sin_b);
}

/* For each of the lanes a bound, up to LIGHT_TREE_SLACK, of what its lights may send to a point, in any unit.
 * normal: Receiver.normal. */
TRIAD_FUNCTION LightLanes light_lanes_importance(global const LightNode* node, uint child, Vec3 p,
                                                 Vec3 normal) {
    const LightLanes x = p.x - LIGHT_LANES(node->centre[0]), y = p.y - LIGHT_LANES(node->centre[1]),
                     z = p.z - LIGHT_LANES(node->centre[2]), radius = LIGHT_LANES(node->radius);
    const LightLanes distance2 = light_lanes_dot(x, y, z, x, y, z), radius2 = radius * radius;
    const LightLanes inverse = 1.0f / light_lanes_sqrt(light_lanes_max(distance2, radius2));
    const LightLanes sine = radius * inverse, cosine = light_lanes_other(sine); /* that the sphere subtends */
    const LightLanes spread_cosine = LIGHT_LANES(node->spread_cosine),
                     spread_sine = LIGHT_LANES(node->spread_sine);
    const LightLanes sent = light_lanes_dot(LIGHT_LANES(node->axis[0]), LIGHT_LANES(node->axis[1]),
                                            LIGHT_LANES(node->axis[2]), x, y, z) *
                            inverse;
    const LightLanes sent_sine = light_lanes_other(sent);
    const LightLanes off_cosine = light_lanes_less(sent, sent_sine, spread_cosine, spread_sine);
    const LightLanes off_sine =
        sent >= spread_cosine ? (LightLanes)(0.0f) : fma(sent_sine, spread_cosine, -(sent * spread_sine));
    const LightLanes at_light = light_lanes_less(off_cosine, off_sine, cosine, sine);
    LightLanes factor = at_light > LIGHT_LANES(node->least_cosine)
                            ? light_lanes_max(at_light, (LightLanes)(LIGHT_TREE_SLACK))
                            : (LightLanes)(0.0f);
    if (normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f) {
        const LightLanes met = -inverse * light_lanes_dot((LightLanes)(normal.x), (LightLanes)(normal.y),
                                                          (LightLanes)(normal.z), x, y, z);
        const LightLanes at_point = light_lanes_less(met, light_lanes_other(met), cosine, sine);
        factor = at_point > -LIGHT_TREE_SLACK
                     ? factor * light_lanes_max(at_point, (LightLanes)(LIGHT_TREE_SLACK))
                     : (LightLanes)(0.0f);
    }
    factor = distance2 > radius2 ? factor : (LightLanes)(1.0f);
    return LIGHT_LANES(node->power) * factor * inverse * inverse;
}

TRIAD_FUNCTION float8 light_node_importance(global const LightNode* node, Vec3 p, Vec3 normal) {
#if TRIAD_BVH4
    float children[LIGHT_NODE_CHILDREN];
    _Pragma("nounroll") for (uint child = 0u; child < LIGHT_NODE_CHILDREN; ++child) children[child] =
        light_lanes_importance(node, child, p, normal);
    return vload8(0, children);
#else
    return light_lanes_importance(node, 0u, p, normal);
#endif
}

/* `range` shares as the children have them: child k those from ends[k] to ends[k + 1]. Every child that may
 * send anything has one at least; the last of them has what rounding leaves. 0: none may. */
TRIAD_FUNCTION int light_node_shares(global const LightNode* node, const Receiver* receiver, uint range,
                                     int ends[LIGHT_NODE_CHILDREN + 1]) {
    const float8 importance = light_node_importance(node, receiver->position, receiver->normal);
    const float4 fours = importance.s0123 + importance.s4567;
    const float sum = (fours.x + fours.y) + (fours.z + fours.w);
    if (!(sum > 0.0f && sum < INFINITY)) return 0;
    const float scale = (float)(range - LIGHT_TREE_SPARE) / sum;
    int8 sums = convert_int8(importance * scale) - (importance > 0.0f); /* a comparison is 0 or -1 */
    sums += (int8)(0, sums.s0123, sums.s456);
    sums += (int8)(0, 0, sums.s0123, sums.s45);
    sums += (int8)(0, 0, 0, 0, sums.s0123);
    ends[0] = 0;
    vstore8(sums == sums.s7 ? (int8)((int)range) : sums, 0, ends + 1);
    return 1;
}

/* Whether the shares were too few for another choice: then each is many. */
TRIAD_FUNCTION int light_shares_refine(uint* range) {
    if (*range >= LIGHT_TREE_SHARES) return 0;
    *range <<= 8;
    return 1;
}

/* The light that the number `rest`, uniform below frame->light_range, picks for a receiver, with what
 * probability it does, and where in the light's share the number lies, in [0, 1). TRIAD_NONE: none is seen
 * from there. */
TRIAD_FUNCTION uint light_tree_pick(const Scene* scene, const Receiver* receiver, uint rest,
                                    float* probability, float* within) {
    uint range = scene->frame->light_range, more = rest, content = 0u;
    *probability = (float)range * 0x1p-31f;
    do {
        while (light_shares_refine(&range)) {
            more = random_mix(more);
            rest = rest << 8 | more >> 24;
        }
        int ends[LIGHT_NODE_CHILDREN + 1];
        global const LightNode* node = scene->light_nodes + content;
        if (!light_node_shares(node, receiver, range, ends)) return TRIAD_NONE;
        uint child = 0u;
        for (uint k = 1u; k < LIGHT_NODE_CHILDREN; ++k) child += ends[k] <= (int)rest;
        const uint part = (uint)(ends[child + 1u] - ends[child]);
        if (part == 0u) return TRIAD_NONE; /* which cannot be; a device that errs ends, too */
        *probability *= (float)part / (float)range;
        rest -= (uint)ends[child];
        range = part;
        content = node->content[child];
    } while (!(content & LIGHT_NODE_LEAF));
    /* the share of an unlikely light is few numbers wide */
    *within = math_min(((float)rest + random_float(random_mix(more))) / (float)range, 0x1.fffffep-1f);
    return content & ~LIGHT_NODE_LEAF;
}

/* The probability with which light_tree_pick() picks a light. */
TRIAD_FUNCTION float light_tree_probability(const Scene* scene, const Receiver* receiver, uint light) {
    uint trail = scene->light_trails[light];
    if (trail == TRIAD_NONE) return 0.0f;
    uint range = scene->frame->light_range, content = 0u;
    float probability = (float)range * 0x1p-31f;
    do {
        while (light_shares_refine(&range)) {
        }
        int ends[LIGHT_NODE_CHILDREN + 1];
        global const LightNode* node = scene->light_nodes + content;
        if (!light_node_shares(node, receiver, range, ends)) return 0.0f;
        const uint child = trail & (LIGHT_NODE_CHILDREN - 1u), part = (uint)(ends[child + 1u] - ends[child]);
        if (part == 0u) return 0.0f;
        probability *= (float)part / (float)range;
        range = part;
        content = node->content[child];
        trail >>= 3;
    } while (!(content & LIGHT_NODE_LEAF));
    return probability;
}

#endif

#endif
