// The tree builder by itself: every triangle reachable once, every box around what is below it, depth, order,
// threads.
#include "bvh/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "base/parallel_for.h"
#include "bvh/collapse.h"
#include "check/any_bits.h"
#include "scene/shapes.h"

using namespace triad;

namespace {

std::vector<BvhTriangle> triangles_of(const Primitive& shape) {
    std::vector<BvhTriangle> triangles;
    for (const uvec3& t : shape.triangles)
        triangles.push_back({{shape.positions[t.x], shape.positions[t.y], shape.positions[t.z]},
                             std::uint32_t(triangles.size())});
    return triangles;
}

struct Contents {
    std::multiset<std::uint32_t> primitives, instances;
    unsigned depth = 0;
};

/// Walks a tree and checks that every triangle lies in the boxes of all its ancestors.
void walk(const BvhPool& pool, std::uint32_t node, unsigned depth, Contents& contents, Bounds inside) {
    contents.depth = std::max(contents.depth, depth);
    const dev::BvhNode& n = pool.nodes.at(node);
    for (int i = 0; i < BVH_WIDTH; ++i) {
        Bounds box;
        for (int a = 0; a < 3; ++a) {
            box.lo[a] = std::max(inside.lo[a], double(n.bounds[2 * a][i]));
            box.hi[a] = std::min(inside.hi[a], double(n.bounds[2 * a + 1][i]));
        }
        if (n.child[i] == BVH_EMPTY) {
            for (int a = 0; a < 3; ++a) ASSERT_GT(n.bounds[2 * a][i], n.bounds[2 * a + 1][i]);
        } else if (n.child[i] & BVH_LEAF) {
            const dev::TriangleBlock& block = pool.blocks.at(n.child[i] & BVH_INDEX);
            std::set<std::uint32_t> lanes;
            for (int lane = 0; lane < 4; ++lane) {
                for (int corner = 0; corner < 3; ++corner)
                    for (int a = 0; a < 3; ++a) {
                        ASSERT_GE(block.vertex[corner * 3 + a][lane], box.lo[a]);
                        ASSERT_LE(block.vertex[corner * 3 + a][lane], box.hi[a]);
                    }
                lanes.insert(block.primitive[lane]);
            }
            contents.primitives.insert(lanes.begin(), lanes.end());
        } else if (n.child[i] & BVH_INSTANCE) {
            contents.instances.insert(n.child[i] & BVH_INDEX);
        } else {
            walk(pool, n.child[i], depth + 1, contents, box);
        }
    }
}

Contents contents_of(const BvhPool& pool, std::uint32_t root) {
    Contents contents;
    Bounds everything;
    everything.lo = dvec3(-std::numeric_limits<double>::infinity());
    everything.hi = dvec3(std::numeric_limits<double>::infinity());
    walk(pool, root, 1, contents, everything);
    EXPECT_LE(contents.depth, unsigned(BVH_DEPTH));
    return contents;
}

Contents contents_of(const std::vector<BvhTriangle>& triangles,
                     const std::vector<BvhInstance>& instances = {}) {
    BvhPool pool;
    const std::uint32_t root = build_bvh(triangles, instances, 1.0f, pool);
    return contents_of(pool, root);
}

void expect_each_once(const Contents& contents, std::size_t count) {
    ASSERT_EQ(contents.primitives.size(), count);
    EXPECT_EQ(std::set(contents.primitives.begin(), contents.primitives.end()).size(), count);
}

TEST(Bvh, two_levels_of_the_deepest_trees_fit_the_stack) {
    static_assert(2 * (BVH_DEPTH * (BVH_WIDTH - 1) + 1) <= BVH_STACK);
}

TEST(Bvh, holds_every_triangle_once_within_its_boxes) {
    for (const unsigned cells : {1u, 2u, 3u, 17u, 90u}) {
        const auto triangles = triangles_of(shapes::terrain(10.0f, 1.0f, cells, 3));
        expect_each_once(contents_of(triangles), triangles.size());
    }
}

TEST(Bvh, of_nothing_is_a_root_without_children) {
    BvhPool pool;
    const std::uint32_t root = build_bvh({}, {}, 0.0f, pool);
    for (const std::uint32_t child : pool.nodes.at(root).child) EXPECT_EQ(child, BVH_EMPTY);
    EXPECT_TRUE(pool.blocks.empty());
}

TEST(Bvh, is_the_same_whatever_the_number_of_threads) {
    const auto triangles = triangles_of(shapes::displaced_sphere(vec3(0.0f), 1.0f, 300, 200, 0.4f, 3.0f, 5));
    BvhPool one, many;
    set_host_threads(1);
    build_bvh(triangles, {}, 2.0f, one);
    set_host_threads(7);
    build_bvh(triangles, {}, 2.0f, many);
    set_host_threads(0);
    ASSERT_EQ(one.nodes.size(), many.nodes.size());
    ASSERT_EQ(one.blocks.size(), many.blocks.size());
    EXPECT_EQ(std::memcmp(one.nodes.data(), many.nodes.data(), one.nodes.size() * sizeof(dev::BvhNode)), 0);
    EXPECT_EQ(
        std::memcmp(one.blocks.data(), many.blocks.data(), one.blocks.size() * sizeof(dev::TriangleBlock)),
        0);
}

TEST(Bvh, stays_shallow_where_the_heuristic_would_peel_triangles_off_one_by_one) {
    // Sizes and places in geometric progression: every best split cuts off a handful.
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < 4000; ++i) {
        const float x = std::pow(1.03f, float(i % 2000) - 1000), y = i < 2000 ? x : -x;
        triangles.push_back({{{x, y, 0}, {x * 1.01f, y, x}, {x, y * 1.01f, -x}}, std::uint32_t(i)});
    }
    expect_each_once(contents_of(triangles), triangles.size());
}

