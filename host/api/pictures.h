#pragma once
/// Between the pictures of files and those of the library.
#include "io/io.h"
#include "triad/image.h"

namespace triad::api {

/// R, G, B, and A where there is one. Throws triad::Error(scene) where one of the three is missing.
Image image_of(const Picture& picture, const std::string& name = "The picture");

/// Throws triad::Error(usage) that names `what` where the values are not as many as the size says.
Picture picture_of(const Image& image, const std::string& what);

}  // namespace triad::api
