#pragma once
/// Tables by which camera rays start where a pixel filter is large (kernels/shading/ray_filter.h).
#include <vector>

#include "kernels/types.h"
#include "pack/settings.h"

namespace triad {

/// The tables of settings.ray_filter; empty unless settings.ray_start is RayStart::filter. Throws
/// Error(usage) for bins that are neither one nor three per pixel, and for a filter that is 0 everywhere.
std::vector<float> ray_filter_tables(const RenderSettings& settings);
dev::RayFilterShape ray_filter_shape(const RenderSettings& settings);

}  // namespace triad
