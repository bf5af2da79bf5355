#pragma once
/// The only place where the host's scene becomes device structs (kernels/types.h): flattening, trees, lights,
/// textures.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/aligned_vector.h"
#include "bvh/bvh.h"
#include "kernels/types.h"
#include "pack/features.h"
#include "pack/light_tree.h"
#include "pack/settings.h"
#include "scene/scene.h"

namespace triad {

/// A spectrum that some light has.
struct PackedLightSpectrum {
    LightSpectrum spectrum;
    vec3 colour;              ///< all wavelengths together, signed, of luminance 1
    std::uint32_t index = 0;  ///< in PackedScene::spectrum; 0: nothing tells its wavelengths apart
};

/// What no eye changes: materials, textures, spectra, the environment map. Shared by the packings of a scene
/// for all eyes.
struct PackedSurfaces {
    std::vector<dev::Material> materials;
    std::vector<dev::MaterialExtensions> extensions;
    std::vector<dev::TextureUse> texture_uses;
    std::vector<dev::Texture> textures;
    AlignedVector<std::uint32_t> texels;
    std::vector<float> film_responses;               ///< where some material is iridescent
    std::vector<float> indices;                      ///< tables of bodies that disperse
    std::vector<dev::Spectrum> spectrum;             ///< before pack_wavelengths()
    std::vector<PackedLightSpectrum> light_spectra;  ///< all different
    dev::Environment environment{};                  ///< before it is a light
    std::vector<float> env_cosines;
    AlignedVector<std::uint32_t> env_texels, env_rows;
    AlignedVector<std::uint16_t> env_columns;
};

/// Whether some texture has a pyramid of means.
bool has_levels(const PackedSurfaces& surfaces);

/// A scene as kernels read it (kernels/shading/scene.h), on the host: made once, kept, and shared by all
/// devices. It is packed for an eye: near it, points are exact. Seeds, crops, sizes, bins and cameras that
/// holds_for() allows need no other packing.
struct PackedScene {
    std::string scene;        ///< hash_of() the scene
    RenderSettings settings;  ///< that it was packed for
    unsigned packings = 1;    ///< how many eyes the scene was packed for, up to this one
    dvec3 origin{
        0.0};       ///< the render origin, in world space: subtracted in double before anything becomes float
    Bounds bounds;  ///< of what is drawn, rebased
    Bounds reach;   ///< rebased: where rays may start; boxes of the trees are padded for it
    BvhRoots roots{};            ///< of the world's tree
    bool instances = false;      ///< some mesh is instanced rather than flattened
    std::size_t duplicates = 0;  ///< triangles that coincide exactly with one of a lower id, and were dropped
    int quanta_log2 = 0;         ///< fixed-point units of the film per unit of radiance
    Features facts;              ///< of the scene alone; see features_of()

