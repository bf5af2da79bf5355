#include "io/gltf_deform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "io/gltf_accessor.h"

namespace triad::gltf {
namespace {

/// The primitive's vertices in double precision.
struct Vertices {
    std::vector<dvec3> positions, normals;
    std::vector<dvec4> tangents;
    std::vector<dvec2> uvs[2];
    std::vector<dvec4> colours;
};

template <class To, class From>
std::vector<To> converted(const std::vector<From>& list) {
    return {list.begin(), list.end()};
}

void require_count(const File& file, int accessor, std::size_t count, const std::string& what) {
    const std::size_t n = file.model.accessors[std::size_t(accessor)].count;
    if (n != count)
        throw Error(Exit::scene, what + " has " + std::to_string(n) + " elements but POSITION has " +
                                     std::to_string(count) + ".");
}

/// Adds the first numbers of every element: targets have no w for tangents, and no alpha in VEC3 colours.
template <class Vector>
void add(std::vector<Vector>& values, const std::vector<float>& deltas, int components, double weight) {
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int k = 0; k < components; ++k)
            values[i][k] += weight * double(deltas[i * std::size_t(components) + std::size_t(k)]);
}

class Morpher {
  public:
    Morpher(File& file, Vertices& vertices) : file_(file), vertices_(vertices) {}

    void apply(const std::map<std::string, int>& target, double weight, const std::string& what) {
        for (const auto& [name, accessor] : target) {
            const std::string attribute = what + ": " + name.substr(0, 40);
            require_count(file_, accessor, vertices_.positions.size(), attribute);
            if (weight == 0) continue;
            const Integers normalised = file_.quantised ? Integers::quantised : Integers::any_normalised;
            if (name == "POSITION")
                add(vertices_.positions, accessor, 3, weight, Integers::quantised, attribute);
            else if (name == "NORMAL")
                add(vertices_.normals, accessor, 3, weight, Integers::quantised, attribute);
            else if (name == "TANGENT")
                add(vertices_.tangents, accessor, 3, weight, Integers::quantised, attribute);
            else if (name == "TEXCOORD_0" || name == "TEXCOORD_1")
                add(vertices_.uvs[name.back() - '0'], accessor, 2, weight, normalised, attribute);
            else if (name == "COLOR_0")
                add(vertices_.colours, accessor,
                    file_.model.accessors[std::size_t(accessor)].type == TINYGLTF_TYPE_VEC3 ? 3 : 4, weight,
                    Integers::any_normalised, attribute);
        }
    }

  private:
    template <class Vector>
    void add(std::vector<Vector>& values, int accessor, int components, double weight, Integers integers,
             const std::string& what) {
        if (!values.empty())
            gltf::add(values, read_floats(file_, accessor, components, integers, what), components, weight);
    }

    File& file_;
    Vertices& vertices_;
};

/// The joints of every vertex, `sets_` times four, and their shares.
class Binding {
  public:
    Binding(File& file, const tinygltf::Primitive& source, std::size_t vertices, std::size_t joints,
            const std::string& what) {
        for (int set = 0;; ++set) {
            const auto joint = source.attributes.find("JOINTS_" + std::to_string(set));
            const auto weight = source.attributes.find("WEIGHTS_" + std::to_string(set));
            if (joint == source.attributes.end() || weight == source.attributes.end()) break;
            joints_.push_back(read_vec4(file, joint->second, Integers::counts, what + ": " + joint->first));
            weights_.push_back(
                read_vec4(file, weight->second, Integers::normalised, what + ": " + weight->first));
            for (const vec4& j : joints_.back())
                for (int k = 0; k < 4; ++k)
                    if (j[k] >= float(joints))
                        throw Error(Exit::scene, what + ": " + joint->first + " names joint " +
                                                     std::to_string(int(j[k])) + " of a skin that has " +
                                                     std::to_string(joints) + ".");
        }
        bool has_loose = joints_.empty();
        for (std::size_t i = 0; i < vertices && !has_loose; ++i) has_loose = !(sum(i) > 0.0);
        if (has_loose)
            file.warn(what + " has vertices that no joint of its skin moves; they go with their first one.");
    }