TEST(Bvh, stays_shallow_where_all_centres_are_one) {
    std::vector<BvhTriangle> triangles;
    for (int i = 1; i <= 5000; ++i) {
        const float r = float(i);
        triangles.push_back({{{-r, -r, -r}, {r, r, r}, {-r, r, 0.25f * r}}, std::uint32_t(i - 1)});
    }
    expect_each_once(contents_of(triangles), triangles.size());
}

TEST(Bvh, keeps_the_lowest_primitive_of_exact_duplicates_however_many_wound_or_rotated) {
    const auto once = triangles_of(shapes::lat_long_sphere(vec3(1.0f, 0.0f, -2.0f), 1.0f, 20, 10));
    std::vector<BvhTriangle> triangles;
    std::mt19937 random(1);
    for (std::uint32_t copy = 0; copy < 40; ++copy)
        for (const BvhTriangle& t : once) {
            const unsigned turn = random() % 3;
            BvhTriangle other{{t.corner[turn], t.corner[(turn + 1) % 3], t.corner[(turn + 2) % 3]},
                              t.primitive + copy * std::uint32_t(once.size())};
            if (random() % 2) std::swap(other.corner[0], other.corner[1]);
            triangles.push_back(other);
        }
    std::shuffle(triangles.begin(), triangles.end(), random);
    const Contents contents = contents_of(triangles);
    expect_each_once(contents, once.size());
    EXPECT_EQ(*contents.primitives.rbegin(), once.size() - 1);
}

/// A comb: a spine of `height` levels with a leaf at each, and at its end a full tree that keeps to the
/// height too.
std::uint32_t add_comb(std::vector<bvh::BinaryNode>& nodes, unsigned height, unsigned spine) {
    const auto node = std::uint32_t(nodes.size());
    nodes.push_back({{{0, 0, 0}, {1, 1, float(height)}}, 0, height == 0 ? 1u : 0u});
    if (height == 0) return node;
    add_comb(nodes, height - 1, spine > 0 ? spine - 1 : 0);
    const std::uint32_t right = add_comb(nodes, spine > 0 ? 0 : height - 1, 0);
    nodes[node].right_or_first = right;
    return node;
}

TEST(Bvh, the_lowest_collapse_takes_three_levels_at_a_time) {
    for (const unsigned height : {1u, 3u, 4u, 14u, 27u})
        for (const unsigned spine : {0u, 5u, 16u, 27u}) {
            if (height > spine + 12) continue;  // a full tree of more levels is too large
            std::vector<bvh::BinaryNode> nodes;
            add_comb(nodes, height, spine);
            EXPECT_LE(bvh::wide_depth(nodes, bvh::LowestCollapse(nodes), 0), (height + 2) / 3)
                << height << " " << spine;
        }
}

/// Half areas of all wide nodes below and with `node`.
double wide_cost(const std::vector<bvh::BinaryNode>& nodes, const bvh::Collapse& collapse,
                 std::uint32_t node) {
    if (nodes[node].count) return 0;
    bvh::Collapse::Children children;
    const int count = collapse.children(node, children);
    double cost = nodes[node].box.half_area();
    for (int i = 0; i < count; ++i) cost += wide_cost(nodes, collapse, children[std::size_t(i)]);
    return cost;
}

TEST(Bvh, the_cheapest_collapse_is_cheaper_than_another) {
    const auto triangles = triangles_of(shapes::displaced_sphere(vec3(0.0f), 1.0f, 40, 30, 0.4f, 3.0f, 5));
    std::vector<bvh::Reference> references;
    for (const BvhTriangle& t : triangles) {
        bvh::Box box;
        for (const vec3& c : t.corner) box.add({{c.x, c.y, c.z}, {c.x, c.y, c.z}});
        references.push_back({box, t.primitive});
    }
    const auto nodes = bvh::build_binary_tree(triangles, references, 48).nodes;
    EXPECT_LT(wide_cost(nodes, bvh::CheapestCollapse(nodes), 0),
              wide_cost(nodes, bvh::LowestCollapse(nodes), 0));
}

