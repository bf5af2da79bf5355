#pragma once
/// The only place where the host's scene becomes device structs (kernels/types.h): flattening, trees, lights,
/// textures.
#include <optional>
#include <string>
#include <vector>

#include "bvh/bvh.h"
#include "device/device.h"
#include "kernels/types.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace triad {

/// A spectrum that some light has.
struct PackedLightSpectrum {
    LightSpectrum spectrum;
    vec3 colour;              ///< all wavelengths together, signed, of luminance 1
    std::uint32_t index = 0;  ///< in PackedScene::spectrum; 0: nothing tells its wavelengths apart
};

/// The arrays of kernels/shading/scene.h, on the host.
struct PackedScene {
    dvec3 origin{
        0.0};       ///< the render origin, in world space: subtracted in double before anything becomes float
    Bounds bounds;  ///< of what is drawn, rebased
    std::uint32_t root = 0;
    bool instances = false;      ///< some mesh is instanced rather than flattened
    std::size_t duplicates = 0;  ///< triangles that coincide exactly with one of a lower id, and were dropped
    int quanta_log2 = 0;         ///< fixed-point units of the film per unit of radiance

    BvhPool bvh;
    std::vector<dev::Instance> instance_table;
    std::vector<dev::Triangle> triangles;
    std::vector<dev::Geometry> geometries;
    std::vector<BvhTriangle> flattened;  ///< of the world's tree, by rising primitive; for the lights
    std::vector<float> normals, tangents, uvs, colours;
    std::vector<dev::Material> materials;
    std::vector<dev::TextureUse> texture_uses;
    std::vector<dev::Texture> textures;
    std::vector<std::uint32_t> texels;
    std::vector<dev::Light> lights;
    std::vector<std::uint32_t> light_cdf;
    std::vector<float> env_cosines;
    std::vector<std::uint32_t> env_texels, env_rows;
    std::vector<std::uint16_t> env_columns;
    std::vector<dev::Spectrum> spectrum;  ///< one, or none where no path has a wavelength
    std::vector<float> indices;           ///< tables of bodies that disperse
    dev::CdfShape light_shape{};
    Integrator chosen = Integrator::path;      ///< never automatic
    std::vector<dev::Caster> casters;          ///< of photons that are aimed
    std::vector<std::uint32_t> photon_lights;  ///< tree of the lights that photons come from
    dev::CdfShape photon_lights_shape{};
    std::string integrator;  ///< which one was chosen, and why: a sentence
    dev::Environment environment{};
    std::vector<PackedLightSpectrum> light_spectra;  ///< all different
};

/// Packs what `settings.view` may see of the scene. Precondition: validate(scene) was called.
/// Throws Error(scene) with "nothing to render" when nothing is drawn, Error(memory) when an index does not
/// fit.
PackedScene pack(const Scene& scene, const RenderSettings& settings);

/// Everything of the picture that is no array.
dev::Frame frame_of(const PackedScene& packed, const RenderSettings& settings);

/// Radius in which photons are gathered with a sample of the picture.
double photon_radius(const PackedScene& packed, const RenderSettings& settings, const dev::Frame& frame,
                     std::uint64_t sample);

/// What all photons share. Throws Error(usage) when there are more than 2^32 with a sample.
dev::PhotonFrame photon_frame_of(const PackedScene& packed, const RenderSettings& settings,
                                 const dev::Frame& frame);

/// A photon map on the device; empty where nothing is gathered.
struct PhotonMapBuffers {
    Buffer map, photons, ends;
};

/// The packed arrays on a device, in the order of SCENE_PARAMETERS.
struct DeviceScene {
    Arguments arguments;
    Buffer frame;  ///< the first of them: one dev::Frame
    std::uint64_t bytes = 0;
};
DeviceScene upload(Device& device, const PackedScene& packed, const RenderSettings& settings,
                   const PhotonMapBuffers& photon_map = {});

/// Bounds of a CDF over weights in units of 2^-32: size + 1 values, first 0, last 2^32 - 1, rising; an entry
/// of weight zero has an empty interval, any other one at least a unit. All weights zero: every interval but
/// the last is empty.
std::vector<std::uint32_t> integer_cdf(std::span<const double> weights);

/// The layout of a tree over n intervals; throws Error(memory) when n is beyond 8^CDF_LEVELS.
dev::CdfShape cdf_shape(std::size_t n);
/// Writes the tree of integer_cdf()'s bounds to out[0, shape.size).
void write_cdf_tree(const dev::CdfShape& shape, std::span<const std::uint32_t> bounds, std::uint32_t* out);

/// The layout of the trees over the columns of a map; throws Error(scene) when it is wider than
/// COLUMNS_FANOUT^COLUMNS_LEVELS.
dev::ColumnsShape columns_shape(std::size_t width, std::size_t height);
/// Bounds of the columns of a row in shares of 1 / 65536: one for each column, the others by weight (the
/// share of the uniform part grows with the width: 1.6 % at 1024 columns, 12.5 % at 8192). Size + 1 values,
/// first 0, last 65536.
std::vector<std::uint32_t> column_shares(std::span<const double> weights);
/// Writes the tree of a row; `out` is of shape.size, filled with 0xffff before the first.
void write_columns(const dev::ColumnsShape& shape, std::size_t row, std::span<const std::uint32_t> bounds,
                   std::uint16_t* out);

/// The sRGB transfer function's inverse (IEC 61966-2-1).
double srgb_decode(double encoded);

/// What a light's spectrum makes of its colour. After pack_spectrum().
struct LightColour {
    vec3 seen{1.0f};  ///< factor of the colour, all wavelengths together
    vec3 tint{1.0f};  ///< factor that kernels find in the colour: `seen`, or 1 where `index` says the rest
    std::uint32_t index = 0;  ///< in PackedScene::spectrum
};
LightColour light_colour(const PackedScene& packed, const std::optional<LightSpectrum>& spectrum);

// Parts of pack(), one file each.
void pack_geometry(const Scene& scene, const RenderSettings& settings, PackedScene& packed);
void pack_materials(const Scene& scene, PackedScene& packed);
/// After pack_materials().
void pack_spectrum(const Scene& scene, const RenderSettings& settings, PackedScene& packed);
/// What paths draw their wavelengths from, where lights have spectra. After pack_lights().
void pack_wavelengths(PackedScene& packed);
void pack_lights(const Scene& scene, PackedScene& packed);
void pack_environment(const Scene& scene, const RenderSettings& settings, PackedScene& packed);
/// Decides whether photons are used, and aims them. After pack_lights().
void pack_photons(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

}  // namespace triad
