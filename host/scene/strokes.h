#pragma once
/// Points and lines, which have no surface, as one that faces the eye.
#include "scene/scene.h"
#include "scene/view.h"

namespace triad {

bool has_strokes(const Scene& scene);

/// Placed in the world.
std::vector<dvec3> ends_of_strokes(const Scene& scene);

/// Every stroke becomes a ribbon with a round cap at each end, a point such a cap alone, `pixels` wide in a
/// picture of `height` rows from this view, whatever its distance; strokes are then no more, but for
/// Scene::stroke_ends. Flat and turned
/// to the eye: that costs a sixth of the triangles of tubes and spheres, keeps the width in the picture, and
/// lets the author's normals decide the shading. They stand before what they are drawn on by half their
/// width. Each placed mesh with strokes gets one more, placed near to where it is.
void draw_strokes(Scene& scene, const View& view, unsigned height, double pixels);

}  // namespace triad
