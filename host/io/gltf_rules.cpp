#include "io/gltf_rules.h"

namespace triad::gltf {
namespace {

constexpr double int_max = 2147483647.0, big = 9007199254740992.0;  // 2^53
constexpr bool required = true;

const Rule header[] = {
    {"asset", Kind::object, "", required}, {"asset.version", Kind::text, "", required},
    {"asset.minVersion", Kind::text},      {"extensionsUsed", Kind::array},
    {"extensionsUsed[]", Kind::text},      {"extensionsRequired", Kind::array},
    {"extensionsRequired[]", Kind::text},
};

const Rule document[] = {
    {"extensions", Kind::object},
    {"extensions{}", Kind::object},

    {"buffers", Kind::objects},
    {"buffers[].byteLength", Kind::integer, "", required, 0, big},
    {"buffers[].uri", Kind::text},
    {"bufferViews", Kind::objects},
    {"bufferViews[].buffer", Kind::index, "buffers", required},
    {"bufferViews[].byteOffset", Kind::integer, "", false, 0, big},
    {"bufferViews[].byteLength", Kind::integer, "", required, 0, big},
    {"bufferViews[].byteStride", Kind::integer, "", false, 0, 252},

    {"accessors", Kind::objects},
    {"accessors[].bufferView", Kind::index, "bufferViews"},
    {"accessors[].byteOffset", Kind::integer, "", false, 0, big},
    {"accessors[].componentType", Kind::integer, "", required, 5120, 5126},
    {"accessors[].count", Kind::integer, "", required, 0, big},
    {"accessors[].type", Kind::text, "", required},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].sparse", Kind::object},
    {"accessors[].sparse.count", Kind::integer, "", required, 1, int_max},
    {"accessors[].sparse.indices", Kind::object, "", required},
    {"accessors[].sparse.indices.bufferView", Kind::index, "bufferViews", required},
    {"accessors[].sparse.indices.byteOffset", Kind::integer, "", false, 0, int_max},
    {"accessors[].sparse.indices.componentType", Kind::integer, "", required, 5121, 5125},
    {"accessors[].sparse.values", Kind::object, "", required},
    {"accessors[].sparse.values.bufferView", Kind::index, "bufferViews", required},
    {"accessors[].sparse.values.byteOffset", Kind::integer, "", false, 0, int_max},

    {"meshes", Kind::objects},
    {"meshes[].primitives", Kind::objects, "", required, 1},
    {"meshes[].primitives[].attributes", Kind::object, "", required, 1},
    {"meshes[].primitives[].attributes{}", Kind::index, "accessors"},
    {"meshes[].primitives[].indices", Kind::index, "accessors"},
    {"meshes[].primitives[].material", Kind::index, "materials"},
    {"meshes[].primitives[].mode", Kind::integer, "", false, 0, 6},
    {"meshes[].primitives[].targets", Kind::objects},
    {"meshes[].primitives[].targets[]{}", Kind::index, "accessors"},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings", Kind::objects},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].material", Kind::index, "materials",
     required},
    {"meshes[].weights", Kind::array},
    {"meshes[].weights[]", Kind::number},

