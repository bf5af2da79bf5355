#pragma once
/// --frames: one command, many pictures.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "session/render_request.h"

namespace triad {

/// "a.png" of frame 7: "a.0007.png".
std::string numbered(const std::string& path, std::uint64_t frame);

/// One frame as a picture of its own: its moment, its files, the words that ask for it alone.
RenderRequest frame_of(const RenderRequest& all, std::uint64_t frame);

/// The command that renders the frames that are left, from `frame` on; films that are there go on.
std::string command_that_goes_on(const CLI::App& command, const RenderRequest& all, std::uint64_t frame);

}  // namespace triad
