#include "io/gltf_compression.h"

#include <optional>
#include <utility>

#include "base/error.h"

namespace triad::gltf {

std::size_t add_view(nlohmann::json& document, File& file, std::vector<std::uint8_t> bytes) {
    document["buffers"].push_back({{"byteLength", bytes.size()}});
    document["bufferViews"].push_back(
        {{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    file.storage.push_back(std::move(bytes));
    file.buffers.emplace_back(file.storage.back());
    return document["bufferViews"].size() - 1;
}

Bytes bytes_of(const File& file, std::size_t buffer, std::uint64_t offset, std::uint64_t length,
               const std::string& what) {
    const std::optional<Bytes>& bytes = file.buffers[buffer];
    if (!bytes)
        throw Error(Exit::scene,
                    what + " needs " + label("buffer", buffer, "") + ", which has no uri and no data.");
    if (offset > bytes->size() || length > bytes->size() - offset)
        throw Error(Exit::scene, what + " takes bytes " + std::to_string(offset) + " to " +
                                     std::to_string(offset + length) + " of " + label("buffer", buffer, "") +
                                     ", which has " + std::to_string(bytes->size()) + ".");
    return bytes->subspan(offset, length);
}

}  // namespace triad::gltf
