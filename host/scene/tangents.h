#pragma once
/// Tangent frames for normal maps.
#include <vector>

#include "scene/scene.h"

namespace triad {

/// Gives every corner its own vertex with the normal of its triangle.
void make_flat(Primitive& primitive);

/// Fills primitive.tangents as MikkTSpace does (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited",
/// 2008, and its reference code with the default angular threshold of 180 degrees), which glTF prescribes:
/// corners that agree in position, normal and uv, in triangles joined by edges and of one orientation in uv,
/// share one tangent, an angle-weighted mean over those triangles. Vertices are split where tangents differ,
/// so the result does not depend on how the mesh was welded. `uvs`: per vertex, as the normal map is sampled;
/// v runs down, as in glTF, and w is such that cross(normal, tangent) * w points to smaller v. Normals must
/// be present.
void generate_tangents(Primitive& primitive, const std::vector<vec2>& uvs);

}  // namespace triad
