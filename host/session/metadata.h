#pragma once
/// What a picture says about itself: triad:* and pbrt's names (docs/command-line.md has the list).
#include <cstdint>
#include <string>

#include "display/denoise.h"
#include "display/reconstruction.h"
#include "io/io.h"
#include "scene/film.h"

namespace triad {

/// Everything that the film knows: version, spp, relMSE, scene, settings, seed, devices, counters.
Metadata metadata_of(const Film& film);

/// Adds how the picture was reconstructed: triad:reconstruct, triad:filter, and triad:panel and triad:ppd
/// where it is for a panel.
void describe(const Reconstruction& method, Metadata& metadata);

/// Says that the picture was denoised, and takes back the errors of its samples, which are not its own.
void describe(Denoiser denoiser, Metadata& metadata);

/// Throws Error(usage) where a picture is for a panel: its values are the drives of that panel's emitters,
/// and `purpose` ("compare", "denoise" ...) would take them for colours of pixels.
void refuse_for_panel(const std::string& path, const Metadata& metadata, const std::string& purpose);

/// Memory that the film takes, on the host and again on the device.
std::uint64_t film_bytes(const Film& film);

/// Whether its rays started by a pixel filter, so that its bins are no means over places of their own.
bool has_filtered_rays(const Film& film);

/// Whether the film was rendered without a visible background, so that its alpha means something.
bool has_alpha(const Film& film);

}  // namespace triad
