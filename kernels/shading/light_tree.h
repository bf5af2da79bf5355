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
} Receiver;

#if TRIAD_LIGHT_TREE

/* Shares that a choice is made in: at least so many, and, the spare left for rounding, at most 2^30. */
#define LIGHT_TREE_SHARES 0x400000u
#define LIGHT_TREE_SPARE 512u
/* Bounds are bounds to within this cosine: what lies beyond sends nothing. */
#define LIGHT_TREE_SLACK 1e-3f

TRIAD_FUNCTION float8 light_lanes_sqrt(float8 x) { return builtin_sqrt8(x); }
TRIAD_FUNCTION float8 light_lanes_max(float8 a, float8 b) { return a > b ? a : b; }
TRIAD_FUNCTION float8 light_lanes_dot(float8 ax, float8 ay, float8 az, float8 bx, float8 by, float8 bz) {
    return fma(ax, bx, fma(ay, by, az * bz));
}
/* Of an angle whose cosine or sine this is: the other one. */
TRIAD_FUNCTION float8 light_lanes_other(float8 x) {
    return light_lanes_sqrt(light_lanes_max(fma(-x, x, (float8)(1.0f)), (float8)(0.0f)));
}
/* Cosine of max(a - b, 0), of angles in [0, pi]. */
TRIAD_FUNCTION float8 light_lanes_less(float8 cos_a, float8 sin_a, float8 cos_b, float8 sin_b) {
    return cos_a >= cos_b ? (float8)(1.0f) : fma(cos_a, cos_b, sin_a * sin_b);
}

/* For every child a bound, up to LIGHT_TREE_SLACK, of what its lights may send to a point, in any unit.
 * normal: Receiver.normal. */
TRIAD_FUNCTION float8 light_node_importance(global const LightNode* node, Vec3 p, Vec3 normal) {
    const float8 x = p.x - vload8(0, node->centre[0]), y = p.y - vload8(0, node->centre[1]),
                 z = p.z - vload8(0, node->centre[2]), radius = vload8(0, node->radius);
    const float8 distance2 = light_lanes_dot(x, y, z, x, y, z), radius2 = radius * radius;
    const float8 inverse = 1.0f / light_lanes_sqrt(light_lanes_max(distance2, radius2));
    const float8 sine = radius * inverse, cosine = light_lanes_other(sine); /* that the sphere subtends */
    const float8 spread_cosine = vload8(0, node->spread_cosine), spread_sine = vload8(0, node->spread_sine);
    const float8 sent = light_lanes_dot(vload8(0, node->axis[0]), vload8(0, node->axis[1]),
                                        vload8(0, node->axis[2]), x, y, z) *
                        inverse;
    const float8 sent_sine = light_lanes_other(sent);
    const float8 off_cosine = light_lanes_less(sent, sent_sine, spread_cosine, spread_sine);
    const float8 off_sine =
        sent >= spread_cosine ? (float8)(0.0f) : fma(sent_sine, spread_cosine, -(sent * spread_sine));
    const float8 at_light = light_lanes_less(off_cosine, off_sine, cosine, sine);
    float8 factor = at_light > vload8(0, node->least_cosine)
                        ? light_lanes_max(at_light, (float8)(LIGHT_TREE_SLACK))
                        : (float8)(0.0f);
    if (normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f) {
        const float8 met =
            -inverse * light_lanes_dot((float8)(normal.x), (float8)(normal.y), (float8)(normal.z), x, y, z);
        const float8 at_point = light_lanes_less(met, light_lanes_other(met), cosine, sine);
        factor = at_point > -LIGHT_TREE_SLACK ? factor * light_lanes_max(at_point, (float8)(LIGHT_TREE_SLACK))
                                              : (float8)(0.0f);
    }
    factor = distance2 > radius2 ? factor : (float8)(1.0f);
    return vload8(0, node->power) * factor * inverse * inverse;
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

/* The light that the number `rest`, uniform below frame->light_range, picks for a receiver, and with what
 * probability it does. TRIAD_NONE: none is seen from there. */
TRIAD_FUNCTION uint light_tree_pick(const Scene* scene, const Receiver* receiver, uint rest,
                                    float* probability) {
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
