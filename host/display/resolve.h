#pragma once
/// From the film to pixels that can be shown or saved.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/math.h"
#include "device/device.h"
#include "panel/taps.h"
#include "scene/film.h"

namespace triad {

/// The device to use now: of several that work on a picture one may fail.
using CurrentDevice = std::function<Device&()>;

/// docs/film.md names the source of each curve.
enum class ToneMap { none, khronos, aces, agx };

/// When the pipeline from bins to pixels maps tones.
enum class ToneOrder {
    per_pixel,        ///< what the taps have added up: radiance
    per_bin,          ///< every bin, so that the taps add light that a display shows
    never,            ///< scene-linear radiance goes through, negative values too; alpha is cut to [0, 1]
    per_bin_encoded,  ///< every bin, and the taps add its sRGB-encoded values
    /// per_bin, but that bins of a film which differ by noise, for lack of rays, are mapped along the tangent
    /// at their pixel's mean (kernels/subpixel/noise.h)
    noise_aware
};

/// What one work-item does of a picture: neighbouring cells, and rows with one reading of the taps. The same
/// bits from every shape.
struct DisplayShape {
    unsigned lanes = 16;  ///< 16 or 1
    unsigned rows = 1;
};

/// Vectors on a CPU; else neighbours in memory are neighbours in a work-group (docs/performance.md).
DisplayShape display_shape(const DeviceInfo& device);

/// bins -> exposure, tone map, background -> taps -> refinement -> drives, all on the device.
struct DisplaySettings {
    float exposure_ev = 0.0f;  ///< radiance is multiplied by 2^exposure_ev
    ToneMap tone_map = ToneMap::khronos;
    ToneOrder order = ToneOrder::per_bin;
    std::optional<vec3> background;  ///< display-linear; put behind what is transparent
    bool alpha = true;               ///< keep it; else what is transparent is black, or the background
    std::optional<TapTable> taps;    ///< none: the box over the bins of a pixel
    /// The bounded refinement of the drives, for its panel's taps; only where tones are mapped per bin.
    std::optional<RefineStencil> refine;
    unsigned refine_steps = 5;
    std::optional<DisplayShape> shape;  ///< none: display_shape of the device
};

/// Bins that come from a picture of any renderer.
struct BinImage {
    unsigned columns = 0, rows = 0;   ///< bins
    unsigned bins_x = 1, bins_y = 1;  ///< of a pixel; the last pixels reflect the bins they lack
    std::vector<float> rgba;          ///< [row][column][R, G, B, alpha], colour associated unless encoded
    bool encoded = false;  ///< sRGB-encoded and tone-mapped already: exposure and tone map are not applied

    unsigned width() const { return (columns + bins_x - 1) / bins_x; }  ///< pixels
    unsigned height() const { return (rows + bins_y - 1) / bins_y; }
};

/// Display-linear RGBA (ToneOrder::never: scene-linear) per pixel of the film's crop, row-major, in [0, 1],
/// colour associated with alpha. At the edges the picture goes on as its mirror image. Computed in float,
/// some rows at a time, so that no piece of device memory is larger than the device allows. Throws
/// DeviceError, Error(usage) for a tap table that does not fit the bins.
std::vector<float> resolve_display(Device& device, const Film& film, const DisplaySettings& settings);
std::vector<float> resolve_display(Device& device, const BinImage& image, const DisplaySettings& settings);

/// Scene-linear RGBA per pixel: the mean over the bins.
std::vector<float> resolve_linear(const Film& film);

/// Puts associated RGBA on an opaque display-linear colour.
void put_on_background(std::vector<float>& rgba, const vec3& colour);

/// Encodes associated display-linear RGBA with the sRGB curve, rounded to nearest, for an 8- or 16-bit
/// picture (host byte order) of 3 channels, or of 4 with colours unassociated and alpha linear.
std::vector<std::uint8_t> encode_srgb(const std::vector<float>& rgba, unsigned channels, unsigned bits);

}  // namespace triad
