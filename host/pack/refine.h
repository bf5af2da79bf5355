#pragma once
/// Triangles that are huge beside their distance to the eye, cut until they are not.
#include <vector>

#include "base/math.h"
#include "scene/scene.h"

namespace triad {

/// Edges longer than so many times their distance from the eye are halved.
constexpr double longest_edge_per_distance = 32.0;

/// Decides whether edges are halved. `reach`: the largest coordinate of the scene; edges below 2^-30 of it
/// are left alone, at the eye too.
class Cutter {
  public:
    Cutter(const dvec3& eye, double reach, double longest = longest_edge_per_distance);
    /// The same for (b, a), so that neighbours agree.
    bool cuts(const dvec3& a, const dvec3& b) const;
    /// Some edge of a triangle; a glance is enough for nearly all.
    bool cuts_any(const dvec3& a, const dvec3& b, const dvec3& c) const;

  private:
    dvec3 eye_;
    double least_, longest_;
};

/// Float places a point of a triangle within some ulp of the triangle's largest coordinate: on a plane of ten
/// kilometres that is a millimetre, even beside the eye, where rays would start centimetres above it and miss
/// what stands on it. So edges longer than longest_edge_per_distance times their distance from the eye are
/// halved, again and again; what is left errs by 1e-4 of that distance. A plane of ten kilometres a
/// centimetre away becomes some hundred triangles; ordinary scenes have none.
///
/// Whether an edge is halved depends on its ends alone, so that neighbours agree and no crack opens, and how
/// a triangle is cut on its corners alone, so that exact duplicates stay exact duplicates. Scaling by a power
/// of two changes no bit.
///
/// `positions` are those of `primitive` in the space of the eye and are continued with the new vertices, as
/// all attributes of `primitive` are; its own positions are left alone. `reach`: the largest coordinate of
/// the scene. The triangles keep their order; one that is cut is replaced by its parts.
void refine(Primitive& primitive, std::vector<dvec3>& positions, const dvec3& eye, double reach);

/// Whether refine() would cut anything, at the cost of a glance at every triangle.
bool needs_refining(const Primitive& primitive, const std::vector<dvec3>& positions, const dvec3& eye,
                    double reach);

}  // namespace triad