TEST(Bvh, drops_triangles_without_area) {
    const std::vector<BvhTriangle> triangles{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0},
                                             {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, 1},
                                             {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, 2}};
    expect_each_once(contents_of(triangles), 1);
}

TEST(Bvh, areas_that_overflow_give_no_node_more_than_eight_children) {
    // The collapse once wrote past its eight children where no area was less than another.
    for (const float far : {1e18f, 5e19f, 1e36f}) {
        std::vector<BvhTriangle> triangles;
        for (int i = 0; i < 300; ++i) {
            const float x = far * float(i % 7 - 3), y = far * float(i % 11 - 5), z = float(i);
            triangles.push_back({{{x, y, z}, {x, 9 * far, z}, {-9 * far, y, z}}, std::uint32_t(i)});
        }
        expect_each_once(contents_of(triangles), triangles.size());
    }
}

TEST(Bvh, leaves_out_what_float_cannot_hold_and_keeps_the_rest) {
    any_bits::Words words(3);
    std::vector<BvhTriangle> triangles;
    std::vector<BvhInstance> instances;
    std::set<std::uint32_t> ordinary;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        BvhTriangle t{{{float(i % 100), float(i % 37), 0}, {float(i % 100), 1, 2}, {3, 0.1f, float(i)}}, i};
        if (i % 3 == 0)
            ordinary.insert(i);
        else
            t.corner[words.bits() % 3][int(words.bits() % 3)] = words.number();
        triangles.push_back(t);
        const double x = words.number(), y = words.number();
        instances.push_back({{dvec3(x < y ? x : y, 0, 0), dvec3(x < y ? y : x, 1, 1)}, i + 1});
    }
    instances.push_back({{dvec3(0, 0, 0), dvec3(1, 1, 1)}, 1u << 20});
    BvhPool pool;
    const Contents contents = contents_of(pool, build_bvh(triangles, instances, INFINITY, pool));
    for (const std::uint32_t i : ordinary) EXPECT_EQ(contents.primitives.count(i), 1u) << i;
    EXPECT_LT(contents.primitives.size(), triangles.size());
    EXPECT_GT(contents.primitives.size(), ordinary.size());
    EXPECT_EQ(contents.instances.count(1u << 20), 1u);
    EXPECT_LT(contents.instances.size(), instances.size());
}

TEST(Bvh, mixes_triangles_and_instances_and_keeps_them_apart_in_leaves) {
    const auto triangles = triangles_of(shapes::terrain(10.0f, 1.0f, 12, 3));
    std::vector<BvhInstance> instances;
    for (std::uint32_t i = 0; i < 300; ++i) {
        Bounds box;
        box.add(dvec3(i % 20, 0, i / 20));
        box.add(dvec3(i % 20 + 1, 1, i / 20 + 1));
        instances.push_back({box, i + 1});
    }
    const Contents contents = contents_of(triangles, instances);
    expect_each_once(contents, triangles.size());
    EXPECT_EQ(contents.instances.size(), 300u);
    EXPECT_EQ(std::set(contents.instances.begin(), contents.instances.end()).size(), 300u);
}

TEST(Bvh, asks_for_coverage_only_where_a_triangle_is_not_opaque) {
    auto triangles = triangles_of(shapes::quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 20, 20));
    for (BvhTriangle& t : triangles) t.opaque = t.primitive != 17;
    BvhPool pool;
    build_bvh(triangles, {}, 1.0f, pool);
    std::size_t asking = 0;
    for (const dev::BvhNode& node : pool.nodes)
        for (const std::uint32_t child : node.child)
            if (child != BVH_EMPTY && (child & BVH_LEAF) && (child & BVH_ALPHA)) {
                ++asking;
                const auto& ids = pool.blocks[child & BVH_INDEX].primitive;
                EXPECT_TRUE(std::find(std::begin(ids), std::end(ids), 17u) != std::end(ids));
            }
    EXPECT_EQ(asking, 1u);
}

TEST(Bvh, appends_to_the_pool_and_leaves_what_is_there) {
    const auto first = triangles_of(shapes::box(vec3(0.0f), vec3(1.0f)));
    const auto second = triangles_of(shapes::terrain(10.0f, 1.0f, 9, 3));
    BvhPool pool;
    const std::uint32_t a = build_bvh(first, {}, 1.0f, pool), b = build_bvh(second, {}, 1.0f, pool);
    expect_each_once(contents_of(pool, a), first.size());
    expect_each_once(contents_of(pool, b), second.size());
}

}  // namespace
