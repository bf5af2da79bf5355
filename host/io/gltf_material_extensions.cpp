/// The extensions of materials that are blocks of their own in the scene: each is there only where its factor
/// is above 0, so that a scene pays for nothing that no material shows.
#include <algorithm>
#include <cmath>

#include "io/gltf_material.h"
#include "io/gltf_members.h"

namespace triad::gltf {

using tinygltf::Value;

void Materials::convert_blocks(const tinygltf::ExtensionMap& extensions, const std::string& what,
                               Material& m) {
    if (const Value* e = find_extension(extensions, "KHR_materials_clearcoat"))
        convert_clearcoat(*e, what, m);
    if (const Value* e = find_extension(extensions, "KHR_materials_sheen")) convert_sheen(*e, what, m);
    if (const Value* e = find_extension(extensions, "KHR_materials_anisotropy"))
        convert_anisotropy(*e, what, m);
    if (const Value* e = find_extension(extensions, "KHR_materials_iridescence"))
        convert_iridescence(*e, what, m);
    if (const Value* e = find_extension(extensions, "KHR_materials_diffuse_transmission"))
        convert_diffuse_transmission(*e, what, m);
}

void Materials::convert_clearcoat(const Value& extension, const std::string& what, Material& m) {
    Clearcoat coat;
    coat.factor = to_unit(number(extension, "clearcoatFactor", 0.0));
    if (coat.factor == 0.0f) return;
    coat.roughness = to_unit(number(extension, "clearcoatRoughnessFactor", 0.0));
    coat.texture = extension_texture(extension, "clearcoatTexture", what);
    coat.roughness_texture = extension_texture(extension, "clearcoatRoughnessTexture", what);
    coat.normal_texture = extension_texture(extension, "clearcoatNormalTexture", what);
    if (coat.normal_texture)
        coat.normal_scale = float(number(extension.Get(std::string("clearcoatNormalTexture")), "scale", 1.0));
    m.clearcoat = coat;
}

void Materials::convert_sheen(const Value& extension, const std::string& what, Material& m) {
    Sheen sheen;
    sheen.colour = glm::clamp(colour(extension, "sheenColorFactor", vec3(0.0f)), 0.0f, 1.0f);
    if (sheen.colour == vec3(0.0f)) return;
    sheen.roughness = to_unit(number(extension, "sheenRoughnessFactor", 0.0));
    sheen.colour_texture = extension_texture(extension, "sheenColorTexture", what);
    sheen.roughness_texture = extension_texture(extension, "sheenRoughnessTexture", what);
    m.sheen = sheen;
}

void Materials::convert_anisotropy(const Value& extension, const std::string& what, Material& m) {
    Anisotropy anisotropy;
    anisotropy.strength = to_unit(number(extension, "anisotropyStrength", 0.0));
    if (anisotropy.strength == 0.0f) return;
    // Within a turn, so that float keeps the angle however large the file's is.
    anisotropy.rotation = float(std::remainder(number(extension, "anisotropyRotation", 0.0), 2.0 * pi));
    anisotropy.texture = extension_texture(extension, "anisotropyTexture", what);
    m.anisotropy = anisotropy;
}

void Materials::convert_iridescence(const Value& extension, const std::string& what, Material& m) {
    Iridescence film;
    film.factor = to_unit(number(extension, "iridescenceFactor", 0.0));
    if (film.factor == 0.0f) return;
    const double ior = number(extension, "iridescenceIor", 1.3);
    if (ior < 1.0) file_.warn(what + " has an iridescenceIor below 1, which is taken as 1.");
    film.ior = float(std::clamp(ior, 1.0, 1e6));
    film.thickness_minimum = float(number(extension, "iridescenceThicknessMinimum", 100.0));
    film.thickness_maximum = float(number(extension, "iridescenceThicknessMaximum", 400.0));
    film.texture = extension_texture(extension, "iridescenceTexture", what);
    film.thickness_texture = extension_texture(extension, "iridescenceThicknessTexture", what);
    m.iridescence = film;
}

void Materials::convert_diffuse_transmission(const Value& extension, const std::string& what, Material& m) {
    DiffuseTransmission through;
    through.factor = to_unit(number(extension, "diffuseTransmissionFactor", 0.0));
    if (through.factor == 0.0f) return;
    through.colour = glm::clamp(colour(extension, "diffuseTransmissionColorFactor", vec3(1.0f)), 0.0f, 1.0f);
    through.texture = extension_texture(extension, "diffuseTransmissionTexture", what);
    through.colour_texture = extension_texture(extension, "diffuseTransmissionColorTexture", what);
    m.diffuse_transmission = through;
}

}  // namespace triad::gltf
