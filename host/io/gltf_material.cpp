#include "io/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "io/gltf_extras.h"
#include "io/gltf_members.h"
#include "io/gltf_specular_glossiness.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

/// Whether textures of this member hold colours, sRGB-encoded.
bool is_colour(std::string_view member) {
    return member == "baseColorTexture" || member == "emissiveTexture" || member == "specularColorTexture" ||
           member == "sheenColorTexture" || member == "diffuseTransmissionColorTexture";
}

vec3 not_negative(const vec3& c) { return glm::max(c, vec3(0.0f)); }

Wrap wrap_of(int value, const std::string& what) {
    switch (value) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        default:
            throw Error(Exit::scene, what + " has the unknown wrap mode " + std::to_string(value) + ".");
    }
}

/// The magnification filter decides; a file that gives only the other one means the same by its first word.
bool is_linear(const tinygltf::Sampler& sampler) {
    if (sampler.magFilter >= 0) return sampler.magFilter == TINYGLTF_TEXTURE_FILTER_LINEAR;
    return sampler.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
           sampler.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST &&
           sampler.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
}

/// KHR_texture_transform: u' = ox + c sx u + s sy v, v' = oy - s sx u + c sy v. (The GLSL in the extension's
/// text, read as column-major, turns the other way; its JSON example and the TextureTransformTest asset agree
/// with this.)
std::array<float, 6> transform_of(const Value& extension) {
    const auto pair = [&](const char* member, double otherwise) {
        if (!extension.Has(member)) return dvec2(otherwise);
        const Value& array = extension.Get(std::string(member));
        return dvec2(array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble());
    };
    const dvec2 offset = pair("offset", 0.0), scale = pair("scale", 1.0);
    const double rotation = number(extension, "rotation", 0.0), c = std::cos(rotation),
                 s = std::sin(rotation);
    return {float(c * scale.x),  float(s * scale.y), float(offset.x),
            float(-s * scale.x), float(c * scale.y), float(offset.y)};
}

/// The extension that an image format belongs to which cannot be decoded here, by the first bytes.
const char* unsupported_format(const ImageSource& image) {
    std::string head(image.bytes.begin(),
                     image.bytes.begin() + std::ptrdiff_t(std::min<std::size_t>(8, image.bytes.size())));
    if (!image.path.empty()) {
        char bytes[8] = {};
        std::ifstream(image.path, std::ios::binary).read(bytes, sizeof bytes);
        head.assign(bytes, sizeof bytes);
    }
    if (head.starts_with("\xabKTX 20\xbb") || head.starts_with("\xabKTX 11\xbb")) return "KHR_texture_basisu";
    if (head.starts_with("DDS ")) return "MSFT_texture_dds";
    return nullptr;
}

}  // namespace

std::size_t Materials::use(int material) {
    const auto [found, is_new] = materials_.try_emplace(material, scene_.materials.size());
    if (is_new) scene_.materials.push_back(material < 0 ? Material{.name = "default"} : convert(material));
    return found->second;
}

std::size_t Materials::use_for_strokes(int material, bool has_normals) {
    const auto found = of_strokes_.find({material, has_normals});
    if (found != of_strokes_.end()) return found->second;
    Material m = scene_.materials[use(material)];
    m.double_sided = true;
    m.normal_texture.reset();
    if (m.clearcoat) m.clearcoat->normal_texture.reset();
    m.anisotropy.reset();
    if (!has_normals) {
        m.clearcoat.reset(), m.sheen.reset(), m.iridescence.reset(), m.diffuse_transmission.reset();
    }
    if (!has_normals && m.emission == vec3(0.0f)) {
        m.unlit = true;
    } else if (!has_normals) {  // as bright as it asks for, which unlit surfaces cannot be
        m.emission += vec3(m.base_colour);
        m.base_colour = vec4(vec3(0.0f), m.base_colour.w);
        m.specular = 0.0f;
    }
    scene_.materials.push_back(m);
    return of_strokes_[{material, has_normals}] = scene_.materials.size() - 1;
}

std::size_t Materials::image(int source, std::optional<double> glossiness) {
    const auto [image, is_new] = images_.try_emplace({source, glossiness}, scene_.images.size());
    if (is_new) {
        scene_.images.push_back({.name = file_.images[std::size_t(source)].name});
        image_sources_.emplace_back(source, glossiness);
    }
    return image->second;
}

