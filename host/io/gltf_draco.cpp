#include <draco/compression/decode.h>

#include <exception>
#include <memory>
#include <new>

#include "base/error.h"
#include "io/gltf_compression.h"

namespace triad::gltf {
namespace {

using nlohmann::json;

const char* const extension_name = "KHR_draco_mesh_compression";

[[noreturn]] void fail(const std::string& sentence) { throw Error(Exit::scene, sentence); }

std::unique_ptr<draco::Mesh> decoded(Bytes bytes, const std::string& what) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!result.ok()) fail(what + " is damaged: " + result.status().error_msg_string() + ".");
        return std::move(result).value();
    } catch (const std::bad_alloc&) {
        fail(what + " is damaged, or needs more memory than there is.");
    } catch (const std::length_error&) {
        fail(what + " is damaged: it announces an absurd size.");
    }
}

/// Every point's values, as the accessor wants them.
template <class T>
std::vector<std::uint8_t> values_of(const draco::PointAttribute& attribute, std::uint32_t points,
                                    unsigned components, const std::string& what) {
    std::vector<std::uint8_t> bytes(std::size_t(points) * components * sizeof(T));
    T* out = reinterpret_cast<T*>(bytes.data());
    for (std::uint32_t i = 0; i < points; ++i, out += components) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(value, static_cast<std::int8_t>(components), out))
            fail(what + " has values that do not fit its accessor.");
    }
    return bytes;
}

std::vector<std::uint8_t> values_of(const draco::PointAttribute& attribute, std::uint32_t points,
                                    int component_type, unsigned components, const std::string& what) {
    switch (component_type) {
        case 5120:
            return values_of<std::int8_t>(attribute, points, components, what);
        case 5121:
            return values_of<std::uint8_t>(attribute, points, components, what);
        case 5122:
            return values_of<std::int16_t>(attribute, points, components, what);
        case 5123:
            return values_of<std::uint16_t>(attribute, points, components, what);
        case 5125:
            return values_of<std::uint32_t>(attribute, points, components, what);
        default:
            return values_of<float>(attribute, points, components, what);
    }
}

unsigned components_of(const std::string& type) {
    return type == "SCALAR" ? 1u : type == "VEC2" ? 2u : type == "VEC3" ? 3u : type == "VEC4" ? 4u : 0u;
}

/// One primitive: new accessors of new views take the place of its own.
class CompressedPrimitive {
  public:
    CompressedPrimitive(json& document, File& file, json& primitive, std::string what)
        : document_(document), file_(file), primitive_(primitive), what_(std::move(what)) {}

    void decode() {
        const json extension = primitive_["extensions"][extension_name];
        const json& view = document_["bufferViews"][extension["bufferView"].get<std::size_t>()];
        const std::unique_ptr<draco::Mesh> mesh = decoded(
            bytes_of(file_, view["buffer"].get<std::size_t>(), view.value("byteOffset", std::uint64_t(0)),
                     view["byteLength"].get<std::uint64_t>(), what_),
            what_);
        json attributes = primitive_["attributes"];
        for (const auto& [name, id] : extension["attributes"].items()) {
            const std::string what = what_ + ": " + name.substr(0, 40);
            if (!attributes.contains(name)) fail(what + " is compressed but has no accessor.");
            attributes[name] =
                add_attribute(*mesh, id.get<std::uint32_t>(), attributes[name].get<std::size_t>(), what);
        }
        primitive_["indices"] = add_indices(*mesh);
        primitive_["attributes"] = std::move(attributes);
        primitive_["mode"] = 4;  // strips come out as triangles
    }

  private:
    std::size_t add_accessor(json accessor, std::vector<std::uint8_t> bytes) {
        accessor.erase("byteOffset");
        accessor.erase("sparse");
        accessor["bufferView"] = add_view(document_, file_, std::move(bytes));
        document_["accessors"].push_back(std::move(accessor));
        return document_["accessors"].size() - 1;
    }

    std::size_t add_attribute(const draco::Mesh& mesh, std::uint32_t id, std::size_t old,
                              const std::string& what) {
        const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
        if (!attribute) fail(what + " is not in the compressed data.");
        if (attribute->data_type() == draco::DT_BOOL)  // any byte of it would be taken for a bool
            fail(what + " is of truth values in the compressed data, which glTF does not know.");
        json accessor = document_["accessors"][old];
        const unsigned components = components_of(accessor["type"].get<std::string>());
        if (components == 0 || components != unsigned(attribute->num_components()))
            fail(what + " has " + std::to_string(int(attribute->num_components())) +
                 " components in the compressed data, which its accessor does not.");
        file_.charge(std::uint64_t(mesh.num_points()) * components * sizeof(float), what);
        accessor["count"] = mesh.num_points();
        return add_accessor(accessor, values_of(*attribute, mesh.num_points(),
                                                accessor["componentType"].get<int>(), components, what));
    }

    std::size_t add_indices(const draco::Mesh& mesh) {
        file_.charge(std::uint64_t(mesh.num_faces()) * 3 * sizeof(std::uint32_t), what_);
        std::vector<std::uint8_t> bytes(std::size_t(mesh.num_faces()) * 3 * sizeof(std::uint32_t));
        auto* out = reinterpret_cast<std::uint32_t*>(bytes.data());
        for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
            for (int corner = 0; corner < 3; ++corner)
                *out++ = mesh.face(draco::FaceIndex(i))[std::size_t(corner)].value();
        return add_accessor(
            {{"componentType", 5125}, {"count", std::size_t(mesh.num_faces()) * 3}, {"type", "SCALAR"}},
            std::move(bytes));
    }

    json& document_;
    File& file_;
    json& primitive_;
    std::string what_;
};

/// Whether all that is compressed is there uncompressed, too.
bool has_fallback(const json& document, const json& primitive) {
    const auto has_view = [&](const json& accessor) {
        return document["accessors"][accessor.get<std::size_t>()].contains("bufferView");
    };
    for (const auto& [name, accessor] : primitive["attributes"].items())
        if (!has_view(accessor)) return false;
    return !primitive.contains("indices") || has_view(primitive["indices"]);
}

}  // namespace

void decode_draco(json& document, File& file) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end()) return;
    for (std::size_t m = 0; m < meshes->size(); ++m) {
        json& primitives = (*meshes)[m]["primitives"];
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            json& primitive = primitives[i];
            if (!primitive.contains(json::json_pointer(std::string("/extensions/") + extension_name)))
                continue;
            const std::string what =
                label("mesh", m, "") + ", primitive " + std::to_string(i) + ", " + extension_name;
            try {
                CompressedPrimitive(document, file, primitive, what).decode();
            } catch (const Error& error) {
                if (!has_fallback(document, primitive)) throw;
                file.warn(std::string(error.what()) + " Its uncompressed data are used.");
            }
        }
    }
}

}  // namespace triad::gltf
