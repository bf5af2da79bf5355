// Every program compiles on this device with all options on, and all off; on demand with each one alone off.
#include <gtest/gtest.h>

#include <regex>

#include "device_fixture.h"

using namespace triad;

namespace {

/// The option names, from the one place that lists them.
std::vector<std::string> feature_names() {
    const std::string text = kernel_source::text("features.h");
    const std::regex option(R"(#ifndef (TRIAD_\w+) /\*)");
    std::vector<std::string> names;
    for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
        names.push_back((*match)[1]);
    return names;
}

TEST(Features, each_is_a_sentence_and_on_by_default) {
    const std::string text = kernel_source::text("features.h");
    const auto names = feature_names();
    ASSERT_FALSE(names.empty());
    const std::regex guards(R"(#ifndef TRIAD_)");
    EXPECT_EQ(names.size() + 1,
              static_cast<std::size_t>(std::distance(std::sregex_iterator(text.begin(), text.end(), guards),
                                                     std::sregex_iterator())))
        << "an option without its sentence";
    for (const std::string& name : names)
        EXPECT_NE(text.find("#define " + name + " 1\n"), std::string::npos) << name;
}

class Programs : public testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Programs);

TEST_P(Programs, builds_with_all_options_and_with_none) {
    Device& device = test_device();
    EXPECT_NO_THROW(device.build(GetParam()));
    const std::string text = kernel_source::load(GetParam());
    Options all_off;
    if (text.find("TRIAD_BVH4") != std::string::npos && text.find("traversal_walk") != std::string::npos) {
        all_off["TRIAD_BVH4"] = "1";
        EXPECT_NO_THROW(device.build(GetParam(), all_off)) << "nodes of four boxes";
    }
    for (const std::string& name : feature_names()) all_off[name] = "0";
    EXPECT_NO_THROW(device.build(GetParam(), all_off));
}

/// Minutes: kernel_syntax (label unit) asks clang the same in seconds. For a device's first check-up.
TEST_P(Programs, DISABLED_builds_with_each_option_alone_off) {
    const std::string text = kernel_source::load(GetParam());
    for (const std::string& name : feature_names()) {
        // An option that no #if of this program asks for gives the program that was built already.
        const std::regex use("#\\s*(el)?if [^\n]*\\b" + name + "\\b");
        if (std::regex_search(text, use)) {
            EXPECT_NO_THROW(test_device().build(GetParam(), {{name, "0"}})) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kernels, Programs, testing::ValuesIn(kernel_source::programs()),
                         [](const auto& info) {
                             return std::regex_replace(info.param, std::regex(R"(\W)"), "_");
                         });

}  // namespace
