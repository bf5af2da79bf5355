#pragma once
/// The files that captured programs were flattened from.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "device/recording.h"

namespace triad {

/// By path, as far as the programs have them: a kernel folder from which they flatten to what was captured.
std::map<std::string, std::string> include_tree(const std::vector<Recording::Source>& sources);

/// Writes the tree. Throws Error(scene).
void extract(const std::vector<Recording::Source>& sources, const std::filesystem::path& folder);

/// The programs flattened from `folder` instead, with the same options; `changed` receives the paths of
/// those that are not as captured. Throws Error.
std::vector<Recording::Source> from_folder(const std::vector<Recording::Source>& sources,
                                           const std::filesystem::path& folder,
                                           std::vector<std::string>& changed);

}  // namespace triad
