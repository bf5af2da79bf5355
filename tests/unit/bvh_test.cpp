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
#include "bvh/nodes.h"
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
    unsigned waiting = 0;  ///< children on the stack of a walk, at most
};

/// Child i of a node, in the layout's own words: its box, which is empty for an empty slot.
bvh::Box box_of(const dev::Bvh8Node& n, int i) {
    bvh::Box box;
    for (int a = 0; a < 3; ++a) box.lo[a] = n.bounds[2 * a][i], box.hi[a] = n.bounds[2 * a + 1][i];
    return box;
}
bvh::Box box_of(const dev::Bvh4Node& n, int i) {
    bvh::Box box;
    for (int a = 0; a < 3 && n.child[i] != BVH_EMPTY; ++a) {
        const double cell = std::ldexp(1.0, int(n.cells >> (8 * a) & 0xff) - 127);
        // Rounded inwards: a triangle inside is inside of the exact box, too.
        const auto plane = [&](std::uint32_t bytes) {
            return n.origin[a] + cell * (bytes >> (8 * i) & 0xff);
        };
        box.lo[a] = std::nextafter(float(plane(n.bounds[2 * a])), INFINITY);
        box.hi[a] = std::nextafter(float(plane(n.bounds[2 * a + 1])), -INFINITY);
    }
    return box;
}

/// Walks a tree and checks that every triangle lies in the boxes of all its ancestors.
template <class Node>
void walk(const BvhPool& pool, const AlignedVector<Node>& nodes, std::uint32_t node, unsigned waiting,
          Contents& contents, Bounds inside) {
    const Node& n = nodes.at(node);
    const auto count = unsigned(
        std::count_if(std::begin(n.child), std::end(n.child), [](auto c) { return c != BVH_EMPTY; }));
    if (count > 1) waiting += count - 1;
    contents.waiting = std::max(contents.waiting, waiting);
    for (int i = 0; i < int(std::size(n.child)); ++i) {
        const bvh::Box own = box_of(n, i);
        Bounds box;
        for (int a = 0; a < 3; ++a) {
            box.lo[a] = std::max(inside.lo[a], double(own.lo[a]));
            box.hi[a] = std::min(inside.hi[a], double(own.hi[a]));
        }
        if (n.child[i] == BVH_EMPTY) {
            for (int a = 0; a < 3; ++a) ASSERT_GT(own.lo[a], own.hi[a]);
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
            walk(pool, nodes, n.child[i], waiting, contents, box);
        }
    }
}

template <class Node>
Contents contents_of(const BvhPool& pool, const AlignedVector<Node>& nodes, std::uint32_t root) {
    Contents contents;
    Bounds everything;
    everything.lo = dvec3(-std::numeric_limits<double>::infinity());
    everything.hi = dvec3(std::numeric_limits<double>::infinity());
    walk(pool, nodes, root, 0, contents, everything);
    EXPECT_LE(contents.waiting, bvh::Layout<Node>::room);
    return contents;
}

/// Of the tree in either format, which hold the same.
Contents contents_of(const BvhPool& pool, const BvhRoots& roots) {
    const Contents contents = contents_of(pool, pool.nodes8, roots[0]),
                   other = contents_of(pool, pool.nodes4, roots[1]);
    EXPECT_EQ(contents.primitives, other.primitives);
    EXPECT_EQ(contents.instances, other.instances);
    return contents;
}

Contents contents_of(const std::vector<BvhTriangle>& triangles,
                     const std::vector<BvhInstance>& instances = {}) {
    BvhPool pool;
    const BvhRoots roots = build_bvh(triangles, instances, 1.0f, pool);
    return contents_of(pool, roots);
}

void expect_each_once(const Contents& contents, std::size_t count) {
    ASSERT_EQ(contents.primitives.size(), count);
    EXPECT_EQ(std::set(contents.primitives.begin(), contents.primitives.end()).size(), count);
}

TEST(Bvh, holds_every_triangle_once_within_its_boxes) {
    for (const unsigned cells : {1u, 2u, 3u, 17u, 90u}) {
        const auto triangles = triangles_of(shapes::terrain(10.0f, 1.0f, cells, 3));
        expect_each_once(contents_of(triangles), triangles.size());
    }
}

TEST(Bvh, of_nothing_is_a_root_without_children) {
    BvhPool pool;
    const BvhRoots roots = build_bvh({}, {}, 0.0f, pool);
    for (const std::uint32_t child : pool.nodes8.at(roots[0]).child) EXPECT_EQ(child, BVH_EMPTY);
    for (const std::uint32_t child : pool.nodes4.at(roots[1]).child) EXPECT_EQ(child, BVH_EMPTY);
    EXPECT_TRUE(pool.blocks.empty());
}