    std::shared_ptr<const PackedSurfaces> surfaces = std::make_shared<PackedSurfaces>();
    BvhPool bvh;
    std::size_t first_placed_block = 0;  ///< of bvh.blocks: what is not instanced lies from here on
    AlignedVector<dev::Instance> instance_table;
    AlignedVector<dev::Triangle> triangles;
    AlignedVector<dev::Geometry> geometries;
    std::vector<BvhTriangle> emitters;  ///< while packing: in the world's tree, by rising primitive
    AlignedVector<float> normals, tangents, uvs, colours;
    std::vector<dev::Light> lights;
    std::vector<std::uint32_t> light_cdf;
    LightTree light_tree;  ///< empty where lights are few
    dev::CdfShape light_shape{};
    std::vector<dev::Spectrum> spectrum;       ///< one, or none where no path has a wavelength
    Integrator chosen = Integrator::path;      ///< never automatic; see integrator_of()
    bool photons_in_doubt = false;             ///< they were chosen, but paths alone may do better
    std::string integrator;                    ///< which one was chosen, and why: a sentence
    std::vector<dev::Caster> casters;          ///< of photons that are aimed
    std::vector<std::uint32_t> photon_lights;  ///< tree of the lights that photons come from
    dev::CdfShape photon_lights_shape{};
    dev::Environment environment{};
    /// What light can come from: every material, then every punctual light, then the environment.
    std::vector<std::string> light_sources;
    std::vector<std::uint32_t> source_of_light;  ///< of each dev::Light: its place in light_sources
};

/// Packs what `settings.view` may see of the scene. Precondition: validate(scene) was called.
/// Throws Error(scene) with "nothing to render" when nothing is drawn, Error(memory) when an index does not
/// fit. `surfaces`: of the same scene and alike settings, to be shared; null: they are packed too.
/// `formats`: of nodes that devices will walk.
PackedScene pack(const Scene& scene, const RenderSettings& settings,
                 std::shared_ptr<const PackedSurfaces> surfaces = {},
                 const BvhFormats& formats = all_bvh_formats);

/// Whether pictures with these settings may use what was packed for others: the settings that packing reads
/// are alike, and what the eye sees is as exact as a packing for itself would promise (pack/refine.h).
bool holds_for(const PackedScene& packed, const RenderSettings& settings);

/// `before` where it holds for these settings and has these formats of nodes; else a new packing, which takes
/// from `before` what no eye changes. `before`: null, or of the same scene.
std::shared_ptr<const PackedScene> pack_for(const Scene& scene, const RenderSettings& settings,
                                            std::shared_ptr<const PackedScene> before = {},
                                            BvhFormats formats = all_bvh_formats);

/// Everything of the picture that is no array.
dev::Frame frame_of(const PackedScene& packed, const RenderSettings& settings);

/// What a film of the packed scene names as its settings: text_of(settings), whether its textures have
/// levels, and the eye that the scene was packed for where it is not that of the view. Films merge only where
/// it is equal.
std::string text_of(const RenderSettings& settings, const PackedScene& packed);

/// Who brings the light: the one that was chosen for the scene, or paths, which any packing serves.
Integrator integrator_of(const PackedScene& packed, const RenderSettings& settings);

/// Photons of a sample, where no number was asked for and none was chosen: one for each pixel, 16 million at
/// most.
std::uint64_t usual_photons(const RenderSettings& settings);

/// Radius in which photons are gathered with a sample of the picture.
double photon_radius(const PackedScene& packed, const RenderSettings& settings, const dev::Frame& frame,
                     std::uint64_t sample);

/// What all photons share. Throws Error(usage) when there are more than 2^32 with a sample.
dev::PhotonFrame photon_frame_of(const PackedScene& packed, const RenderSettings& settings,
                                 const dev::Frame& frame);

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

/// What a light's spectrum makes of its colour. After pack_spectrum().
struct LightColour {
    vec3 seen{1.0f};  ///< factor of the colour, all wavelengths together
    vec3 tint{1.0f};  ///< factor that kernels find in the colour: `seen`, or 1 where `index` says the rest
    std::uint32_t index = 0;  ///< in PackedScene::spectrum
};
LightColour light_colour(const PackedSurfaces& surfaces, const std::optional<LightSpectrum>& spectrum);

/// The shares of patches of the map for every facing (types/lights.h). After the rows and columns.
std::vector<std::uint16_t> facing_shares(const PackedSurfaces& surfaces);

// Parts of pack(), one file each.
void pack_geometry(const Scene& scene, const RenderSettings& settings, PackedScene& packed);
void pack_materials(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces);
/// Mean of cos(2 pi D / wavelength) over each channel's response under D65: row i is D = FILM_STEP i nm.
std::vector<float> film_responses();
void pack_film_responses(const Scene& scene, PackedSurfaces& surfaces);
/// After pack_materials().
void pack_spectrum(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces);
void pack_environment(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces);
/// Takes over surfaces, with what lights will change of them.
void set_surfaces(PackedScene& packed, std::shared_ptr<const PackedSurfaces> surfaces);
/// After set_surfaces().
void pack_lights(const Scene& scene, PackedScene& packed);
/// What paths draw their wavelengths from, where lights have spectra. After pack_lights().
void pack_wavelengths(PackedScene& packed);
/// Decides whether photons are used, and aims them. After pack_lights().
void pack_photons(const Scene& scene, const RenderSettings& settings, PackedScene& packed);

}  // namespace triad
