#include "io/gltf_node.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/freed_memory.h"

namespace triad::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t many_nodes = 1 << 14;

/// Null: there is none.
const json* member(const json& object, const char* name) {
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

/// Null: the node does not have this extension.
const json* extension_of(const json& node, const char* name) {
    const json* extensions = member(node, "extensions");
    const json* extension = extensions && extensions->is_object() ? member(*extensions, name) : nullptr;
    return extension && extension->is_object() ? extension : nullptr;
}

template <class T>
T value_or(const json& object, const char* name, const T& otherwise) {
    const json* value = member(object, name);
    return value ? value->get<T>() : otherwise;
}

std::vector<double> numbers(const json& object, const char* name) {
    return value_or(object, name, std::vector<double>());
}

std::optional<dvec3> vector(const json& node, const char* name) {
    const std::vector<double> v = numbers(node, name);
    return v.empty() ? std::nullopt : std::optional(dvec3(v[0], v[1], v[2]));
}

Node node_of(const json& source) {
    Node node;
    if (const json* name = member(source, "name"); name && name->is_string())
        node.name = name->get<std::string>();
    node.mesh = value_or(source, "mesh", -1);
    node.skin = value_or(source, "skin", -1);
    node.camera = value_or(source, "camera", -1);
    if (const json* light = extension_of(source, "KHR_lights_punctual"))
        node.light = value_or(*light, "light", -1);
    if (const json* shown = extension_of(source, "KHR_node_visibility"))
        node.visible = value_or(*shown, "visible", true);
    node.children = value_or(source, "children", std::vector<int>());
    node.matrix = numbers(source, "matrix");
    node.pose.translation = vector(source, "translation");
    node.pose.scale = vector(source, "scale");
    if (const std::vector<double> r = numbers(source, "rotation"); !r.empty())
        node.pose.rotation = dquat(r[3], r[0], r[1], r[2]);
    node.pose.weights = numbers(source, "weights");
    if (const json* instancing = extension_of(source, "EXT_mesh_gpu_instancing"))
        node.instancing.push_back(value_or(*instancing, "attributes", Node::Instancing()));
    return node;
}

}  // namespace

std::vector<Node> take_nodes(json& document) {
    std::vector<Node> nodes;
    const auto found = document.find("nodes");
    if (found == document.end()) return nodes;
    nodes.reserve(found->size());
    for (json& node : *found) {
        nodes.push_back(node_of(node));
        node = nullptr;
        if (nodes.size() % many_nodes == 0) give_back_freed_memory();
    }
    document.erase(found);
    if (nodes.size() > many_nodes) give_back_freed_memory();
    return nodes;
}

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

}  // namespace triad::gltf
