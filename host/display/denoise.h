#pragma once
/// Pictures with less noise than their samples have (docs/denoise.md).
#include <cstdint>
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

/// Throws Error(usage) for what cannot be denoised: bins with a single sample, and by Open Image Denoise
/// several bins per pixel. samples: of the pixel that has the fewest.
void require_denoisable(Denoiser denoiser, std::uint64_t bins, std::uint64_t samples);

/// Mean scene-linear radiance of every bin with the noise of its samples reduced; alpha as it is. Guided by
/// the film's guides where it has any, else by colours alone. Throws Error(usage) as require_denoisable(),
/// Error(unsupported) when Open Image Denoise is not found, DeviceError. `lanes`: DisplayShape::lanes of the
/// own one; none: display_shape of the device.
BinImage denoised(Device& device, const Film& film, Denoiser denoiser, std::optional<unsigned> lanes = {});

}  // namespace triad
