#pragma once
/// How many photons come with a sample of the picture, where that is Triad's choice.
#include "pack/settings.h"
#include "render/renderer.h"

namespace triad {

/// The number, relative to one for each pixel, at which the error falls fastest for the work: of the powers
/// of two from 1/64 to 1. `paths` and `photons` are relative variances of a sample with one photon for each
/// pixel, by what brought the light; `rays_per_pixel` are those of its paths.
double best_photon_share(double paths, double photons, double rays_per_pixel);

/// The settings with RenderSettings::photons set by a pilot, where Integrator::automatic chose photons and no
/// number was asked for; else as they are. The pilot is a small picture of the whole view, with a seed and
/// samples of its own: it depends on scene, view and size alone, so that crops, ranges and seeds of a picture
/// have the same number. Devices count by the same rays; where rounding differs in the last bit the number
/// could, and a film names it.
RenderSettings with_photon_count(const DeviceScenes& scenes, const RenderSettings& settings);

}  // namespace triad
