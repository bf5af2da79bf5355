#pragma once
/// What tests of poses share: where corners are, and a triangle that is bound to joints.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "gltf_builder.h"

namespace triad {

inline void expect_vector(const dvec3& a, const dvec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-6) << a.x << " " << a.y << " " << a.z;
}

/// Where the mesh of instance i has corner `corner`.
inline dvec3 corner_of(const Scene& scene, std::size_t i, std::size_t corner) {
    const MeshInstance& instance = scene.instances.at(i);
    return transform_point(instance.to_world,
                           dvec3(scene.meshes[instance.mesh].primitives.at(0).positions.at(corner)));
}

/// A triangle with normals (0, 0, 1).
inline void with_normals(GltfBuilder& b) {
    b.triangle().primitive()["attributes"]["NORMAL"] =
        b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
}

inline const std::vector<float> all_to_first{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/// The triangle bound to joints: nodes 1 and 2, the second below the first.
inline void with_skin(GltfBuilder& b, const std::vector<float>& weights) {
    auto& attributes = b.primitive()["attributes"];
    attributes["JOINTS_0"] =
        b.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = b.accessor(weights, "VEC4");
    b.document["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, nlohmann::json::object()};
    b.document["scenes"][0]["nodes"] = {0, 1};
    b.document["skins"] = {{{"joints", {1, 2}}}};
}

}  // namespace triad
