#pragma once
/// From the film to pixels that can be shown or saved.
#include <cstdint>
#include <vector>

#include "base/math.h"
#include "device/device.h"
#include "scene/film.h"

namespace triad {

/// docs/film.md names the source of each curve.
enum class ToneMap { none, khronos, aces, agx };

struct DisplaySettings {
    float exposure_ev = 0.0f;  ///< radiance is multiplied by 2^exposure_ev
    ToneMap tone_map = ToneMap::khronos;
    bool per_bin =
        true;  ///< tone-map each bin, then average light that a display shows; else average radiance first
};

/// Display-linear RGBA per pixel of the film's crop, row-major, in [0, 1], colour associated with alpha.
/// Computed on the device in float, a slab at a time. Throws DeviceError.
std::vector<float> resolve_display(Device& device, const Film& film, const DisplaySettings& settings);

/// Scene-linear RGBA per pixel: the mean over the bins.
std::vector<float> resolve_linear(const Film& film);

/// Puts associated RGBA on an opaque display-linear colour.
void put_on_background(std::vector<float>& rgba, const vec3& colour);

/// Encodes associated display-linear RGBA with the sRGB curve, rounded to nearest, for an 8- or 16-bit
/// picture (host byte order) of 3 channels, or of 4 with colours unassociated and alpha linear.
std::vector<std::uint8_t> encode_srgb(const std::vector<float>& rgba, unsigned channels, unsigned bits);

}  // namespace triad
