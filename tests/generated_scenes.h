#pragma once
/// The scenes of scenes/hard/, written when they are asked for.
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace triad::hard {

/// Why generated scenes are not to be had; empty: they are.
inline std::string why_no_scenes() {
    if (std::string(TRIAD_PYTHON).empty())
        return "The hard scenes are generated, and no python3 with numpy was found: install python3-numpy.";
    return {};
}

/// The folder of generated files, in which `name`, or all for an empty name, has just been written.
inline std::filesystem::path generated(const std::string& name) {
    const std::string command = "'" TRIAD_PYTHON "' '" TRIAD_SOURCE_DIR
                                "/scenes/hard/generate.py' --out '" TRIAD_HARD_FOLDER "' " +
                                (name.empty() ? "" : "'" + name + "'");
    if (std::system(command.c_str()) != 0) throw std::runtime_error("This failed: " + command);
    return TRIAD_HARD_FOLDER;
}

}  // namespace triad::hard
