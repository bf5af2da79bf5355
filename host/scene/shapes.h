#pragma once
/// Generated geometry: for tests, benchmarks and the built-in scenes. Deterministic, the same on every
/// machine as far as its sine and cosine agree. Triangles are counter-clockwise seen from outside (from
/// above, from the front); shared corners are shared indices, so that neighbours have equal bits along their
/// edge.
#include <cstdint>

#include "scene/scene.h"

namespace triad::shapes {

/// Corner + a edge_u + b edge_v for a, b in [0, 1], in columns x rows cells; faces cross(edge_u, edge_v). UVs
/// are (a, b).
Primitive quad(const vec3& corner, const vec3& edge_u, const vec3& edge_v, unsigned columns = 1,
               unsigned rows = 1);

/// Twelve triangles between two corners, facing out, or in (a room).
Primitive box(const vec3& lo, const vec3& hi, bool inward = false);

/// A closed box of these half sizes around the origin whose edges and corners are rounded by `radius` in
/// `steps` steps, with exact normals. Precondition: 0 < radius <= the least half size.
Primitive rounded_box(const dvec3& half, double radius, unsigned steps);

/// A closed sphere of meridians x parallels (at least 3 x 2): poles are one vertex each. Normals are the
/// sphere's.
Primitive lat_long_sphere(const vec3& centre, float radius, unsigned meridians, unsigned parallels);

/// lat_long_sphere whose radius is scaled by 1 + amplitude * noise(frequency * direction), without normals.
Primitive displaced_sphere(const vec3& centre, float radius, unsigned meridians, unsigned parallels,
                           float amplitude, float frequency, std::uint32_t seed);

/// Around the y axis through `centre`.
Primitive torus(const vec3& centre, float major_radius, float minor_radius, unsigned around, unsigned across);

/// A height field over [-size / 2, size / 2]^2 in x and z with cells x cells cells; heights in [-height,
/// height].
Primitive terrain(float size, float height, unsigned cells, std::uint32_t seed);

/// Smooth value noise in [-1, 1], continuous, period 2^32 cells.
float value_noise(const vec3& p, std::uint32_t seed);

/// Appends the triangles and positions of `from`; other attributes stay only where both have them.
void append(Primitive& to, const Primitive& from);

}  // namespace triad::shapes
