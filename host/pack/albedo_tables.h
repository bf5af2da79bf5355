#pragma once
/// Directional albedo of rough surfaces, tabulated so that the kernels can give back the energy that single
/// scattering loses. Computed at build time by tables/make_albedo_tables.cpp; layout in kernels/types.h,
/// errors in docs/shading.md.
#include <vector>

namespace triad {

/// ALBEDO_FLOATS values, to be uploaded as one buffer and given to bsdf_make.
const std::vector<float>& albedo_tables();

}  // namespace triad
