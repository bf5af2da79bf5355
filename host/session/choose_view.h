#pragma once
/// Which view and which light a render gets, from what the scene holds and what was asked for.
#include "scene/scene.h"
#include "scene/view.h"
#include "session/render_request.h"

namespace triad {

/// The camera of that name or index; an empty choice takes the first. Null when the scene has none and none
/// was asked for. Throws Error(usage) that lists the cameras there are.
const SceneCamera* choose_camera(const Scene& scene, const std::string& choice);

/// --size, or 720 rows in the aspect of the camera, or 1280x720.
uvec2 choose_size(const RenderRequest& options, const SceneCamera* camera);

/// --look-at, else the camera, else the scene framed; then --fov, --aperture and --focus.
/// Throws Error(scene) "nothing to render" when there is nothing to frame.
View choose_view(const RenderRequest& options, const Scene& scene, const SceneCamera* camera, uvec2 size);

/// Whether anything in the scene gives light, or nothing needs any: all is unlit.
bool has_light(const Scene& scene);

}  // namespace triad
