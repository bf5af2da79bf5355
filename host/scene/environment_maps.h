#pragma once
/// Environment maps from other descriptions of what is seen in every direction.
#include <array>
#include <vector>

#include "base/math.h"
#include "scene/scene.h"

namespace triad {

/// Six square pictures around one point, as seen from there, in the order +x, -x, +y, -y, +z, -z. Up in them
/// is +y; above, what is down in them is +z, and below it is -z, so that each goes on in those beside it.
struct CubeMap {
    unsigned size = 0;                        ///< texels along an edge
    std::array<std::vector<float>, 6> faces;  ///< R, G, B of linear radiance, row 0 at the top
};

/// The longest row of maps made here, in texels.
inline constexpr unsigned most_columns = 8192;

/// How many columns the map of a cube of this size gets; it has half as many rows. As fine as the cube where
/// it is finest, and no coarser than a gradient between large texels asks for.
unsigned columns_for(unsigned cube_size);

/// The cube map, turned by this unit quaternion, bilinear across its edges too.
EnvironmentMap environment_of(const CubeMap& cube, const dquat& rotation);

/// Irradiance by direction of the normal, in real spherical harmonics: Y00; Y1-1, Y10, Y11 (along y, z, x);
/// Y2-2, Y2-1, Y20, Y21, Y22.
using IrradianceHarmonics = std::array<dvec3, 9>;

/// A radiance that gives this irradiance, where it is not negative: it is taken as 0 there.
EnvironmentMap environment_of(const IrradianceHarmonics& irradiance, const dquat& rotation);

}  // namespace triad
