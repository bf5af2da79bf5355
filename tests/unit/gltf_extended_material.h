#pragma once
/// Small files whose material has clearcoat, sheen, anisotropy, iridescence and diffuse transmission.
#include <utility>
#include <vector>

#include "gltf_builder.h"

namespace triad {

/// The triangle, with a texture and a material that has these extensions.
inline GltfBuilder& with_extensions(GltfBuilder& b, const nlohmann::json& extensions) {
    b.triangle().texture().primitive()["material"] = 0;
    b.document["materials"] = {{{"extensions", extensions}}};
    return b;
}

/// Every extension with every member that is a number or a colour.
inline nlohmann::json all_factors() {
    return {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}},
            {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 1}}, {"sheenRoughnessFactor", 0.75}}},
            {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 0.125}}},
            {"KHR_materials_iridescence",
             {{"iridescenceFactor", 0.5},
              {"iridescenceIor", 1.75},
              {"iridescenceThicknessMinimum", 200},
              {"iridescenceThicknessMaximum", 800}}},
            {"KHR_materials_diffuse_transmission",
             {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}}}}};
}

/// Their textures.
inline const std::vector<std::pair<const char*, const char*>> all_textures{
    {"KHR_materials_clearcoat", "clearcoatTexture"},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
    {"KHR_materials_sheen", "sheenColorTexture"},
    {"KHR_materials_sheen", "sheenRoughnessTexture"},
    {"KHR_materials_anisotropy", "anisotropyTexture"},
    {"KHR_materials_iridescence", "iridescenceTexture"},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"}};

}  // namespace triad
