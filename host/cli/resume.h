#pragma once
/// `triad render --resume FILM`: the words of the command that began the film, with those of the one that
/// goes on.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "session/render_request.h"

namespace triad {

/// How the command was asked for this picture and this goal: "SCENE" and "--name=value" of every option that
/// was given, but for those that say where it runs and what it writes.
std::vector<std::string> words_of_picture(const CLI::App& command);

/// The command with the options that it was given, but for those named in `without`, and with `with`; quoted
/// for a shell.
std::string command_of(const CLI::App& command, const std::vector<std::string>& without,
                       const std::vector<std::string>& with);

/// What `given` and its words ask for together with the words that the film at its resume_path keeps. Words
/// may be repeated; other goals replace its goals. `nothing_to_do`: a sentence where the film is complete and
/// no goal was given. Throws Error(usage) that names the option where they contradict, Error(scene).
RenderRequest resumed(const CLI::App& command, const RenderRequest& given, std::string& nothing_to_do);

/// The command line that goes on with the film of this one, quoted for a shell.
std::string command_that_goes_on(const CLI::App& command, const std::string& film);

}  // namespace triad
