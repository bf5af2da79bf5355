#pragma once
/// Pictures again, from a film or from any larger picture.
#include <string>

#include "display/resolve.h"
#include "io/io.h"
#include "session/reconstruct_request.h"

namespace triad {

/// The method, with its taps, for this film, called `name` in sentences. Throws Error(usage) for one that
/// wants other rays or other bins.
Reconstruction reconstruction_for(const Film& film, const std::string& name,
                                  const ReconstructRequest& request);

/// The same for pictures, whose pixels can be any bins. Throws Error(usage) for a way to render.
Reconstruction reconstruction_for_pictures(const ReconstructRequest& request);

/// The pixels of a picture as the bins of `method`: RGBA with associated colours, sRGB-encoded where the file
/// holds integers. Throws Error(scene) where R, G or B is missing.
BinImage bins_of(const Picture& picture, const std::string& name, const Reconstruction& method);

}  // namespace triad
