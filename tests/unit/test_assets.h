#pragma once
/// Other people's files: TRIAD_TEST_ASSETS, or ../shared/assets beside the source.
#include <cstdlib>
#include <filesystem>

inline std::filesystem::path test_assets() {
    if (const char* folder = std::getenv("TRIAD_TEST_ASSETS")) return folder;
    return std::filesystem::path(TRIAD_SOURCE_DIR) / "../shared/assets";
}