template <class T>
bool same_bytes(const AlignedVector<T>& a, const AlignedVector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Bvh, is_the_same_whatever_the_number_of_threads) {
    const auto triangles = triangles_of(shapes::displaced_sphere(vec3(0.0f), 1.0f, 300, 200, 0.4f, 3.0f, 5));
    BvhPool one, many;
    set_host_threads(1);
    build_bvh(triangles, {}, 2.0f, one);
    set_host_threads(7);
    build_bvh(triangles, {}, 2.0f, many);
    set_host_threads(0);
    EXPECT_TRUE(same_bytes(one.nodes8, many.nodes8));
    EXPECT_TRUE(same_bytes(one.nodes4, many.nodes4));
    EXPECT_TRUE(same_bytes(one.blocks, many.blocks));
}

TEST(Bvh, in_one_format_is_the_same_as_in_both) {
    const auto triangles = triangles_of(shapes::displaced_sphere(vec3(0.0f), 1.0f, 60, 40, 0.4f, 3.0f, 5));
    BvhPool both, eight, four;
    eight.formats = {BvhFormat::bvh8};
    four.formats = {BvhFormat::bvh4};
    for (BvhPool* pool : {&both, &eight, &four}) build_bvh(triangles, {}, 2.0f, *pool);
    EXPECT_TRUE(same_bytes(eight.nodes8, both.nodes8));
    EXPECT_TRUE(same_bytes(four.nodes4, both.nodes4));
    EXPECT_TRUE(same_bytes(eight.blocks, both.blocks));
    EXPECT_TRUE(same_bytes(four.blocks, both.blocks));
    EXPECT_TRUE(eight.nodes4.empty());
    EXPECT_TRUE(four.nodes8.empty());
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

/// Children that wait at most below a node that has room for `room`.
unsigned waiting_below(const std::vector<bvh::BinaryNode>& nodes, const bvh::Collapse& collapse,
                       std::uint32_t node, unsigned room) {
    if (nodes[node].count) return 0;
    bvh::Collapse::Children children;
    const auto count = unsigned(collapse.children(node, room, children));
    unsigned most = 0;
    for (unsigned i = 0; i < count; ++i)
        most = std::max(most, waiting_below(nodes, collapse, children[i], room + 1 - count));
    return most + count - 1;
}

TEST(Bvh, a_collapse_keeps_to_the_room_that_the_stack_has) {
    unsigned limited = 0;
    for (const int width : {4, 8})
        for (const unsigned height : {1u, 3u, 4u, 14u, 27u, 40u})
            for (const unsigned spine : {0u, 5u, 16u, 40u}) {
                if (height > spine + 12) continue;  // a full tree of more levels is too large
                std::vector<bvh::BinaryNode> nodes;
                add_comb(nodes, height, spine);
                const bvh::Collapse collapse(nodes, width);
                for (const unsigned room : {height, height + 3, 2 * height}) {
                    EXPECT_LE(waiting_below(nodes, collapse, 0, room), room) << height << " " << spine;
                    limited += collapse.waiting(0) > room;
                }
            }
    EXPECT_GT(limited, 10u) << "nothing was limited";
}

/// Half areas of all wide nodes below and with `node`.
double wide_cost(const std::vector<bvh::BinaryNode>& nodes, const bvh::Collapse& collapse, std::uint32_t node,
                 unsigned room) {
    if (nodes[node].count) return 0;
    bvh::Collapse::Children children;
    const int count = collapse.children(node, room, children);
    double cost = nodes[node].box.half_area();
    for (int i = 0; i < count; ++i) cost += wide_cost(nodes, collapse, children[std::size_t(i)], room);
    return cost;
}

TEST(Bvh, a_collapse_is_cheaper_than_the_binary_tree) {
    const auto triangles = triangles_of(shapes::displaced_sphere(vec3(0.0f), 1.0f, 40, 30, 0.4f, 3.0f, 5));
    std::vector<bvh::Reference> references;
    for (const BvhTriangle& t : triangles) {
        bvh::Box box;
        for (const vec3& c : t.corner) box.add({{c.x, c.y, c.z}, {c.x, c.y, c.z}});
        references.push_back({box, t.primitive});
    }
    const auto nodes = bvh::build_binary_tree(triangles, references, 48).nodes;
    for (const int width : {4, 8}) {
        const bvh::Collapse collapse(nodes, width);
        EXPECT_LT(wide_cost(nodes, collapse, 0, 1000), 0.7 * wide_cost(nodes, collapse, 0, 0)) << width;
    }
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
    const BvhRoots roots = build_bvh(triangles, instances, INFINITY, pool);
    const Contents contents = contents_of(pool, roots);
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
    for (const dev::Bvh8Node& node : pool.nodes8)
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
    const BvhRoots a = build_bvh(first, {}, 1.0f, pool), b = build_bvh(second, {}, 1.0f, pool);
    expect_each_once(contents_of(pool, a), first.size());
    expect_each_once(contents_of(pool, b), second.size());
}

}  // namespace
