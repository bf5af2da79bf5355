#include "io/gltf_pose.h"

#include <cmath>
#include <utility>

#include "base/error.h"

namespace triad::gltf {

PosedNodes::PosedNodes(File& file, Pose pose)
    : file_(file), pose_(std::move(pose)), parents_(file.nodes.size(), -1) {
    for (std::size_t i = 0; i < file.nodes.size(); ++i)
        for (const int child : file.nodes[i].children) parents_[std::size_t(child)] = int(i);
}

dmat4 PosedNodes::to_world(std::size_t node) {
    std::vector<std::size_t> way;  // up to what is known; hierarchies are too deep for recursion
    dmat4 result(1.0);
    for (int at = int(node); at >= 0; at = parents_[std::size_t(at)]) {
        if (const auto known = to_world_.find(std::size_t(at)); known != to_world_.end()) {
            result = known->second;
            break;
        }
        way.push_back(std::size_t(at));
    }
    for (; !way.empty(); way.pop_back()) {
        result = result * local_transform(way.back());
        if (!file_.nodes[way.back()].children.empty()) to_world_.emplace(way.back(), result);
    }
    return result;
}

std::vector<double> PosedNodes::weights(std::size_t index) const {
    const Node& node = file_.nodes[index];
    const auto posed = pose_.find(int(index));
    std::vector<double> weights = posed == pose_.end() ? std::vector<double>() : posed->second.weights;
    if (weights.empty()) weights = node.pose.weights;
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

dmat4 PosedNodes::local_transform(std::size_t index) {
    const Node& node = file_.nodes[index];
    const NodePose& own = node.pose;
    const std::string what = label("node", index, node.name);
    if (!node.matrix.empty()) {
        if (own.translation || own.rotation || own.scale)
            throw Error(Exit::scene, what + " has both a matrix and translation, rotation or scale.");
        dmat4 m = glm::make_mat4(node.matrix.data());
        if (m[0].w != 0.0 || m[1].w != 0.0 || m[2].w != 0.0 || m[3].w != 1.0) {
            file_.warn(what + " has a projective matrix; its last row is taken as 0 0 0 1.");
            m[0].w = m[1].w = m[2].w = 0.0, m[3].w = 1.0;
        }
        return m;
    }
    const auto posed = pose_.find(int(index));
    const NodePose& pose = posed == pose_.end() ? own : posed->second;
    const auto said = [](const auto& posed, const auto& own, const auto& otherwise) {
        return posed ? *posed : own.value_or(otherwise);
    };
    dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (posed != pose_.end() && pose.rotation)
        rotation = *pose.rotation;
    else if (own.rotation)
        rotation = unit_quaternion(*own.rotation, what);
    return translate_rotate_scale(said(pose.translation, own.translation, dvec3(0.0)), rotation,
                                  said(pose.scale, own.scale, dvec3(1.0)));
}

}  // namespace triad::gltf
