// The verdict on a device: found once, kept per device, driver and kernels, and a wrong device is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "check/measurements.h"
#include "check/verdict.h"
#include "device_fixture.h"
#include "own_cache.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

class VerdictTest : public testing::Test {
  protected:
    Device& device = test_device();  // open before the cache is another
    const OwnCache cache;
};

CheckResult result_of(const char* name, std::optional<bool> ok) {
    CheckResult r;
    r.name = name, r.ok = ok;
    return r;
}

TEST_F(VerdictTest, is_kept_per_device_driver_and_settings) {
    const DeviceInfo& info = test_device().info();
    const auto load_verdict = [](const DeviceInfo& of) { return triad::load_verdict(of, BvhFormat::bvh8); };
    EXPECT_FALSE(load_verdict(info));
    keep_verdict(info, BvhFormat::bvh8,
                 *verdict_of({result_of("C1 edges", true), result_of("C14 none", std::nullopt)}));
    ASSERT_TRUE(load_verdict(info));
    EXPECT_TRUE(load_verdict(info)->wrong.empty());
    keep_verdict(info, BvhFormat::bvh8,
                 *verdict_of({result_of("C1 edges", false), result_of("D4 slab", true)}));
    EXPECT_EQ(load_verdict(info)->wrong, std::vector<std::string>{"C1 edges"});
    DeviceInfo other = info;
    other.driver += " next";
    EXPECT_FALSE(load_verdict(other));
    other = info;
    other.settings.push_back("MODE=0");
    EXPECT_FALSE(load_verdict(other));
    EXPECT_FALSE(triad::load_verdict(info, BvhFormat::bvh4)) << "it was another format of nodes";
}

TEST_F(VerdictTest, is_none_where_memory_was_lacking_and_nothing_else_is_wrong) {
    CheckResult lacking = result_of("C4 moved", false);
    lacking.lacked_memory = true;
    EXPECT_FALSE(verdict_of({result_of("C1 edges", true), lacking}));
    ASSERT_TRUE(verdict_of({result_of("C1 edges", false), lacking}));
    EXPECT_EQ(verdict_of({result_of("C1 edges", false), lacking})->wrong,
              std::vector<std::string>{"C1 edges"});
    const CheckCase none{"X1", "no memory", CheckLevel::quick,
                         [](Check&) { throw Error(Exit::memory, "none is left"); }};
    EXPECT_TRUE(run_case(test_device(), none, CheckLevel::quick).lacked_memory);
    const CheckCase other{"X2", "no device", CheckLevel::quick,
                          [](Check&) { throw Error(Exit::device, "none is left"); }};
    EXPECT_FALSE(run_case(test_device(), other, CheckLevel::quick).lacked_memory);
}

TEST_F(VerdictTest, that_cannot_be_read_is_none) {
    const DeviceInfo& info = test_device().info();
    for (const char* bad :
         {"", "{", "[]", "{\"schema\": 3, \"wrong\": []}", "{\"schema\": \"triad.verdict/1\"}",
          "{\"schema\": \"triad.verdict/1\", \"wrong\": 1}",
          "{\"schema\": \"triad.verdict/1\", \"wrong\": [1]}"}) {
        keep_verdict(info, BvhFormat::bvh8, {});
        for (const fs::path& path : cache.files("checked/mega-bvh8")) std::ofstream(path) << bad;
        EXPECT_FALSE(load_verdict(info, BvhFormat::bvh8)) << bad;
    }
}

TEST_F(VerdictTest, of_wrong_answers_is_an_error_that_names_them_unless_forced) {
    const DeviceInfo& info = test_device().info();
    EXPECT_NO_THROW(require_right({}, info, false));
    const Verdict wrong{{"C1 watertight edges", "D4 slab 30 degrees"}};
    EXPECT_NO_THROW(require_right(wrong, info, true));
    try {
        require_right(wrong, info, false);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::device);
        for (const char* part : {"C1 watertight edges", "D4 slab 30 degrees", "--force", info.name.c_str()})
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(Check, says_the_measurement_nearest_to_its_bound_and_fails_on_nan) {
    Check check(test_device(), CheckLevel::full);
    check.at_most(1, 10, "far");
    check.at_most(3, 4, "near");
    check.at_most(-5, 1, "below");
    EXPECT_EQ(check.result().value, 3);
    EXPECT_EQ(check.result().what, "near");
    EXPECT_EQ(check.result().ok, true);
    check.at_most(NAN, 1, "none");
    check.at_most(2, 1, "beyond");
    EXPECT_TRUE(std::isnan(check.result().value));
    EXPECT_EQ(check.result().ok, false);
    EXPECT_EQ(check.result().failures.size(), 2u);
}

TEST(Check, counts_plainly_wrong_answers) {
    Check check(test_device(), CheckLevel::full);
    check.at_most(1, 10, "right");
    for (int i = 0; i < 100; ++i) check.equal(i % 2, 0, "item ", i);
    EXPECT_EQ(check.result().value, 50);
    EXPECT_EQ(check.result().bound, 0);
    EXPECT_EQ(check.result().ok, false);
    EXPECT_EQ(check.result().failures.front(), "item 1 differs");
}

TEST(Check, has_every_id_once_and_knows_no_others) {
    std::set<std::string> ids;
    const auto all = cases_of(CheckLevel::full);
    for (const CheckCase& each : all) EXPECT_TRUE(ids.insert(each.id).second) << each.name();
    for (int c = 1; c <= 25; ++c) EXPECT_TRUE(ids.contains("C" + std::to_string(c))) << c;
    for (int d = 1; d <= 7; ++d) EXPECT_TRUE(ids.contains("D" + std::to_string(d))) << d;
    EXPECT_LT(cases_of(CheckLevel::quick).size(), all.size());
    EXPECT_EQ(cases_of(CheckLevel::quick, {"D1", "C1"}).front().name(), "D1 form factor of facing squares");
    EXPECT_THROW(cases_of(CheckLevel::full, {"C99"}), Error);
}

}  // namespace
}  // namespace triad
