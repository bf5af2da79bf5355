#include "io/gltf_members.h"

#include <algorithm>
#include <string>

namespace triad::gltf {

using tinygltf::Value;

const Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number(const Value& object, const char* member, double otherwise) {
    return object.Has(member) ? object.Get(std::string(member)).GetNumberAsDouble() : otherwise;
}

vec3 colour(const Value& object, const char* member, const vec3& otherwise) {
    if (!object.Has(member)) return otherwise;
    const Value& array = object.Get(std::string(member));
    return vec3(array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble(),
                array.Get(2).GetNumberAsDouble());
}

float to_unit(double x) { return float(std::clamp(x, 0.0, 1.0)); }

}  // namespace triad::gltf
