#pragma once
/// From options by name to what Triad takes: the same descriptions as the command line's. Throws
/// Error(usage).
#include <string>

#include "session/render_request.h"
#include "triad/options.h"

namespace triad::api {

/// Those of load(). The request gets the words that a film is kept with.
void parse_load_options(const Options& options, RenderRequest& request);
/// Takes the options of load() out of `options`.
Options take_load_options(Options& options);

/// Those of render(), which are added to these words.
void parse_render_options(const Options& options, RenderRequest& request);

/// Those of pictures of a film, or of another picture.
void parse_picture_options(const Options& options, OutputStyle& style, ReconstructRequest& reconstruct);

}  // namespace triad::api
