#pragma once
/// The glTF files of other people's assets.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "unit/test_assets.h"

/// Every .gltf and .glb below a folder, sorted.
inline std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb"))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}
