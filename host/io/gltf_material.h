#pragma once
/// Materials, textures and images, converted when a drawn primitive first uses them.
#include <cstddef>
#include <map>
#include <optional>
#include <set>

#include "io/gltf_file.h"

namespace triad::gltf {

/// Fills scene.materials, textures and images on demand; images are decoded together by decode_images().
class Materials {
  public:
    Materials(File& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The scene's index of this glTF material (-1: the default material).
    std::size_t use(int material);

    /// Decodes every image in use, on all cores. `longer`: as GltfChoice::max_texture. Throws Error(scene)
    /// that names the image, Error(unsupported) that names the extension of a format that is not read,
    /// Error(memory) before anything is decoded that does not fit.
    void decode_images(std::optional<unsigned> longer);

  private:
    Material convert(int material);
    std::optional<TextureUse> texture(const char* member, int index, int uv_set,
                                      const tinygltf::ExtensionMap& extensions, const std::string& what);
    /// None: its image is of an extension that is not supported, which a warning says.
    std::optional<std::size_t> texture_with_sampler(int index, const std::string& what);

    File& file_;
    Scene& scene_;
    std::map<int, std::size_t> materials_, textures_, images_;
    std::vector<int> image_sources_;  ///< of scene_.images
    std::set<std::size_t> colours_;   ///< of scene_.images: those that hold colours
};

/// A member of an extension that check_document() found to be a number, or its default.
double number(const tinygltf::Value& object, const char* member, double otherwise);

}  // namespace triad::gltf
