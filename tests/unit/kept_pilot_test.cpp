// Choices of pilots in the cache folder.
#include "render/kept_pilot.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace triad {
namespace {

DeviceInfo named(const std::string& name) {
    DeviceInfo device;
    device.platform = "a platform of the tests", device.name = name, device.driver = "1";
    return device;
}

/// Removes what the tests have kept.
class KeptPilot : public testing::Test {
  protected:
    const DeviceInfo device = named("KeptPilot");
    const std::filesystem::path folder = kept_path(device, "pilots").parent_path();
    std::set<std::filesystem::path> before = files();

    std::set<std::filesystem::path> files() const {
        std::set<std::filesystem::path> found;
        if (std::filesystem::exists(folder))
            for (const auto& entry : std::filesystem::directory_iterator(folder)) found.insert(entry.path());
        return found;
    }
    std::set<std::filesystem::path> added() const {
        std::set<std::filesystem::path> found;
        for (const auto& path : files())
            if (!before.contains(path)) found.insert(path);
        return found;
    }
    void TearDown() override {
        for (const auto& path : added()) std::filesystem::remove(path);
    }
};

TEST_F(KeptPilot, is_found_by_all_that_it_follows_from) {
    EXPECT_FALSE(kept_pilot(device, "a scene"));
    keep_pilot(device, "a scene", {false, 77});
    keep_pilot(device, "another scene", {true, 0});
    ASSERT_TRUE(kept_pilot(device, "a scene"));
    EXPECT_EQ(kept_pilot(device, "a scene")->photons, 77u);
    EXPECT_FALSE(kept_pilot(device, "a scene")->paths);
    ASSERT_TRUE(kept_pilot(device, "another scene"));
    EXPECT_TRUE(kept_pilot(device, "another scene")->paths);
    EXPECT_FALSE(kept_pilot(named("another device"), "a scene"));
}

TEST_F(KeptPilot, what_is_damaged_is_not_there) {
    for (const std::string text :
         {"", "{", "[]", "{}", R"({"schema": "triad.pilot/0", "paths": false, "photons": 3})",
          R"({"schema": "triad.pilot/1", "paths": true, "photons": 3})",
          R"({"schema": "triad.pilot/1", "paths": false, "photons": "many"})"}) {
        keep_pilot(device, "a scene", {false, 77});
        ASSERT_EQ(added().size(), 1u);
        std::ofstream(*added().begin()) << text;
        EXPECT_FALSE(kept_pilot(device, "a scene")) << text;
    }
}

}  // namespace
}  // namespace triad