    {"nodes", Kind::objects},
    {"nodes[].children", Kind::array},
    {"nodes[].children[]", Kind::index, "nodes"},
    {"nodes[].mesh", Kind::index, "meshes"},
    {"nodes[].camera", Kind::index, "cameras"},
    {"nodes[].skin", Kind::index, "skins"},
    {"nodes[].matrix", Kind::numbers, "", false, 16},
    {"nodes[].translation", Kind::numbers, "", false, 3},
    {"nodes[].rotation", Kind::numbers, "", false, 4},
    {"nodes[].scale", Kind::numbers, "", false, 3},
    {"nodes[].weights", Kind::array},
    {"nodes[].weights[]", Kind::number},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::index, "extensions.KHR_lights_punctual.lights",
     required},
    {"nodes[].extensions.KHR_node_visibility.visible", Kind::boolean},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", Kind::object, "", required},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes{}", Kind::index, "accessors"},

    {"scene", Kind::index, "scenes"},
    {"scenes", Kind::objects},
    {"scenes[].nodes", Kind::array},
    {"scenes[].nodes[]", Kind::index, "nodes"},

    {"skins", Kind::objects},
    {"skins[].joints", Kind::array, "", required, 1},
    {"skins[].joints[]", Kind::index, "nodes"},
    {"skins[].skeleton", Kind::index, "nodes"},
    {"skins[].inverseBindMatrices", Kind::index, "accessors"},
    {"animations", Kind::objects},
    {"animations[].samplers", Kind::objects, "", required},
    {"animations[].samplers[].input", Kind::index, "accessors", required},
    {"animations[].samplers[].output", Kind::index, "accessors", required},
    {"animations[].channels", Kind::objects, "", required},
    {"animations[].channels[].target", Kind::object, "", required},
    {"animations[].channels[].target.node", Kind::index, "nodes"},

    {"cameras", Kind::objects},
    {"cameras[].type", Kind::text, "", required},
    {"cameras[].perspective", Kind::object},
    {"cameras[].perspective.yfov", Kind::number, "", required, 1e-6, 3.1415926},
    {"cameras[].perspective.aspectRatio", Kind::number, "", false, 1e-6, 1e6},
    {"cameras[].perspective.znear", Kind::number, "", required, 0},
    {"cameras[].perspective.zfar", Kind::number, "", false, 0},
    {"cameras[].orthographic", Kind::object},
    {"cameras[].orthographic.xmag", Kind::number, "", required},
    {"cameras[].orthographic.ymag", Kind::number, "", required},
    {"cameras[].orthographic.znear", Kind::number, "", required},
    {"cameras[].orthographic.zfar", Kind::number, "", required},

    {"images", Kind::objects},
    {"images[].uri", Kind::text},
    {"images[].mimeType", Kind::text},
    {"images[].bufferView", Kind::index, "bufferViews"},
    {"samplers", Kind::objects},
    {"samplers[].magFilter", Kind::integer, "", false, 9728, 9729},
    {"samplers[].minFilter", Kind::integer, "", false, 9728, 9987},
    {"samplers[].wrapS", Kind::integer, "", false, 10497, 33648},
    {"samplers[].wrapT", Kind::integer, "", false, 10497, 33648},
    {"textures", Kind::objects},
    {"textures[].source", Kind::index, "images"},
    {"textures[].sampler", Kind::index, "samplers"},
    {"textures[].extensions.EXT_texture_webp.source", Kind::index, "images"},
    {"textures[].extensions.KHR_texture_basisu.source", Kind::index, "images", required},
    {"textures[].extensions.MSFT_texture_dds.source", Kind::index, "images"},

    {"materials", Kind::objects},
    {"materials[].alphaMode", Kind::text},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].emissiveFactor", Kind::numbers, "", false, 3},
    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers, "", false, 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].extensions", Kind::object},
    {"materials[].extensions{}", Kind::object},
    {"materials[].extensions.KHR_materials_dispersion.dispersion", Kind::number, "", false, 0, 1e6},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::number, "", false, 0},
    {"materials[].extensions.KHR_materials_ior.ior", Kind::number, "", false, 0},
    {"materials[].extensions.KHR_materials_specular.specularFactor", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor", Kind::numbers, "", false, 3},
    {"materials[].extensions.KHR_materials_transmission.transmissionFactor", Kind::number},
    {"materials[].extensions.KHR_materials_volume.thicknessFactor", Kind::number, "", false, 0},
    {"materials[].extensions.KHR_materials_volume.attenuationDistance", Kind::number, "", false, 0},
    {"materials[].extensions.KHR_materials_volume.attenuationColor", Kind::numbers, "", false, 3},

    {"extensions.KHR_lights_punctual.lights", Kind::objects, "", required},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::text, "", required},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers, "", false, 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number, "", false, 0},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number, "", false, 0},
    {"extensions.KHR_lights_punctual.lights[].spot", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number, "", false, 0, 1.5707964},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number, "", false, 0, 1.5707964},
    {"extensions.KHR_materials_variants.variants", Kind::objects, "", required},
};

const Rule texture[] = {
    {"", Kind::object},
    {".index", Kind::index, "textures", required},
    {".texCoord", Kind::integer, "", false, 0, int_max},
    {".scale", Kind::number},
    {".strength", Kind::number},
    {".extensions.KHR_texture_transform", Kind::object},
    {".extensions.KHR_texture_transform.offset", Kind::numbers, "", false, 2},
    {".extensions.KHR_texture_transform.rotation", Kind::number},
    {".extensions.KHR_texture_transform.scale", Kind::numbers, "", false, 2},
    {".extensions.KHR_texture_transform.texCoord", Kind::integer, "", false, 0, int_max},
};
const char* const infos[] = {
    "pbrMetallicRoughness.baseColorTexture",
    "pbrMetallicRoughness.metallicRoughnessTexture",
    "normalTexture",
    "occlusionTexture",
    "emissiveTexture",
    "extensions.KHR_materials_specular.specularTexture",
    "extensions.KHR_materials_specular.specularColorTexture",
    "extensions.KHR_materials_transmission.transmissionTexture",
    "extensions.KHR_materials_volume.thicknessTexture",
};

}  // namespace

std::span<const Rule> header_rules() { return header; }
std::span<const Rule> document_rules() { return document; }
std::span<const Rule> texture_rules() { return texture; }
std::span<const char* const> texture_infos() { return infos; }

}  // namespace triad::gltf
