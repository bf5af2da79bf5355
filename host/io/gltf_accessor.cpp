#include "io/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/error.h"

namespace triad::gltf {
namespace {

enum Component { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// Bytes of a component; 0: glTF has no such type.
std::size_t size_of(int component) {
    switch (component) {
        case int8:
        case uint8:
            return 1;
        case int16:
        case uint16:
            return 2;
        case uint32:
        case float32:
            return 4;
        default:
            return 0;
    }
}

/// `count` elements that all lie inside `bytes`. Throws Error(scene) otherwise.
struct Elements {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;

    Elements(Bytes bytes, std::uint64_t offset, std::size_t stride_, std::size_t element, std::uint64_t count,
             const std::string& what)
        : stride(stride_) {
        const std::uint64_t size = bytes.size();
        if (stride < element)
            throw Error(Exit::scene, what + " has a byteStride of " + std::to_string(stride) +
                                         ", less than its elements of " + std::to_string(element) +
                                         " bytes.");
        if (count != 0 &&
            (offset > size || element > size - offset || (count - 1) > (size - offset - element) / stride))
            throw Error(Exit::scene, what + " needs " + std::to_string(count) + " elements of " +
                                         std::to_string(element) + " bytes, " + std::to_string(stride) +
                                         " apart, from byte " + std::to_string(offset) +
                                         ", but its bufferView has " + std::to_string(size) + " bytes.");
        data = bytes.data() + (count != 0 ? offset : 0);
    }
    const std::uint8_t* at(std::size_t i) const { return data + i * stride; }
};

template <class T>
T load(const std::uint8_t* p) {
    T value;
    std::memcpy(&value, p, sizeof value);  // glTF is little-endian, as are all machines that OpenCL knows
    return value;
}

template <class T>
float scaled(const std::uint8_t* p, bool normalised) {
    const float value = float(load<T>(p));
    if (!normalised) return value;
    return std::max(value / float(std::numeric_limits<T>::max()), -1.0f);
}

float to_float(const std::uint8_t* p, int component, bool normalised) {
    switch (component) {
        case int8:
            return scaled<std::int8_t>(p, normalised);
        case uint8:
            return scaled<std::uint8_t>(p, normalised);
        case int16:
            return scaled<std::int16_t>(p, normalised);
        case uint16:
            return scaled<std::uint16_t>(p, normalised);
        default:
            return load<float>(p);
    }
}

std::uint32_t to_index(const std::uint8_t* p, int component) {
    return component == uint8 ? *p : component == uint16 ? load<std::uint16_t>(p) : load<std::uint32_t>(p);
}

/// Calls read(element index, pointer) for all elements of the accessor, then again for the sparse ones.
/// Without a bufferView the elements are zero and read() is called for the sparse ones only.
template <class Read>
void for_each(const File& file, int index, std::size_t element, const std::string& what, const Read& read) {
    const tinygltf::Accessor& accessor = file.model.accessors[std::size_t(index)];
    if (accessor.bufferView >= 0) {
        const std::size_t stride = file.model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
        const Elements elements(file.view(accessor.bufferView, what), accessor.byteOffset,
                                stride ? stride : element, element, accessor.count, what);
        for (std::size_t i = 0; i < accessor.count; ++i) read(i, elements.at(i));
    }
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    const std::uint64_t count = std::uint64_t(sparse.count);
    const int component = sparse.indices.componentType;
    if (count > accessor.count)
        throw Error(Exit::scene, what + " replaces " + std::to_string(count) +
                                     " sparse elements but has only " + std::to_string(accessor.count) + ".");
    if (component != uint8 && component != uint16 && component != uint32)
        throw Error(Exit::scene,
                    what + " has sparse indices of component type " + std::to_string(component) + ".");
    const Elements indices(file.view(sparse.indices.bufferView, what),
                           std::uint64_t(sparse.indices.byteOffset), size_of(component), size_of(component),
                           count, what + ", sparse indices,");
    const Elements values(file.view(sparse.values.bufferView, what), std::uint64_t(sparse.values.byteOffset),
                          element, element, count, what + ", sparse values,");
    std::int64_t last = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t target = to_index(indices.at(i), component);
        if (target >= accessor.count || std::int64_t(target) <= last)
            throw Error(Exit::scene, what + " has the sparse index " + std::to_string(target) + " at place " +
                                         std::to_string(i) + "; they must rise and stay below " +
                                         std::to_string(accessor.count) + ".");
        last = target;
        read(target, values.at(i));
    }
}

std::string name_of(const File& file, int index, const std::string& what) {
    return what + " (" +
           label("accessor", std::size_t(index), file.model.accessors[std::size_t(index)].name) + ")";
}

/// What a glTF file calls elements of so many components.
std::string type_name(int components) {
    return components == 1 ? "SCALAR" : components == 16 ? "MAT4" : "VEC" + std::to_string(components);
}

/// tinygltf's number for it.
int type_number(int components) {
    return components == 1 ? TINYGLTF_TYPE_SCALAR : components == 16 ? TINYGLTF_TYPE_MAT4 : components;
}

template <class Vector>
std::vector<Vector> as_vectors(const std::vector<float>& floats) {
    std::vector<Vector> result(floats.size() / std::size_t(Vector::length()));
    if (!result.empty()) std::memcpy(result.data(), floats.data(), floats.size() * sizeof(float));
    return result;
}

}  // namespace

std::vector<float> read_floats(File& file, int index, int components, Integers integers,
                               const std::string& what_) {
    const tinygltf::Accessor& accessor = file.model.accessors[std::size_t(index)];
    const std::string what = name_of(file, index, what_);
    if (accessor.type != type_number(components))
        throw Error(Exit::scene, what + " must be of type " + type_name(components) + ".");
    const int component = accessor.componentType;
    const bool narrow = size_of(component) == 1 || size_of(component) == 2;
    const bool is_signed = component == int8 || component == int16;
    const bool allowed =
        (component == float32 && integers != Integers::counts) ||
        (narrow && ((integers == Integers::normalised && accessor.normalized && !is_signed) ||
                    (integers == Integers::signed_normalised && accessor.normalized && is_signed) ||
                    (integers == Integers::any_normalised && accessor.normalized) ||
                    (integers == Integers::counts && !accessor.normalized && !is_signed) ||
                    (integers == Integers::quantised && file.quantised)));
    if (!allowed)
        throw Error(Exit::scene, what + " has component type " + std::to_string(component) +
                                     (accessor.normalized ? " (normalised)" : "") +
                                     ", which is not allowed there" +
                                     (narrow && !file.quantised && integers == Integers::quantised
                                          ? " without KHR_mesh_quantization."
                                          : "."));
    const std::size_t size = size_of(component), n = std::size_t(components);
    if (accessor.count > (std::uint64_t(1) << 40))
        throw Error(Exit::scene, what + " has an absurd count of elements.");
    file.charge(accessor.count * n * sizeof(float), what);
    std::vector<float> floats(accessor.count * n);
    for_each(file, index, size * n, what, [&](std::size_t i, const std::uint8_t* p) {
        for (std::size_t k = 0; k < n; ++k)
            floats[i * n + k] = to_float(p + k * size, component, accessor.normalized);
    });
    return floats;
}

std::vector<vec2> read_vec2(File& file, int accessor, Integers integers, const std::string& what) {
    return as_vectors<vec2>(read_floats(file, accessor, 2, integers, what));
}
std::vector<vec3> read_vec3(File& file, int accessor, Integers integers, const std::string& what) {
    return as_vectors<vec3>(read_floats(file, accessor, 3, integers, what));
}
std::vector<vec4> read_vec4(File& file, int accessor, Integers integers, const std::string& what) {
    return as_vectors<vec4>(read_floats(file, accessor, 4, integers, what));
}

std::vector<std::uint32_t> read_indices(File& file, int index, const std::string& what_) {
    const tinygltf::Accessor& accessor = file.model.accessors[std::size_t(index)];
    const std::string what = name_of(file, index, what_);
    const int component = accessor.componentType;
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        (component != uint8 && component != uint16 && component != uint32) || accessor.normalized)
        throw Error(Exit::scene, what + " must hold unsigned scalars of 8, 16 or 32 bits, not normalised.");
    if (accessor.count > (std::uint64_t(1) << 40))
        throw Error(Exit::scene, what + " has an absurd count of elements.");
    file.charge(accessor.count * sizeof(std::uint32_t), what);
    std::vector<std::uint32_t> result(accessor.count);
    for_each(file, index, size_of(component), what,
             [&](std::size_t i, const std::uint8_t* p) { result[i] = to_index(p, component); });
    return result;
}

}  // namespace triad::gltf
