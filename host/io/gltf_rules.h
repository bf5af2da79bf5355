#pragma once
/// What the members of a glTF document must be, one line each. Checked by gltf_check.cpp.
#include <limits>
#include <span>

namespace triad::gltf {

enum class Kind { object, objects, array, index, integer, number, numbers, text, boolean };

/// One member of the document. Path: names joined by dots, "[]" every element, "{}" every member.
struct Rule {
    const char* path;
    Kind kind;
    const char* of = "";                                   ///< index: the array, as a path
    bool required = false;                                 ///< when the object that should hold it exists
    double lo = -std::numeric_limits<double>::infinity();  ///< integer, number: the least; numbers: the
                                                           ///< length; arrays: the least length
    double hi = std::numeric_limits<double>::infinity();   ///< integer, number: the most; arrays: the length
};

/// What must hold before anything else is worth a look.
std::span<const Rule> header_rules();
/// Everything else.
std::span<const Rule> document_rules();
/// What holds of every textureInfo; the paths continue one of texture_infos().
std::span<const Rule> texture_rules();
/// Where a material may have a textureInfo.
std::span<const char* const> texture_infos();

}  // namespace triad::gltf
