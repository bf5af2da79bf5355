// Choices of pilots in the cache folder.
#include "render/kept_pilot.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "own_cache.h"

namespace triad {
namespace {

DeviceInfo named(const std::string& name) {
    DeviceInfo device;
    device.platform = "a platform of the tests", device.name = name, device.driver = "1";
    return device;
}

class KeptPilot : public testing::Test {
  protected:
    const OwnCache cache;
    const DeviceInfo device = named("KeptPilot");
    std::vector<std::filesystem::path> files() const { return cache.files("pilots"); }
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
        ASSERT_EQ(files().size(), 1u);
        std::ofstream(files().front()) << text;
        EXPECT_FALSE(kept_pilot(device, "a scene")) << text;
    }
}

}  // namespace
}  // namespace triad
