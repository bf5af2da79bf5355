#pragma once
/// What becomes of every glTF extension: one list for the loader, for `triad info` and for
/// docs/extensions.md.
#include <span>
#include <string>
#include <string_view>

namespace triad {

enum class Treatment {
    rendered,   ///< as its text says
    converted,  ///< into what is rendered
    no_effect,  ///< it says nothing about a still picture
    left_out    ///< with a warning; refused where a file requires it
};

struct GltfExtension {
    const char* name;
    Treatment treatment;
    const char* how;  ///< what to know of it; may be empty
};

/// By name.
std::span<const GltfExtension> gltf_extensions();

/// Of any name: what is not in the list is left out.
Treatment treatment_of(std::string_view extension);

/// "rendered", "converted", "no effect", "left out", or "refused" for what is left out but required.
std::string words_for(Treatment treatment, bool required);

}  // namespace triad