std::optional<std::size_t> Materials::texture_with_sampler(int index, const std::string& what,
                                                           std::optional<double> glossiness) {
    const auto known = textures_.find({index, glossiness});
    if (known != textures_.end()) return known->second;
    const tinygltf::Texture& texture = file_.model.textures[std::size_t(index)];
    const std::string name = what + ", " + label("texture", std::size_t(index), texture.name);

    int source = texture.source;
    if (const Value* webp = find_extension(texture.extensions, "EXT_texture_webp");
        webp && webp->Has("source"))
        source = webp->Get("source").GetNumberAsInt();
    const char* needs = source < 0 ? nullptr : unsupported_format(file_.images[std::size_t(source)]);
    for (const char* other : {"KHR_texture_basisu", "MSFT_texture_dds"})
        if (source < 0 && find_extension(texture.extensions, other)) needs = other;
    if (needs) {
        file_.warn(name + " needs " + needs +
                   ", which is not supported; it is left out (convert its image to PNG or JPEG).");
        return std::nullopt;
    }
    if (source < 0) throw Error(Exit::scene, name + " has no image.");
    Texture result{.image = image(source, glossiness)};
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = file_.model.samplers[std::size_t(texture.sampler)];
        const std::string sampler_name = label("sampler", std::size_t(texture.sampler), sampler.name);
        result.wrap_u = wrap_of(sampler.wrapS, sampler_name);
        result.wrap_v = wrap_of(sampler.wrapT, sampler_name);
        result.linear = is_linear(sampler);
    }
    scene_.textures.push_back(result);
    return textures_[{index, glossiness}] = scene_.textures.size() - 1;
}

std::optional<TextureUse> Materials::texture(const char* member, int index, int uv_set,
                                             const tinygltf::ExtensionMap& extensions,
                                             const std::string& what, std::optional<double> glossiness) {
    if (index < 0) return std::nullopt;
    TextureUse use;
    if (const Value* transform = find_extension(extensions, "KHR_texture_transform")) {
        use.transform = transform_of(*transform);
        uv_set = int(number(*transform, "texCoord", uv_set));
    }
    if (uv_set > 1) {
        file_.warn(what + " uses TEXCOORD_" + std::to_string(uv_set) + " for its " + member +
                   "; only TEXCOORD_0 and 1 are supported, so that texture is left out.");
        return std::nullopt;
    }
    use.uv_set = unsigned(uv_set);
    const std::optional<std::size_t> converted = texture_with_sampler(index, what, glossiness);
    if (!converted) return std::nullopt;
    use.texture = *converted;
    if (is_colour(member) && !glossiness) colours_.insert(scene_.textures[*converted].image);
    return use;
}

std::optional<TextureUse> Materials::extension_texture(const Value& extension, const char* member,
                                                       const std::string& what,
                                                       std::optional<double> glossiness) {
    if (!extension.Has(member)) return std::nullopt;
    const Value& object = extension.Get(std::string(member));
    tinygltf::ExtensionMap extensions;
    if (object.Has("extensions")) extensions = object.Get("extensions").Get<Value::Object>();
    return texture(member, int(number(object, "index", -1)), int(number(object, "texCoord", 0)), extensions,
                   what, glossiness);
}

/// A Fresnel term of 1 (an ior of 0) leaves the specular colour as the reflectance at normal incidence.
void Materials::convert_specular_glossiness(const Value& extension, const std::string& what, Material& m) {
    m.base_colour = vec4(glm::clamp(colour(extension, "diffuseFactor", vec3(1.0f)), 0.0f, 1.0f), 1.0f);
    if (extension.Has("diffuseFactor"))
        m.base_colour.w = to_unit(extension.Get("diffuseFactor").Get(3).GetNumberAsDouble());
    m.base_colour_texture = extension_texture(extension, "diffuseTexture", what);
    m.metallic = 0.0f;
    m.ior = 0.0f;
    m.specular_colour = glm::clamp(colour(extension, "specularFactor", vec3(1.0f)), 0.0f, 1.0f);
    m.specular_colour_texture = extension_texture(extension, "specularGlossinessTexture", what);
    const double glossiness = std::clamp(number(extension, "glossinessFactor", 1.0), 0.0, 1.0);
    m.metallic_roughness_texture =
        extension_texture(extension, "specularGlossinessTexture", what, glossiness);
    m.roughness = m.metallic_roughness_texture ? 1.0f : float(1.0 - glossiness);
}

