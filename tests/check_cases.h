#pragma once
/// The cases of `triad check` as GoogleTest cases: each at its full amount of work.
#include <gtest/gtest.h>

#include <regex>

#include "check/check.h"
#include "device/device_fixture.h"

namespace triad {

class Case : public testing::TestWithParam<CheckCase> {};

inline void expect_right(const CheckResult& result) {
    for (const std::string& failure : result.failures) ADD_FAILURE() << failure;
    EXPECT_TRUE(result.ok.value_or(false))
        << result.value << " is more than " << result.bound << ", " << result.what;
}

TEST_P(Case, is_right) { expect_right(run_case(test_device(), GetParam(), CheckLevel::full)); }

/// Those that some kernel can answer.
inline std::vector<CheckCase> answerable(std::vector<CheckCase> cases) {
    std::erase_if(cases, [](const CheckCase& c) { return !c.run; });
    return cases;
}

inline std::string case_name(const testing::TestParamInfo<CheckCase>& info) {
    return std::regex_replace(info.param.name(), std::regex(R"(\W+)"), "_");
}

}  // namespace triad
