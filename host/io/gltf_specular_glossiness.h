#pragma once
#include "scene/scene.h"

namespace triad::gltf {

/// From a texture of specular colour and glossiness, which `glossiness` multiplies, to one of roughness.
void make_roughness(Image& image, double glossiness);

}  // namespace triad::gltf
