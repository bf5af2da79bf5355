#pragma once
/// All that a glTF file holds, whatever of it is rendered: for `triad info`.
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace triad {

struct GltfContents {
    struct Animation {
        std::string name;
        double seconds = 0;  ///< to its last key frame, as its accessors say
        std::size_t channels = 0;
    };
    struct Skin {
        std::string name;
        std::size_t joints = 0;
    };

    std::vector<std::string> extensions_used, extensions_required;
    std::size_t scenes = 0, nodes = 0, meshes = 0, materials = 0, textures = 0, images = 0, cameras = 0,
                lights = 0;
    std::map<std::string, std::size_t> primitives;  ///< by what they are made of: "triangles", "lines" ...
    std::size_t triangles = 0;                      ///< of all meshes, each once
    std::size_t instances = 0;                      ///< nodes with a mesh, EXT_mesh_gpu_instancing counted
    std::size_t morph_targets = 0;                  ///< of all meshes
    std::vector<Animation> animations;
    std::vector<Skin> skins;
    std::vector<std::string> variants;
};

/// Reads the document alone: no geometry, no images, and no extension makes it fail. Throws Error(scene),
/// Error(unsupported) for another version of glTF.
GltfContents gltf_contents(const std::filesystem::path& path);

}  // namespace triad
