// What host and kernels must say alike, where the compiler cannot see it.
#include <gtest/gtest.h>

#include <regex>

#include "pack/features.h"
#include "scene/film.h"
#include "trace/kernel_arguments.h"

using namespace triad;

TEST(Border, host_lists_the_options_of_the_kernels_in_their_order) {
    const std::string text = kernel_source::text("features.h");
    const std::regex option(R"(#ifndef TRIAD_(\w+) /\*)");
    std::vector<std::string> kernels, host;
    for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
        kernels.push_back((*match)[1]);
    for (const FeatureOption& o : feature_options()) host.push_back(o.name);
    EXPECT_EQ(host, kernels);
}

TEST(Border, each_option_has_a_member_of_its_own) {
    Features features;
    for (const FeatureOption& o : feature_options()) {
        EXPECT_TRUE(features.*o.member) << o.name << " shares its member with another option";
        features.*o.member = false;
    }
    EXPECT_EQ(sizeof(Features), feature_options().size()) << "a member without an option";
}

TEST(Border, films_have_room_for_every_counter) { EXPECT_EQ(Film().counters.size(), std::size_t(COUNTERS)); }

TEST(Border, swapped_arrays_of_kernels_do_not_compile) {
    static_assert(std::is_same_v<decltype(dev::SceneArguments::lights), DeviceArray<dev::Light>>);
    static_assert(!std::is_convertible_v<DeviceArray<float>, DeviceArray<std::uint32_t>>);
    static_assert(!std::is_convertible_v<Buffer, DeviceArray<float>>, "says what a buffer holds by itself");
}
