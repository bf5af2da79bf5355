#pragma once
#include "scene/scene.h"

namespace triad {

/// The scene of `triad render` without a file: three bars of red, green and blue glass (a triad of subpixels)
/// with metal spheres and rings on a terrazzo floor in the light of a studio. Metres; has a camera. Takes
/// some milliseconds to make.
Scene builtin_scene();

}  // namespace triad
