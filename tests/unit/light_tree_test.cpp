// The tree over many lights: every light is where its trail leads, and within the bounds on the way.
#include "pack/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "base/math.h"

namespace triad {
namespace {

dvec3 vector_of(const float v[3]) { return {v[0], v[1], v[2]}; }

std::vector<dev::Light> random_lights(std::size_t count) {
    std::mt19937 bits(3);
    const auto even = [&] { return std::uniform_real_distribution<double>(-1, 1)(bits); };
    std::vector<dev::Light> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        dev::Light& l = lights[i];
        l = {};
        l.type = i % 3 == 0 ? LIGHT_TRIANGLE : i % 3 == 1 ? LIGHT_POINT : LIGHT_SPOT;
        to_floats(l.position, 100.0 * dvec3(even(), even(), even()));
        to_floats(l.edge1, dvec3(even(), even(), even()));
        to_floats(l.edge2, dvec3(even(), even(), even()));
        to_floats(l.axis, glm::normalize(dvec3(even(), even(), 3 + even())));
        l.cone_scale = 5, l.cone_offset = -4;
    }
    return lights;
}

/// The child that holds the light at every depth: its node and place.
std::vector<std::pair<const dev::LightNode*, unsigned>> way_to(const LightTree& tree, std::size_t light) {
    std::vector<std::pair<const dev::LightNode*, unsigned>> way;
    std::uint32_t content = 0;
    for (std::uint32_t trail = tree.trails[light];; trail >>= 3) {
        way.emplace_back(&tree.nodes.at(content), trail & 7);
        content = way.back().first->content[way.back().second];
        if (content & LIGHT_NODE_LEAF) break;
    }
    EXPECT_EQ(content & ~LIGHT_NODE_LEAF, light);
    return way;
}

TEST(LightTree, bounds_hold_on_the_way_to_every_light) {
    const std::vector<dev::Light> lights = random_lights(999);
    const LightTree tree = light_tree(lights, std::vector<double>(lights.size(), 2.0));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const dev::Light& l = lights[i];
        for (const auto& [node, k] : way_to(tree, i)) {
            const dvec3 centre(node->centre[0][k], node->centre[1][k], node->centre[2][k]),
                axis(node->axis[0][k], node->axis[1][k], node->axis[2][k]), p = vector_of(l.position);
            std::vector<dvec3> corners{p};
            if (l.type == LIGHT_TRIANGLE)
                corners.push_back(p + vector_of(l.edge1)), corners.push_back(p + vector_of(l.edge2));
            for (const dvec3& c : corners) EXPECT_LE(glm::length(c - centre), node->radius[k]);
            if (l.type == LIGHT_POINT)
                EXPECT_NEAR(node->spread_cosine[k], -1, 1e-6);
            else
                EXPECT_GE(glm::dot(axis, vector_of(l.axis)), node->spread_cosine[k] - 1e-5);
            EXPECT_LE(node->least_cosine[k], l.type == LIGHT_TRIANGLE ? 0.0 : 0.8);
        }
    }
}

TEST(LightTree, power_is_that_of_the_lights_below) {
    const std::vector<dev::Light> lights = random_lights(100);
    std::vector<double> powers(lights.size());
    for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = double(i);
    const LightTree tree = light_tree(lights, powers);
    EXPECT_EQ(tree.trails[0], TRIAD_NONE) << "it has no power";
    const auto sum = [](const dev::LightNode& n) {
        double s = 0;
        for (const float p : n.power) s += p;
        return s;
    };
    for (const dev::LightNode& node : tree.nodes)
        for (unsigned k = 0; k < LIGHT_NODE_CHILDREN; ++k)
            if (node.power[k] > 0 && !(node.content[k] & LIGHT_NODE_LEAF)) {
                EXPECT_NEAR(node.power[k], sum(tree.nodes[node.content[k]]), 1e-5 * node.power[k]);
            }
}

TEST(LightTree, lights_at_one_place_have_trails_that_fit) {
    std::vector<dev::Light> lights(20000, random_lights(2)[1]);
    const LightTree tree = light_tree(lights, std::vector<double>(lights.size(), 1.0));
    std::vector<std::uint32_t> trails = tree.trails;
    for (std::size_t i = 0; i < lights.size(); i += 997) EXPECT_LE(way_to(tree, i).size(), 10u);
    std::sort(trails.begin(), trails.end());
    EXPECT_LT(trails.back(), 1u << 30);
}

TEST(LightTree, powers_that_shrink_do_not_make_it_deep) {
    // Each light outshines all later ones, and stands apart: the heuristic alone would cut them off singly.
    std::vector<dev::Light> lights = random_lights(3000);
    std::vector<double> powers(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        powers[i] = std::pow(0.9, double(i)) + 1e-300;
        to_floats(lights[i].position, dvec3(std::pow(0.97, double(i)), 0, 0));
    }
    const LightTree tree = light_tree(lights, powers);
    for (std::size_t i = 0; i < lights.size(); ++i) EXPECT_LE(way_to(tree, i).size(), 10u);
}

TEST(LightTree, without_lights_that_have_a_place_is_empty) {
    dev::Light sun{};
    sun.type = LIGHT_DIRECTIONAL;
    const LightTree tree = light_tree(std::vector<dev::Light>{sun}, std::vector<double>{1.0});
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_EQ(tree.trails, std::vector<std::uint32_t>{TRIAD_NONE});
}

}  // namespace
}  // namespace triad
