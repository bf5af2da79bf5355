#pragma once
/// Pictures with less noise than their samples have (docs/denoise.md).
#include <optional>
#include <string>
#include <vector>

#include "display/resolve.h"

namespace triad {

enum class Denoiser {
    off,
    own,  ///< regression on the guides, on the device (kernels/denoise/)
    oidn  ///< Intel's Open Image Denoise, where its library is found
};
const char* name_of(Denoiser denoiser);
/// Throws Error(usage).
Denoiser denoiser_named(const std::string& name);

/// Throws Error(usage): what is done with several bins per pixel wants their noise as it is.
[[noreturn]] void refuse_to_denoise_bins();
/// Throws Error(usage) for a film that cannot be denoised: one with several bins per pixel, or one whose
/// pixels have a single sample.
void require_denoisable(const Film& film);

/// Mean scene-linear radiance of every pixel with the noise of its samples reduced; alpha as it is. Guided by
/// the film's guides where it has any, else by colours alone. Throws Error(usage) as require_denoisable(),
/// Error(unsupported) when Open Image Denoise is not found, DeviceError. `lanes`: DisplayShape::lanes of the
/// own one; none: display_shape of the device.
BinImage denoised(Device& device, const Film& film, Denoiser denoiser, std::optional<unsigned> lanes = {});

}  // namespace triad
