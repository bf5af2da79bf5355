#pragma once
/// The scene as plain data: no file format, no device. Spaces and units follow glTF: right-handed, y up,
/// metres, nits, candela, lux; colours are linear Rec.709 unless a texture is marked sRGB. Row 0 of an image
/// is its top row.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "scene/glass.h"
#include "scene/light_spectrum.h"

namespace triad {

enum class Wrap { repeat, mirror, clamp };

/// RGBA, 8 or 16 bits per channel, unassociated alpha.
struct Image {
    std::string name;
    unsigned width = 0, height = 0;
    unsigned bits = 8;                 ///< 8 or 16
    std::vector<std::uint8_t> texels;  ///< width * height * 4 * bits / 8 bytes, 16-bit in host order
};

/// An image with a sampler.
struct Texture {
    std::size_t image = 0;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool linear = true;
};

/// A texture as a material uses it. (u', v') = transform * (u, v, 1), rows in order (KHR_texture_transform
/// applied).
struct TextureUse {
    std::size_t texture = 0;
    unsigned uv_set = 0;  ///< 0 or 1
    std::array<float, 6> transform{1, 0, 0, 0, 1, 0};
};

/// Of a body among others: see Material::priority.
inline constexpr unsigned most_priority = 255;

enum class AlphaMode { opaque, mask, blend };

/// KHR_materials_clearcoat: a varnish of index 1.5 over everything else.
struct Clearcoat {
    float factor = 0.0f, roughness = 0.0f;  ///< in [0, 1], factor above 0
    float normal_scale = 1.0f;
    std::optional<TextureUse> texture;            ///< R
    std::optional<TextureUse> roughness_texture;  ///< G
    std::optional<TextureUse> normal_texture;     ///< none: the vertices' normal
};

/// KHR_materials_sheen: fibres over the base, under the varnish.
struct Sheen {
    vec3 colour{0.0f};  ///< in [0, 1], not black
    float roughness = 0.0f;
    std::optional<TextureUse> colour_texture;     ///< sRGB
    std::optional<TextureUse> roughness_texture;  ///< A
};

/// KHR_materials_anisotropy.
struct Anisotropy {
    float strength = 0.0f;              ///< in [0, 1], above 0
    float rotation = 0.0f;              ///< radians, from the tangent towards the bitangent
    std::optional<TextureUse> texture;  ///< RG: direction; B: strength
};

/// KHR_materials_iridescence: a thin film over the base. Thicknesses in nm.
struct Iridescence {
    float factor = 0.0f;  ///< in [0, 1], above 0
    float ior = 1.3f;     ///< of the film, at least 1
    float thickness_minimum = 100.0f, thickness_maximum = 400.0f;
    std::optional<TextureUse> texture;            ///< R
    std::optional<TextureUse> thickness_texture;  ///< G, from minimum to maximum; none: the maximum
};

/// KHR_materials_diffuse_transmission: a share of the Lambert base leaves on the other side, in this colour.
struct DiffuseTransmission {
    float factor = 0.0f;                       ///< in [0, 1], above 0
    vec3 colour{1.0f};                         ///< in [0, 1]
    std::optional<TextureUse> texture;         ///< A
    std::optional<TextureUse> colour_texture;  ///< sRGB
};

/// glTF metallic-roughness and the KHR extensions of docs/conventions.md. Colour textures are decoded from
/// sRGB (base_colour, emission, specular_colour and those marked so); the others are linear data.
struct Material {
    std::string name;
    vec4 base_colour{1.0f};
    float metallic = 1.0f, roughness = 1.0f;
    vec3 emission{0.0f};  ///< emissiveFactor * emissiveStrength
    float normal_scale = 1.0f;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    float ior = 1.5f;  ///< >= 1, or 0: Fresnel is 1 (KHR_materials_ior)
    float specular = 1.0f;
    vec3 specular_colour{1.0f};
    float transmission = 0.0f;
    float thickness = 0.0f;                ///< > 0: the mesh is the surface of a solid body
    std::optional<Dispersion> dispersion;  ///< of a solid body; `ior` is then its index at the d line
    /// Where bodies overlap, the one of the highest priority is there; of equal ones the one entered last.
    unsigned priority = 0;
    vec3 attenuation_colour{1.0f};  ///< what is left of white light after attenuation_distance
    float attenuation_distance = std::numeric_limits<float>::infinity();
    std::optional<TextureUse> base_colour_texture;         ///< sRGB, alpha linear
    std::optional<TextureUse> metallic_roughness_texture;  ///< G roughness, B metallic
    std::optional<TextureUse> normal_texture;
    std::optional<TextureUse> emission_texture;         ///< sRGB
    std::optional<TextureUse> specular_texture;         ///< A
    std::optional<TextureUse> specular_colour_texture;  ///< sRGB
    std::optional<TextureUse> transmission_texture;     ///< R
    std::optional<LightSpectrum> emission_spectrum;     ///< of which `emission` is the tint; none: D65
    // Each of these is there only where it does something.
    std::optional<Clearcoat> clearcoat;
    std::optional<Sheen> sheen;
    std::optional<Anisotropy> anisotropy;
    std::optional<Iridescence> iridescence;
    std::optional<DiffuseTransmission> diffuse_transmission;
};

/// Whether it is the boundary of a closed body with an inside that absorbs: a volume with a thickness that
/// light gets into, refracted or diffusely.
bool is_solid(const Material& material);

/// Every texture that the material uses.
std::vector<const TextureUse*> texture_uses_of(const Material& material);
/// Those of them that hold colours.
std::vector<const TextureUse*> colour_uses_of(const Material& material);

/// Triangles with one material. Optional attributes are empty or as long as positions.
struct Primitive {
    std::vector<vec3> positions;
    std::vector<vec3> normals;   ///< unit; empty: flat shading
    std::vector<vec4> tangents;  ///< xyz unit, w = +-1
    std::vector<vec2> uvs[2];
    std::vector<vec4> colours;
    std::vector<uvec3> triangles;  ///< corners, counter-clockwise seen from the front
    std::vector<uvec2> strokes;    ///< ends of thin lines; points where both are one. See strokes.h
    std::size_t material = 0;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

struct MeshInstance {
    std::string name;
    std::size_t mesh = 0;
    dmat4 to_world{
        1.0};  ///< invertible; a negative determinant mirrors (the front stays the front, as glTF says)
    bool is_drawn_strokes = false;  ///< ribbons that draw_strokes() made
    bool is_ground = false;         ///< what stand_on_ground() added: no part of what is framed
};

/// KHR_lights_punctual, placed. colour includes intensity: candela (point, spot) or lux (directional).
struct PunctualLight {
    enum class Type { point, spot, directional } type = Type::point;
    std::string name;
    dvec3 position{0.0};
    dvec3 direction{0.0, 0.0, -1.0};  ///< unit, where the light goes
    vec3 colour{1.0f};
    float range = 0.0f;  ///< 0: no limit
    float inner_cone = 0.0f, outer_cone = 0.7853981634f;
    std::optional<LightSpectrum> spectrum;  ///< of which `colour` is the tint; none: D65
};

/// A glTF camera, placed: looks along -z of to_world, y up.
struct SceneCamera {
    std::string name;
    bool orthographic = false;
    double yfov = 0.8;         ///< perspective: vertical angle, radians
    double aspect = 0.0;       ///< width / height the file asks for; 0: that of the picture
    dvec2 magnification{1.0};  ///< orthographic: half width, half height
    dmat4 to_world{1.0};       ///< rotation and translation only
};

/// Lat-long radiance map, RGB float, row 0 = up (+y); see Environment in kernels/types.h for the mapping.
struct EnvironmentMap {
    unsigned width = 0, height = 0;
    std::vector<float> rgb;
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;  ///< never empty when there are meshes
    std::vector<Mesh> meshes;
    std::vector<MeshInstance> instances;
    std::vector<PunctualLight> lights;
    std::vector<SceneCamera> cameras;
    /// In the world, of strokes that are drawn as ribbons now: a picture is framed around these ends, since
    /// ribbons are as wide as its view makes them.
    std::vector<dvec3> stroke_ends;
    std::optional<EnvironmentMap> environment;
    vec3 sky{0.0f};  ///< radiance from everywhere when there is no environment map
};

/// World bounds of everything that is drawn.
Bounds bounds_of(const Scene& scene);

/// What the attributes and triangles of a primitive take on the host.
std::uint64_t bytes_of(const Primitive& primitive);
/// What the scene takes on the host: geometry, materials, images, the map around it, placements.
std::uint64_t bytes_of(const Scene& scene);

/// Checks every invariant above (indices, lengths, finite numbers, ranges). Throws Error(scene) that names
/// the object. Also drops what cannot be drawn (triangles without area or with non-finite corners) and
/// returns how many.
std::size_t validate(Scene& scene);

/// The name of the scene's content: equal scenes, equal text (32 hex digits).
std::string hash_of(const Scene& scene);

}  // namespace triad
