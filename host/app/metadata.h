#pragma once
/// What a picture says about itself: triad:* and pbrt's names (docs/command-line.md has the list).
#include "app/report.h"
#include "io/io.h"
#include "scene/film.h"

namespace triad {

/// Everything that the film knows: version, spp, relMSE, scene, settings, seed, devices, counters.
Metadata metadata_of(const Film& film);

/// Samples per pixel: a whole number where all have the same, else their mean.
Json spp_json(const SampleNumbers& numbers);

/// Whether the film was rendered without a visible background, so that its alpha means something.
bool has_alpha(const Film& film);

}  // namespace triad