Material Materials::convert(int index) {
    const tinygltf::Material& source = file_.model.materials[std::size_t(index)];
    const auto& pbr = source.pbrMetallicRoughness;
    const std::string what = label("material", std::size_t(index), source.name);
    const auto info = [&](const char* member, const auto& texture_info) {
        return texture(member, texture_info.index, texture_info.texCoord, texture_info.extensions, what);
    };
    const auto extension_texture = [&](const Value& extension, const char* member) {
        return this->extension_texture(extension, member, what);
    };

    Material m;
    m.name = source.name;
    const auto& base = pbr.baseColorFactor;
    m.base_colour = vec4(to_unit(base[0]), to_unit(base[1]), to_unit(base[2]), to_unit(base[3]));
    m.metallic = to_unit(pbr.metallicFactor);
    m.roughness = to_unit(pbr.roughnessFactor);
    m.double_sided = source.doubleSided;
    m.alpha_cutoff = float(source.alphaCutoff);
    if (source.alphaMode == "MASK")
        m.alpha_mode = AlphaMode::mask;
    else if (source.alphaMode == "BLEND")
        m.alpha_mode = AlphaMode::blend;
    else if (source.alphaMode != "OPAQUE")
        throw Error(Exit::scene,
                    what + " has the unknown alphaMode '" + source.alphaMode.substr(0, 40) + "'.");
    m.base_colour_texture = info("baseColorTexture", pbr.baseColorTexture);
    m.metallic_roughness_texture = info("metallicRoughnessTexture", pbr.metallicRoughnessTexture);
    m.normal_texture = info("normalTexture", source.normalTexture);
    m.normal_scale = float(source.normalTexture.scale);

    if (const auto& e = source.emissiveFactor; e.size() == 3)
        m.emission = not_negative(vec3(e[0], e[1], e[2]));
    if (const Value* e = find_extension(source.extensions, "KHR_materials_emissive_strength"))
        m.emission *= float(number(*e, "emissiveStrength", 1.0));
    if (m.emission != vec3(0.0f)) m.emission_texture = info("emissiveTexture", source.emissiveTexture);

    m.unlit = find_extension(source.extensions, "KHR_materials_unlit") != nullptr;
    if (const Value* e = find_extension(source.extensions, "KHR_materials_ior")) {
        const double ior = number(*e, "ior", 1.5);
        if (ior != 0.0 && ior < 1.0) file_.warn(what + " has an ior below 1, which is taken as 1.");
        if (ior > Dispersion::most_index)
            file_.warn(what +
                       " has an ior above 10, which no transparent material has; it is used as it is.");
        m.ior = ior == 0.0 ? 0.0f : float(std::max(ior, 1.0));
    }
    if (const Value* e = find_extension(source.extensions, "KHR_materials_specular")) {
        m.specular = to_unit(number(*e, "specularFactor", 1.0));
        m.specular_colour = not_negative(colour(*e, "specularColorFactor", vec3(1.0f)));
        m.specular_texture = extension_texture(*e, "specularTexture");
        m.specular_colour_texture = extension_texture(*e, "specularColorTexture");
    }
    if (const Value* e = find_extension(source.extensions, "KHR_materials_transmission")) {
        m.transmission = to_unit(number(*e, "transmissionFactor", 0.0));
        if (m.transmission > 0.0f) m.transmission_texture = extension_texture(*e, "transmissionTexture");
    }
    if (const Value* e = find_extension(source.extensions, "KHR_materials_volume")) {
        m.thickness = float(number(*e, "thicknessFactor", 0.0));
        m.attenuation_colour = glm::clamp(colour(*e, "attenuationColor", vec3(1.0f)), 0.0f, 1.0f);
        const double distance = number(*e, "attenuationDistance", 0.0);
        if (distance > 0.0) m.attenuation_distance = float(distance);
    }
    if (const Value* e = find_extension(source.extensions, "KHR_materials_dispersion"))
        if (const double dispersion = number(*e, "dispersion", 0.0); dispersion > 0.0) {
            if (m.ior == 0.0f)
                file_.warn(what + " has a dispersion, but an ior of 0 lets no light in; it is left out.");
            else
                m.dispersion = abbe_dispersion(m.ior, dispersion);
        }
    if (const Value* e = find_extension(source.extensions, "KHR_materials_pbrSpecularGlossiness"))
        convert_specular_glossiness(*e, what, m);
    if (!m.unlit) convert_blocks(source.extensions, what, m);
    apply_material_extras(source.extras, what, m, [this](const std::string& s) { file_.warn(s); });
    if (m.dispersion && !(m.transmission > 0.0f && m.thickness > 0.0f)) {
        file_.warn(what +
                   " has a dispersion, but is no solid body that transmits (KHR_materials_transmission and "
                   "KHR_materials_volume with a thickness above 0); it is left out.");
        m.dispersion.reset();
    }
    return m;
}

}  // namespace triad::gltf
