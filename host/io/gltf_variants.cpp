#include "io/gltf_variants.h"

#include <algorithm>

#include "base/error.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

const char* const extension = "KHR_materials_variants";

/// The list `member` of the extension; null: there is none.
const Value* list_of(const tinygltf::ExtensionMap& extensions, const char* member) {
    const auto found = extensions.find(extension);
    return found != extensions.end() && found->second.Has(member) ? &found->second.Get(std::string(member))
                                                                  : nullptr;
}

}  // namespace

std::vector<std::string> variant_names(const File& file) {
    std::vector<std::string> names;
    if (const Value* variants = list_of(file.model.extensions, "variants"))
        for (std::size_t i = 0; i < variants->ArrayLen(); ++i) {
            const Value& variant = variants->Get(int(i));
            names.push_back(variant.Has("name") ? variant.Get("name").Get<std::string>() : std::string());
        }
    return names;
}

int find_variant(const File& file, const std::string& name) {
    if (name.empty()) return -1;
    const std::vector<std::string> names = variant_names(file);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return int(found - names.begin());
    std::string sentence = "--variant " + name + ": there is no such variant; the file has ";
    if (names.empty()) throw Error(Exit::usage, sentence + "none.");
    for (std::size_t i = 0; i < names.size(); ++i) sentence += (i ? ", \"" : "\"") + names[i] + '"';
    throw Error(Exit::usage, sentence + ".");
}

int material_of(const tinygltf::Primitive& primitive, int variant) {
    const Value* mappings = variant < 0 ? nullptr : list_of(primitive.extensions, "mappings");
    if (!mappings) return primitive.material;
    for (std::size_t i = 0; i < mappings->ArrayLen(); ++i) {
        const Value &mapping = mappings->Get(int(i)), &variants = mapping.Get("variants");
        for (std::size_t k = 0; k < variants.ArrayLen(); ++k)
            if (variants.Get(int(k)).GetNumberAsInt() == variant)
                return mapping.Get("material").GetNumberAsInt();
    }
    return primitive.material;
}

}  // namespace triad::gltf
