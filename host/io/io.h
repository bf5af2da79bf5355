#pragma once
/// Files in and out. The only folder that includes tinygltf.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/film.h"
#include "scene/scene.h"

namespace triad {

struct GltfChoice {
    int scene = -1;       ///< -1: the file's default scene, else scene 0
    std::string variant;  ///< KHR_materials_variants, by name; empty: every primitive's own material
    /// By name or index; "none": nodes as they are; empty: the first that there is.
    std::string animation;
    double time = 0;      ///< seconds: where in the animation
    bool strict = false;  ///< damaged data are an Error(scene), where else they are mended with a warning
    /// Larger images are reduced to so many texels on their longer side; 0: none is; none: all alike as far
    /// as the memory limit demands.
    std::optional<unsigned> max_texture = 0;
    bool image_light = true;  ///< false: another environment lights the scene, its own is not decoded
};

/// What a file contained beside the scene, for `triad info` and for warnings.
struct GltfReport {
    std::vector<std::string> extensions_used, extensions_required, warnings;
    std::size_t nodes = 0, scenes = 0;
    std::vector<std::string> faults;  ///< those of the warnings that are of damaged data
    std::vector<std::string> files;   ///< that it refers to: buffers and images
    unsigned max_texture = 0;         ///< to which images were reduced; 0: none was
};

/// Reads .gltf or .glb, following the hard rules for untrusted files. Throws Error(scene) that names the
/// object at fault, Error(unsupported) that names a required extension, Error(usage) for a choice that the
/// file does not have. Warnings are returned, not printed.
Scene load_gltf(const std::filesystem::path& path, const GltfChoice& choice = {},
                GltfReport* report = nullptr);

/// .hdr or .exr, lat-long. Texels that are no radiance become 0 with a warning; `strict`: are an error.
/// Throws Error(scene).
EnvironmentMap load_environment(const std::filesystem::path& path, bool strict = false);

/// Decodes PNG, JPEG or WebP bytes to RGBA (colour profiles ignored, alpha unassociated). `name` is for
/// messages. What a decoder passed over goes to `damage`: half a sentence. Throws Error(scene).
Image decode_image(const std::string& name, const std::vector<std::uint8_t>& bytes,
                   std::string* damage = nullptr);

/// A named float channel plane of a picture, row-major.
struct Channel {
    std::string name;  ///< "R", "G", "B", "A", "albedo.R", "normal.X", "depth.Z" ...
    std::vector<float> values;
};

using Metadata = std::map<std::string, std::string>;

/// A linear (or display-linear) picture with any channels.
struct Picture {
    unsigned width = 0, height = 0;            ///< of the data
    unsigned x = 0, y = 0;                     ///< where the data lie in the full picture
    unsigned full_width = 0, full_height = 0;  ///< 0: as the data
    std::vector<Channel> channels;
    Metadata metadata;     ///< of PNG and JPEG: Triad's own
    bool encoded = false;  ///< read from integers: sRGB-encoded, alpha unassociated
    const Channel* find(const std::string& name) const;
};

/// EXR, float (or half: saturated at 65504, the number saturated is returned; depth, position and counts stay
/// float). Scanlines, ZIP; the data window is the crop, the display window the full picture. Metadata become
/// attributes of the same name: strings or double, pbrt's names with pbrt's types. Written aside and renamed.
std::size_t write_exr(const std::filesystem::path& path, const Picture& picture, bool half = false);
/// The same file as bytes, for standard output.
std::vector<std::uint8_t> encode_exr(const Picture& picture, bool half = false,
                                     std::size_t* saturated = nullptr);

/// Loads what pictures but PNG and EXR need to be written, before a long work instead of after it. Throws
/// Error(scene), Error(memory).
void load_picture_formats();

/// Encoded sRGB bytes (1, 3 or 4 channels, interleaved, 8 or 16 bits in host order, alpha linear and
/// unassociated) to .png or .jpg by extension. JPEG gets 8 bits, on black. Throws Error(usage) for another
/// extension.
struct EncodedPicture {
    unsigned width = 0, height = 0, channels = 3, bits = 8;
    std::vector<std::uint8_t> bytes;
    Metadata metadata;  ///< PNG: text chunks; JPEG: the comment
};
void write_encoded(const std::filesystem::path& path, const EncodedPicture& picture);
/// The same file as bytes; extension ".png" or ".jpg".
std::vector<std::uint8_t> encode_picture(const std::string& extension, const EncodedPicture& picture);

/// Radiance .hdr of R, G, B; what it cannot hold (negative, NaN) becomes 0.
void write_hdr(const std::filesystem::path& path, const Picture& picture);
/// The same file as bytes.
std::vector<std::uint8_t> encode_hdr(const Picture& picture);

/// Reads EXR, PNG, JPEG or HDR as float channels; integer formats are scaled to [0, 1] and stay encoded.
Picture read_picture(const std::filesystem::path& path);

/// Film files (docs/film.md): equal films give equal bytes. Written aside and renamed.
void save_film(const std::filesystem::path& path, const Film& film);
/// The same file as bytes.
std::string encode_film(const Film& film);
/// Throws Error(scene) for anything that save_film did not write: truncated, changed, of another version.
Film load_film(const std::filesystem::path& path);
/// The film without its arrays and those of its progress. Throws Error(scene).
Film load_film_header(const std::filesystem::path& path);
/// Whether the file begins as films do.
bool is_film(const std::filesystem::path& path);

/// A film that was joined into a file.
struct MergedFilm {
    Film film;           ///< without arrays
    double relmse = -1;  ///< as estimated_relmse()
};
/// merge() of film files into one, in memory for a few rows of them. Throws Error(scene) or
/// Error(incomplete), with the names of the parts that do not fit, and leaves `output` as it was.
MergedFilm merge_films(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& output);

/// What is whole of a damaged film.
struct SalvagedFilm {
    Film film;  ///< with zeros where rows are lost; its progress says which samples these want
    std::vector<std::pair<unsigned, unsigned>> lost;  ///< rows of the crop, half-open
    bool lost_progress = false;                       ///< adaptive sampling goes on from the film alone
    bool has_more = false;                            ///< bytes that belong to no film follow

    std::string damage() const;  ///< in words; empty: none
};
/// load_film, but what is damaged beyond the header is told and not thrown.
SalvagedFilm salvage_film(const std::filesystem::path& path);

}  // namespace triad
