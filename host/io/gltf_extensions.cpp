#include "io/gltf_extensions.h"

#include <algorithm>
#include <iterator>

namespace triad {
namespace {

const char* const version_0 = "version 0 of the bitstream; else the fallback, if the file has one";

const GltfExtension list[] = {
    {"CESIUM_primitive_outline", Treatment::no_effect, ""},
    {"EXT_lights_image_based", Treatment::converted, "to an environment, of its sharpest specular images"},
    {"EXT_mesh_features", Treatment::no_effect, ""},
    {"EXT_mesh_gpu_instancing", Treatment::rendered, "as instances of one mesh"},
    {"EXT_mesh_manifold", Treatment::no_effect, ""},
    {"EXT_meshopt_compression", Treatment::converted, "decoded, with its filters"},
    {"EXT_structural_metadata", Treatment::no_effect, ""},
    {"EXT_texture_webp", Treatment::rendered, "before the texture's other image"},
    {"GODOT_single_root", Treatment::no_effect, ""},
    {"KHR_animation_pointer", Treatment::left_out, "what it animates stays as it is"},
    {"KHR_draco_mesh_compression", Treatment::converted, "decoded; where that fails, the fallback"},
    {"KHR_interactivity", Treatment::no_effect, ""},
    {"KHR_lights_punctual", Treatment::rendered, ""},
    {"KHR_materials_anisotropy", Treatment::rendered, ""},
    {"KHR_materials_clearcoat", Treatment::rendered, ""},
    {"KHR_materials_diffuse_transmission", Treatment::rendered, ""},
    {"KHR_materials_dispersion", Treatment::rendered, ""},
    {"KHR_materials_emissive_strength", Treatment::rendered, ""},
    {"KHR_materials_ior", Treatment::rendered, ""},
    {"KHR_materials_iridescence", Treatment::rendered, ""},
    {"KHR_materials_pbrSpecularGlossiness", Treatment::converted,
     "to a dielectric whose reflectance is the specular colour; textures texel by texel"},
    {"KHR_materials_sheen", Treatment::rendered, ""},
    {"KHR_materials_specular", Treatment::rendered, ""},
    {"KHR_materials_transmission", Treatment::rendered, ""},
    {"KHR_materials_unlit", Treatment::rendered, ""},
    {"KHR_materials_variants", Treatment::rendered, "the one of `--variant`"},
    {"KHR_materials_volume", Treatment::rendered, ""},
    {"KHR_mesh_quantization", Treatment::rendered, ""},
    {"KHR_meshopt_compression", Treatment::converted, version_0},
    {"KHR_node_hoverability", Treatment::no_effect, ""},
    {"KHR_node_selectability", Treatment::no_effect, ""},
    {"KHR_node_visibility", Treatment::rendered, ""},
    {"KHR_texture_basisu", Treatment::left_out, "the texture's other image, if it has one; else no texture"},
    {"KHR_texture_transform", Treatment::rendered, ""},
    {"KHR_xmp", Treatment::no_effect, ""},
    {"KHR_xmp_json_ld", Treatment::no_effect, ""},
    {"MSFT_lod", Treatment::no_effect, "the finest level is the node itself"},
    {"MSFT_texture_dds", Treatment::left_out, "the texture's other image, if it has one; else no texture"},
};

}  // namespace

std::span<const GltfExtension> gltf_extensions() { return list; }

Treatment treatment_of(std::string_view extension) {
    const auto found = std::find_if(std::begin(list), std::end(list),
                                    [&](const GltfExtension& e) { return extension == e.name; });
    return found == std::end(list) ? Treatment::left_out : found->treatment;
}

std::string words_for(Treatment treatment, bool required) {
    switch (treatment) {
        case Treatment::rendered:
            return "rendered";
        case Treatment::converted:
            return "converted";
        case Treatment::no_effect:
            return "no effect";
        case Treatment::left_out:
            return required ? "refused" : "left out";
    }
    return "";
}

}  // namespace triad
