#include "io/gltf_node.h"

#include <cmath>
#include <utility>

#include "base/error.h"

namespace triad::gltf {

dmat4 translate_rotate_scale(const dvec3& t, const dquat& r, const dvec3& s) {
    const dmat3 m = glm::mat3_cast(r);
    return dmat4(dvec4(m[0] * s.x, 0.0), dvec4(m[1] * s.y, 0.0), dvec4(m[2] * s.z, 0.0), dvec4(t, 1.0));
}

bool is_invertible(const dmat4& m) {
    const double volume = glm::length(dvec3(m[0])) * glm::length(dvec3(m[1])) * glm::length(dvec3(m[2]));
    const double det = glm::determinant(dmat3(m));
    return std::isfinite(volume) && volume > 0.0 && std::abs(det) > 1e-12 * volume;
}

dquat unit_quaternion(const dquat& q, const std::string& what) {
    const double length = glm::length(q);
    if (!(length > 1e-9) || !std::isfinite(length))
        throw Error(Exit::scene, what + " has a rotation that is no unit quaternion.");
    return q / length;
}

Nodes::Nodes(File& file, Pose pose)
    : file_(file),
      pose_(std::move(pose)),
      parents_(file.model.nodes.size(), -1),
      to_world_(file.model.nodes.size()) {
    for (std::size_t i = 0; i < file.model.nodes.size(); ++i)
        for (const int child : file.model.nodes[i].children) parents_[std::size_t(child)] = int(i);
}

const dmat4& Nodes::to_world(std::size_t node) {
    std::vector<std::size_t> way;  // up to what is known; hierarchies are too deep for recursion
    for (int at = int(node); at >= 0 && !to_world_[std::size_t(at)]; at = parents_[std::size_t(at)])
        way.push_back(std::size_t(at));
    for (; !way.empty(); way.pop_back()) {
        const int parent = parents_[way.back()];
        const dmat4 above = parent < 0 ? dmat4(1.0) : *to_world_[std::size_t(parent)];
        to_world_[way.back()] = above * local_transform(way.back());
    }
    return *to_world_[node];
}

std::vector<double> Nodes::weights(std::size_t index) const {
    const tinygltf::Node& node = file_.model.nodes[index];
    const auto posed = pose_.find(int(index));
    std::vector<double> weights = posed == pose_.end() ? std::vector<double>() : posed->second.weights;
    if (weights.empty()) weights = node.weights;
    if (weights.empty() && node.mesh >= 0) weights = file_.model.meshes[std::size_t(node.mesh)].weights;
    bool has_some = false, has_damaged = false;
    for (double& w : weights) {
        if (!std::isfinite(w)) w = 0, has_damaged = true;  // weights name poses, and NaN has no order
        has_some = has_some || w != 0;
    }
    if (has_damaged)
        file_.fault(label("node", index, node.name) +
                    " has weights of morph targets that are no finite numbers; they become 0.");
    return has_some ? weights : std::vector<double>();
}

dmat4 Nodes::local_transform(std::size_t index) {
    const tinygltf::Node& node = file_.model.nodes[index];
    const std::string what = label("node", index, node.name);
    if (!node.matrix.empty()) {
        if (!node.translation.empty() || !node.rotation.empty() || !node.scale.empty())
            throw Error(Exit::scene, what + " has both a matrix and translation, rotation or scale.");
        dmat4 m = glm::make_mat4(node.matrix.data());
        if (m[0].w != 0.0 || m[1].w != 0.0 || m[2].w != 0.0 || m[3].w != 1.0) {
            file_.warn(what + " has a projective matrix; its last row is taken as 0 0 0 1.");
            m[0].w = m[1].w = m[2].w = 0.0, m[3].w = 1.0;
        }
        return m;
    }
    const auto posed = pose_.find(int(index));
    const NodePose pose = posed == pose_.end() ? NodePose{} : posed->second;
    const auto vector = [](const std::optional<dvec3>& moved, const std::vector<double>& v,
                           double otherwise) {
        return moved ? *moved : v.empty() ? dvec3(otherwise) : dvec3(v[0], v[1], v[2]);
    };
    dquat rotation = pose.rotation.value_or(dquat(1.0, 0.0, 0.0, 0.0));
    if (const auto& r = node.rotation; !r.empty() && !pose.rotation)
        rotation = unit_quaternion(dquat(r[3], r[0], r[1], r[2]), what);
    return translate_rotate_scale(vector(pose.translation, node.translation, 0.0), rotation,
                                  vector(pose.scale, node.scale, 1.0));
}

const tinygltf::Value* extension_of(const tinygltf::Node& node, const char* name) {
    const auto found = node.extensions.find(name);
    return found != node.extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

}  // namespace triad::gltf
