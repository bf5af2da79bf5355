#pragma once
/// Materials, textures and images, converted when a drawn primitive first uses them.
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_file.h"

namespace triad::gltf {

/// Fills scene.materials, textures and images on demand; images are decoded together by decode_images().
class Materials {
  public:
    Materials(File& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The scene's index of this glTF material (-1: the default material).
    std::size_t use(int material);

    /// The same for points and lines, as glTF 2.0 says: without normals they are not lit and show the sum of
    /// base colour and emission. What needs a direction along the surface (normal maps, anisotropy) is left
    /// out; without normals, all that reflects.
    std::size_t use_for_strokes(int material, bool has_normals);

    /// Decodes every image in use, on all cores. `longer`: as GltfChoice::max_texture. Throws Error(scene)
    /// that names the image, Error(memory) before anything is decoded that does not fit.
    void decode_images(std::optional<unsigned> longer);

  private:
    Material convert(int material);
    std::optional<TextureUse> texture(const char* member, int index, int uv_set,
                                      const tinygltf::ExtensionMap& extensions, const std::string& what,
                                      std::optional<double> glossiness = std::nullopt);
    std::optional<TextureUse> extension_texture(const tinygltf::Value& extension, const char* member,
                                                const std::string& what,
                                                std::optional<double> glossiness = std::nullopt);
    void convert_specular_glossiness(const tinygltf::Value& extension, const std::string& what, Material& m);
    void convert_blocks(const tinygltf::ExtensionMap& extensions, const std::string& what, Material& m);
    void convert_clearcoat(const tinygltf::Value& extension, const std::string& what, Material& m);
    void convert_sheen(const tinygltf::Value& extension, const std::string& what, Material& m);
    void convert_anisotropy(const tinygltf::Value& extension, const std::string& what, Material& m);
    void convert_iridescence(const tinygltf::Value& extension, const std::string& what, Material& m);
    void convert_diffuse_transmission(const tinygltf::Value& extension, const std::string& what, Material& m);
    /// None: its image is of a format that is not read; a warning says so. `glossiness`: its factor where the
    /// image is to become one of roughness.
    std::optional<std::size_t> texture_with_sampler(int index, const std::string& what,
                                                    std::optional<double> glossiness);
    std::size_t image(int source, std::optional<double> glossiness);

    File& file_;
    Scene& scene_;
    using Derived = std::pair<int, std::optional<double>>;  ///< the file's index, and the glossiness
    std::map<int, std::size_t> materials_;
    std::map<Derived, std::size_t> textures_, images_;
    std::map<std::pair<int, bool>, std::size_t> of_strokes_;
    std::vector<Derived> image_sources_;  ///< of scene_.images
    std::set<std::size_t> colours_;       ///< of scene_.images: those that hold colours
};

}  // namespace triad::gltf
