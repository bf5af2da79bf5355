#pragma once
/// What all reports share, beside the JSON of device/report.h.
#include "device/report.h"
#include "scene/film.h"

namespace triad {

/// Samples per pixel: a whole number where all have the same, else their mean.
Json spp_json(const SampleNumbers& numbers);

}  // namespace triad
