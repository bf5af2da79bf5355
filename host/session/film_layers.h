#pragma once
/// What a film gets besides its colours.
#include <vector>

#include "io/io.h"
#include "render/renderer.h"
#include "session/render_request.h"

namespace triad {

/// What denoisers are guided by.
void add_guides(Renderer& renderer, Film& film);

/// The planes of --aov, as EXR channels.
std::vector<Channel> layers_of(const RenderRequest& request, Renderer& renderer, const Film& film);

}  // namespace triad