    dmat4 matrix(const Skin& skin, std::size_t vertex) const {
        const double whole = sum(vertex);
        if (!(whole > 0.0)) return skin.joints[joints_.empty() ? 0 : std::size_t(joints_.front()[vertex].x)];
        dmat4 m(0.0);
        for (std::size_t set = 0; set < joints_.size(); ++set)
            for (int k = 0; k < 4; ++k)
                if (const double share = weight(set, vertex, k); share > 0.0)
                    m += share / whole * skin.joints[std::size_t(joints_[set][vertex][k])];
        return m;
    }

  private:
    /// Neither negative nor NaN.
    double weight(std::size_t set, std::size_t vertex, int k) const {
        const double w = double(weights_[set][vertex][k]);
        return w > 0.0 && std::isfinite(w) ? w : 0.0;
    }
    double sum(std::size_t vertex) const {
        double whole = 0.0;
        for (std::size_t set = 0; set < weights_.size(); ++set)
            for (int k = 0; k < 4; ++k) whole += weight(set, vertex, k);
        return whole;
    }

    std::vector<std::vector<vec4>> joints_, weights_;
};

/// The inverse transpose times the size of the determinant: there even where the matrix has no inverse.
dmat3 normal_matrix(const dmat3& m, double sign) {
    return dmat3(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]), sign * glm::cross(m[0], m[1]));
}

void bend(const Skin& skin, const Binding& binding, Vertices& v, std::vector<uvec3>& triangles) {
    std::vector<bool> mirrored(v.positions.size());
    for (std::size_t i = 0; i < v.positions.size(); ++i) {
        const dmat4 m = binding.matrix(skin, i);
        const dmat3 linear(m);
        mirrored[i] = glm::determinant(linear) < 0.0;
        v.positions[i] = transform_point(m, v.positions[i]);
        if (!v.normals.empty()) v.normals[i] = normal_matrix(linear, mirrored[i] ? -1.0 : 1.0) * v.normals[i];
        if (!v.tangents.empty())
            v.tangents[i] =
                dvec4(linear * dvec3(v.tangents[i]), v.tangents[i].w * (mirrored[i] ? -1.0 : 1.0));
    }
    for (uvec3& t : triangles)  // the front stays the front
        if (mirrored[t.x] + mirrored[t.y] + mirrored[t.z] >= 2) std::swap(t.y, t.z);
}

}  // namespace

void deform(File& file, const tinygltf::Primitive& source, const Deformation& deformation, Primitive& p,
            const std::string& what) {
    const std::size_t count = p.positions.size();
    file.charge(count * (sizeof(dvec3) * 2 + sizeof(dvec4) * 2 + sizeof(dvec2) * 2), what);
    Vertices v{converted<dvec3>(p.positions),
               converted<dvec3>(p.normals),
               converted<dvec4>(p.tangents),
               {converted<dvec2>(p.uvs[0]), converted<dvec2>(p.uvs[1])},
               converted<dvec4>(p.colours)};
    Morpher morpher(file, v);
    for (std::size_t i = 0; i < source.targets.size(); ++i)
        morpher.apply(source.targets[i], i < deformation.weights.size() ? deformation.weights[i] : 0.0,
                      what + ", morph target " + std::to_string(i));
    if (deformation.skin) {
        const Skin& skin = *deformation.skin;
        bend(skin, Binding(file, source, count, skin.joints.size(), what), v, p.triangles);
    }
    for (dvec3& n : v.normals)  // as long as a float can be squared
        if (const double length = glm::length(n); length > 0.0) n /= length;
    for (dvec4& t : v.tangents)
        if (const double length = glm::length(dvec3(t)); length > 0.0) t = dvec4(dvec3(t) / length, t.w);
    p.positions = converted<vec3>(v.positions);
    p.normals = converted<vec3>(v.normals);
    p.tangents = converted<vec4>(v.tangents);
    for (int set = 0; set < 2; ++set) p.uvs[set] = converted<vec2>(v.uvs[set]);
    p.colours = converted<vec4>(v.colours);
    for (vec4& c : p.colours)
        for (int k = 0; k < 4; ++k) c[k] = c[k] >= 0.0f ? std::min(c[k], 1.0f) : 0.0f;
}

}  // namespace triad::gltf
