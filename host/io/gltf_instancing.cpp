#include "io/gltf_instancing.h"

#include "base/error.h"
#include "io/gltf_accessor.h"

namespace triad::gltf {

Instancing::Instancing(File& file, const Node::Instancing& attributes, const std::string& node)
    : what_(node + ", EXT_mesh_gpu_instancing") {
    std::optional<std::size_t> count;
    for (const auto& [name, accessor] : attributes) {
        const std::size_t n = file.model.accessors[std::size_t(accessor)].count;
        if (count.value_or(n) != n)
            throw Error(Exit::scene, what_ + ": its attributes have different counts, " + name.substr(0, 40) +
                                         " " + std::to_string(n) + " and another " + std::to_string(*count) +
                                         ".");
        count = n;
        const std::string attribute = what_ + ": " + name;
        if (name == "TRANSLATION")
            translations_ = read_vec3(file, accessor, Integers::none, attribute);
        else if (name == "ROTATION")
            rotations_ = read_vec4(file, accessor, Integers::signed_normalised, attribute);
        else if (name == "SCALE")
            scales_ = read_vec3(file, accessor, Integers::none, attribute);
    }
    count_ = count.value_or(0);
}

dmat4 Instancing::transform(std::size_t i) const {
    dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (!rotations_.empty()) {
        const dvec4 r(rotations_[i]);
        rotation = unit_quaternion(dquat(r.w, r.x, r.y, r.z), what_ + ": instance " + std::to_string(i));
    }
    return translate_rotate_scale(translations_.empty() ? dvec3(0.0) : dvec3(translations_[i]), rotation,
                                  scales_.empty() ? dvec3(1.0) : dvec3(scales_[i]));
}

}  // namespace triad::gltf
