// The image of docs/recipes/ci is made of the launcher's packages.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "program.h"

namespace {

using Packages = std::set<std::string>;

Packages words_of(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

/// What stands in packages=(...) of ./triad.
Packages of_launcher() {
    std::smatch list;
    const std::string text = bytes_of(TRIAD_SOURCE_DIR "/triad");
    EXPECT_TRUE(std::regex_search(text, list, std::regex(R"(\npackages=\(([^)]*)\))")));
    return words_of(list[1]);
}

/// What the Dockerfile installs.
Packages of_image() {
    std::smatch list;
    const std::string text = bytes_of(TRIAD_SOURCE_DIR "/docs/recipes/ci/Dockerfile");
    EXPECT_TRUE(std::regex_search(text, list, std::regex(R"(--no-install-recommends ([^&]*)&&)")));
    return words_of(std::regex_replace(list[1].str(), std::regex(R"(\\\n)"), " "));
}

}  // namespace

TEST(Recipes, the_image_has_the_packages_of_the_launcher) {
    EXPECT_GT(of_launcher().size(), 15u);
    EXPECT_EQ(of_image(), of_launcher());
}
