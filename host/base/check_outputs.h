#pragma once
/// What is asked of output files before a long work, not after it. Outputs: paths, "-" for standard output,
/// or empty for none. Inputs: files that are read, folders of such, or empty.
#include <string>
#include <vector>

namespace triad {

/// Throws Error(usage) when two outputs are one file or one would replace an input, Error(scene) when no file
/// can be made at one of them.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// The same of these files in a folder, which is made where it is not there; an empty name is none.
void check_output_folder(const std::string& folder, const std::vector<std::string>& files,
                         const std::vector<std::string>& inputs);

/// Throws Error(scene) when a scene that is asked for is a folder. Before its outputs are checked: those in
/// the folder would be taken for files of the scene.
void refuse_folder(const std::string& scene);

/// Throws Error(usage) when an output would replace an input, whatever their names and links.
void refuse_to_replace(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace triad
