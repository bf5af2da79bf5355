#pragma once
/// What is rendered: from a glTF file, or from arrays.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "triad/options.h"

namespace triad::api {

/// A scene in memory. Copies are cheap: they share it, and it does not change.
class TRIAD_API Scene {
  public:
    /// The built-in scene.
    Scene();

    std::string name() const;                    ///< the file's, without folders; "built-in"
    std::size_t triangles() const;               ///< of all meshes, each once
    std::size_t instances() const;               ///< how often meshes are placed
    std::vector<std::string> materials() const;  ///< their names, in order
    std::vector<std::string> cameras() const;    ///< their names, in order
    /// Least and greatest x, y and z of what is drawn, in metres. Empty where nothing is.
    std::optional<std::array<double, 6>> bounds() const;
    std::vector<std::string> warnings() const;  ///< what was mended or left out while the file was read

    struct Inside;
    explicit Scene(std::shared_ptr<const Inside> inside);
    const Inside& inside() const { return *inside_; }

  private:
    std::shared_ptr<const Inside> inside_;
};

/// Reads a .gltf or .glb file. Options: "scene", "variant", "animation", "pose-time", "strict" and
/// "max-texture". Throws Error.
TRIAD_API Scene load(const std::filesystem::path& path, const Options& options = {});

/// A picture that lies on a surface.
struct Texture {
    unsigned width = 0, height = 0;
    /// R, G, B and alpha of every texel, sRGB with alpha apart, from the top row on; kept until make_scene()
    /// has returned. (u, v) = (0, 0) is the top left corner; outside of [0, 1] the picture repeats.
    std::span<const std::uint8_t> rgba{};
};

/// As in glTF; all factors are in [0, 1] unless said.
struct Material {
    std::string name{};
    std::array<float, 4> base_colour{0.8f, 0.8f, 0.8f, 1};  ///< linear R, G, B and alpha (below 1: blended)
    std::optional<Texture> base_colour_texture{};           ///< by which base_colour is multiplied
    float metallic = 0, roughness = 1;
    std::array<float, 3> emission{0, 0, 0};  ///< radiance: linear R, G and B, not negative
    /// Share of the light that passes through the surface. With a thickness above 0 the mesh bounds a solid
    /// body that refracts; else it is a thin sheet.
    float transmission = 0;
    float thickness = 0;
    float ior = 1.5f;           ///< index of refraction, at least 1
    bool double_sided = false;  ///< its back is like its front; else its back is not seen
};

/// Triangles of one material, in metres, y up. The arrays are kept by the caller until make_scene() has
/// returned.
struct Mesh {
    std::string name{};
    std::span<const float> positions{};  ///< x, y, z of every vertex
    /// Three vertices a triangle, counter-clockwise seen from the front.
    std::span<const std::uint32_t> indices{};
    std::span<const float> normals{};  ///< x, y, z of every vertex, of any length; empty: flat faces
    std::span<const float> uvs{};      ///< u, v of every vertex; empty: no texture
    std::size_t material = 0;          ///< its place in the list of materials
    /// By columns, as in glTF.
    std::array<double, 16> to_world{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

struct Camera {
    std::array<double, 3> eye{0, 0, 5}, target{0, 0, 0}, up{0, 1, 0};
    double fov = 35;  ///< vertical angle in degrees
};

/// A scene of arrays, which are copied. Without materials all is matte grey; without a camera the scene is
/// framed. Throws Error(2) that names the mesh, material or camera at fault.
TRIAD_API Scene make_scene(std::span<const Mesh> meshes, std::span<const Material> materials = {},
                           const std::optional<Camera>& camera = {});

}  // namespace triad::api
