#include <meshoptimizer.h>

#include "base/error.h"
#include "io/gltf_compression.h"

namespace triad::gltf {
namespace {

using nlohmann::json;

/// What the extension says of a view.
struct Compressed {
    std::string mode, filter;
    std::uint64_t count = 0, stride = 0;
    Bytes bytes;
};

/// What glTF allows; the library takes it for granted.
void check_shape(const Compressed& c, std::uint64_t length, const std::string& what) {
    const auto fail = [&](const std::string& why) { throw Error(Exit::scene, what + " " + why + "."); };
    const bool attributes = c.mode == "ATTRIBUTES", triangles = c.mode == "TRIANGLES";
    if (!attributes && !triangles && c.mode != "INDICES") fail("has the unknown mode '" + c.mode + "'");
    if (attributes ? c.stride % 4 != 0 || c.stride == 0 : c.stride != 2 && c.stride != 4)
        fail("has a byteStride of " + std::to_string(c.stride) + ", which " + c.mode + " cannot have");
    if (triangles && c.count % 3 != 0)
        fail("has " + std::to_string(c.count) + " indices, no multiple of three");
    if (c.count * c.stride > length)
        fail("decodes to " + std::to_string(c.count * c.stride) + " bytes, but its bufferView has " +
             std::to_string(length));
    if (!attributes && c.filter != "NONE") fail("has a filter, which only ATTRIBUTES can have");
    if (c.filter == "OCTAHEDRAL" ? c.stride != 4 && c.stride != 8 : c.filter == "QUATERNION" && c.stride != 8)
        fail("has a byteStride of " + std::to_string(c.stride) + ", which the filter " + c.filter +
             " cannot have");
}

/// The header of every stream names its codec and version.
void check_version(const Compressed& c, const std::string& what) {
    const unsigned head = c.bytes.empty() ? 0u : c.bytes[0];
    const unsigned codec = c.mode == "ATTRIBUTES" ? 0xa0 : c.mode == "TRIANGLES" ? 0xe0 : 0xd0;
    const unsigned last = c.mode == "ATTRIBUTES" ? 0 : 1;
    if ((head & 0xf0u) == codec && (head & 0x0fu) > last)
        throw Error(Exit::unsupported,
                    what + " is encoded in version " + std::to_string(head & 0x0fu) +
                        " of its format, which is not supported; compress it with EXT_meshopt_compression.");
    if (c.filter != "NONE" && c.filter != "OCTAHEDRAL" && c.filter != "QUATERNION" &&
        c.filter != "EXPONENTIAL")
        throw Error(Exit::unsupported,
                    what + " has the filter '" + c.filter.substr(0, 40) + "', which is not supported.");
}

std::vector<std::uint8_t> decoded(const Compressed& c, std::uint64_t length, const std::string& what) {
    std::vector<std::uint8_t> out(length);
    int failed = 0;
    if (c.mode == "ATTRIBUTES")
        failed = meshopt_decodeVertexBuffer(out.data(), c.count, c.stride, c.bytes.data(), c.bytes.size());
    else if (c.mode == "TRIANGLES")
        failed = meshopt_decodeIndexBuffer(out.data(), c.count, c.stride, c.bytes.data(), c.bytes.size());
    else
        failed = meshopt_decodeIndexSequence(out.data(), c.count, c.stride, c.bytes.data(), c.bytes.size());
    if (failed != 0) throw Error(Exit::scene, what + " is damaged: it cannot be decoded.");
    if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), c.count, c.stride);
    if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), c.count, c.stride);
    if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), c.count, c.stride);
    return out;
}

void decode_view(json& document, File& file, json& view, const json& extension, const std::string& what) {
    const auto length = view["byteLength"].get<std::uint64_t>();
    Compressed c{extension["mode"].get<std::string>(), extension.value("filter", "NONE"),
                 extension["count"].get<std::uint64_t>(), extension["byteStride"].get<std::uint64_t>(),
                 bytes_of(file, extension["buffer"].get<std::size_t>(),
                          extension.value("byteOffset", std::uint64_t(0)),
                          extension["byteLength"].get<std::uint64_t>(), what)};
    check_version(c, what);
    check_shape(c, length, what);
    file.charge(length, what);
    document["buffers"].push_back({{"byteLength", length}});
    file.storage.push_back(decoded(c, length, what));
    file.buffers.emplace_back(file.storage.back());
    view["buffer"] = file.buffers.size() - 1;
    view["byteOffset"] = 0;
}

}  // namespace

void decode_meshopt(json& document, File& file) {
    const auto views = document.find("bufferViews");
    if (views == document.end()) return;
    for (std::size_t i = 0; i < views->size(); ++i) {
        json& view = (*views)[i];
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            if (!view.contains(json::json_pointer(std::string("/extensions/") + name))) continue;
            const json extension = view["extensions"][name];
            const std::string what = label("bufferView", i, "") + ", " + name;
            try {
                decode_view(document, file, view, extension, what);
            } catch (const Error& error) {
                if (!file.buffers[view["buffer"].get<std::size_t>()]) throw;
                file.warn(std::string(error.what()) + " Its uncompressed data are used.");
            }
            break;
        }
    }
}

}  // namespace triad::gltf
