#pragma once
/// What a render comes to.
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "triad/image.h"

namespace triad::api {

/// A picture before exposure, tone map and reconstruction, with all that is known of it. Copies are cheap:
/// they share it, and it does not change.
///
/// Options of its pictures are those of `triad resolve` but "output": "exposure", "tonemap", "background",
/// "denoise", "bits", "half", "reconstruct", "filter", "panel" and so on. What was given to render() holds
/// unless it is given again.
class TRIAD_API Film {
  public:
    unsigned width() const;   ///< pixels, of the crop where there is one
    unsigned height() const;  ///< pixels
    double spp() const;       ///< samples per pixel: their mean where pixels differ
    /// Estimated mean of (x - r)^2 / (r^2 + 0.01), where r is the picture of endless samples; none: not
    /// known.
    std::optional<double> relmse() const;
    bool complete() const;  ///< the goal was reached: the render was not stopped by its report
    /// triad:spp, triad:device, triad:seconds, triad:settings and so on (docs/command-line.md).
    std::map<std::string, std::string> metadata() const;

    /// What an EXR file holds: scene-linear values; for a panel, or with a tone map per bin, what a display
    /// shows, linear in [0, 1].
    Image image(const Options& options = {}) const;
    /// What a PNG file holds: tone-mapped and sRGB-encoded.
    Bitmap bitmap(const Options& options = {}) const;
    /// The layers that option "aov" of render() asked for, by their names in EXR files ("albedo.R",
    /// "depth.Z"): width * height values each, row by row.
    const std::map<std::string, std::vector<float>>& layers() const;

    /// Writes pictures, each in the form that its extension asks for: .exr and .hdr (linear), .png and .jpg
    /// (tone-mapped). EXR files get the layers. Throws Error.
    void write(const std::filesystem::path& path, const Options& options = {}) const;
    void write(std::span<const std::filesystem::path> paths, const Options& options = {}) const;
    void write(std::initializer_list<std::filesystem::path> paths, const Options& options = {}) const;
    /// The bytes of such a file; `extension` is ".png", ".jpg", ".hdr" or ".exr" (without layers).
    std::vector<std::uint8_t> encode(const std::string& extension, const Options& options = {}) const;
    /// Writes a film file (docs/film.md). Throws Error(2).
    void save(const std::filesystem::path& path) const;

    struct Inside;
    explicit Film(std::shared_ptr<const Inside> inside);
    const Inside& inside() const { return *inside_; }

  private:
    std::shared_ptr<const Inside> inside_;
};

/// Reads a film file. Pictures of it are made on `device`, as option "device" names it; empty: the usual one.
/// Throws Error(2).
TRIAD_API Film load_film(const std::filesystem::path& path, const std::string& device = {});

/// Joins films of one picture with different samples, as `triad merge` does: in any order the same bits.
/// Throws Error(2) for films of different pictures, Error(6) for samples that several hold.
TRIAD_API Film merge(const std::vector<Film>& films);

}  // namespace triad::api
