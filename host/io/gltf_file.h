#pragma once
/// A glTF file, read and checked: the model that tinygltf makes of the JSON, and its bytes.
#include <tiny_gltf.h>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/gltf_json.h"
#include "io/gltf_node.h"
#include "io/io.h"

namespace triad::gltf {

/// Where an image's bytes are: in memory, or in a file that is read when the image is used.
struct ImageSource {
    std::string name;  ///< "image 3 'bark'", for messages
    Bytes bytes;
    std::filesystem::path path;  ///< not empty: there
};

/// tinygltf sees the JSON only after check_document() and without a single URI, image, buffer or node, so
/// that it opens and decodes nothing; the document's indices are all valid, and the nodes are trees.
struct File {
    tinygltf::Model model;  ///< buffers, images and nodes are left empty
    std::vector<Node> nodes;
    std::vector<std::optional<Bytes>> buffers;  ///< absent: a buffer without data, an error only when used
    std::vector<ImageSource> images;
    bool quantised = false;  ///< KHR_mesh_quantization is declared
    GltfReport report;
    std::uint64_t budget = 0;     ///< bytes that decoded geometry may still take
    std::uint64_t instances = 0;  ///< that nodes may still place

    /// One line, once.
    void warn(const std::string& sentence);
    /// The same, of damaged data (GltfReport::faults).
    void fault(const std::string& sentence);
    /// Takes `bytes` from the budget. Throws Error(scene) that names `what` when it is spent.
    void charge(std::uint64_t bytes, const std::string& what);
    /// Sees that `count` more may be placed, and takes them where that is so. Throws Error(scene).
    void charge_instances(std::uint64_t count, const std::string& what);
    /// The bytes of a buffer view. Throws Error(scene) that names `what`.
    Bytes view(int buffer_view, const std::string& what) const;

    std::vector<std::vector<std::uint8_t>> storage;  ///< what buffers and images point into
};

/// Reads, checks and parses. Throws as load_gltf.
File read_file(const std::filesystem::path& path);

/// The document alone, checked. Throws as load_gltf, but not for extensions.
nlohmann::json read_document(const std::filesystem::path& path);

/// The error with the file's name in its sentence.
Error named(const Error& error, const std::filesystem::path& path);

/// "mesh 3 'wheel'", for messages.
std::string label(const char* kind, std::size_t index, const std::string& name);

}  // namespace triad::gltf
