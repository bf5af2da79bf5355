// What the fuzz targets found once, and their seeds: each is answered, by any compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/files.h"
#include "fuzz/targets/target.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

std::vector<fs::path> files_for(const std::string& target) {
    std::vector<fs::path> files;
    for (const char* kind : {"seeds", "finds"}) {
        const fs::path folder = fs::path(TRIAD_SOURCE_DIR) / "tests/fuzz" / kind / target;
        if (!fs::exists(folder)) continue;
        for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class FuzzTarget : public testing::TestWithParam<std::string> {};

TEST_P(FuzzTarget, answers_its_seeds_and_finds) {
    const std::vector<fs::path> files = files_for(GetParam());
    EXPECT_FALSE(files.empty());
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        const auto bytes = read_file(file);
        EXPECT_NO_THROW(fuzz::answer(fuzz::targets().at(GetParam()), bytes));
    }
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& [name, target] : fuzz::targets()) all.push_back(name);
    return all;
}

// Targets enter their names before main, from other files: the list is read when tests are made of it, after
// that.
INSTANTIATE_TEST_SUITE_P(All, FuzzTarget, testing::ValuesIn(names()),
                         [](const auto& each) { return each.param; });

TEST(FuzzTargets, all_are_linked) { EXPECT_EQ(fuzz::targets().size(), 12u); }

}  // namespace
}  // namespace triad
