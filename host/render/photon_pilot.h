#pragma once
/// Whether photons are traced, and how many with a sample of the picture, where that is Triad's choice.
#include "pack/settings.h"
#include "render/renderer.h"

namespace triad {

/// The number, relative to one for each pixel, at which the error falls fastest for the work: of the powers
/// of two from 1/64 to 1. `paths` and `photons` are relative variances of a sample with one photon for each
/// pixel, by what brought the light; `rays_per_pixel` are those of its paths.
double best_photon_share(double paths, double photons, double rays_per_pixel);

/// Whether two films of the same size, each with samples in both halves, differ in blocks of pixels by no
/// more than their noise. Paths that have not found a caustic look good, but do not agree with photons.
bool agree(const Film& a, const Film& b);

/// Where Integrator::automatic chose photons (integrator_of()) and no number was asked for: the settings with
/// RenderSettings::photons set by a pilot, or with Integrator::path where the packing left the choice open
/// (PackedScene::photons_in_doubt) and paths alone reach an error in less work. Else the settings as they
/// are. The pilot is a small picture of the whole view, with a seed and samples of its own: it depends on
/// scene, view and size alone, so that crops, ranges and seeds of a picture have the same choice. Devices
/// count by the same rays; where rounding differs in the last bit the choice could, and a film names it. What
/// was chosen is kept (kept_pilot.h).
RenderSettings with_photon_pilot(const DeviceScenes& scenes, const RenderSettings& settings);

}  // namespace triad
