// A device that fails costs no sample: others do again what it had not delivered. Every OpenCL call is made
// to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "device/device.h"
#include "io/io.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

std::string halves() {
    for (const DeviceInfo& device : list_devices().devices)
        if (device.usable && device.type == "cpu" && device.compute_units > 1)
            return " --device " + std::to_string(device.index) + "/2";
    return "";
}

/// The program with the faulty library before OpenCL's.
Outcome run_faulty(const std::string& arguments, const std::string& fault, const std::string& more = "") {
    return run_triad(arguments, more + " TRIAD_FAULT='" + fault + "' LD_PRELOAD='" TRIAD_FAULTY "'");
}

/// Calls of the second half, or that of `of`, from its context's creation to the end of a render.
std::map<std::string, long> calls_of(const std::string& arguments, const fs::path& counts, long of = 1) {
    const Outcome outcome = run_faulty(arguments, "", "TRIAD_FAULT_COUNTS='" + counts.string() + "'");
    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    std::map<std::string, long> calls;
    std::ifstream file(counts);
    long context, count;
    for (std::string call; file >> context >> call >> count;)
        if (context == of) calls[call] = count;
    return calls;
}

constexpr int out_of_resources = -5, out_of_memory = -4;

}  // namespace

TEST(DeviceFaults, every_call_of_one_of_two_devices_may_fail_and_the_picture_is_whole) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options = "render --size 64x48 --spp 60 --checkpoint 0.02" + device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    fs::remove(whole);
    const auto calls = calls_of(options + whole.string(), folder / "counts");
    ASSERT_GT(calls.at("clEnqueueNDRangeKernel"), 4);
    int told = 0;
    for (const auto& [call, count] : calls)
        for (const auto& [n, how] : {std::pair(count / 2 + 1, "once"), std::pair(count, "ever")}) {
            fs::remove(film);
            const std::string fault =
                "1 " + call + " " + std::to_string(n) + " " + std::to_string(out_of_resources) + " " + how;
            const Outcome outcome = run_faulty(options + film.string(), fault);
            EXPECT_EQ(outcome.exit, 0) << fault << "\n" << outcome.output;
            EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << fault << "\n" << outcome.output;
            told += outcome.output.find("left out") != std::string::npos;
        }
    // Some answers are not needed: the size of the largest work-group, the last call of a render.
    EXPECT_GT(told, int(calls.size()));
}

TEST(DeviceFaults, a_device_that_never_answers_is_given_up) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options = "render --size 64x48 --spp 60" + device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    const Outcome outcome = run_faulty(options + film.string(), "1 clSetEventCallback 3 1 ever");
    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("has not answered for 10 s"), std::string::npos) << outcome.output;
    EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << outcome.output;
}

TEST(DeviceFaults, a_device_that_brings_garbage_is_given_up) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options = "render --size 64x48 --spp 60 --checkpoint 0.05" + device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    // Sums, half sums, samples and counters are read, each time.
    for (const auto& [n, how, words] : {std::tuple("3", "once", "did not take the samples"),
                                        {"4", "once", "no numbers"},
                                        {"7", "once", "did not take the samples"}}) {
        fs::remove(film);
        const Outcome outcome =
            run_faulty(options + film.string(), "1 clEnqueueReadBuffer " + std::string(n) + " 1 " + how);
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        EXPECT_NE(outcome.output.find(words), std::string::npos) << n << how << outcome.output;
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << outcome.output;
    }
}

TEST(DeviceFaults, with_photons_whole_samples_are_done_again) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options = "render '" TRIAD_SCENES
                                "/suite/glass.glb' --size 48x36 --spp 24 --integrator photons" +
                                device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    fs::remove(whole);
    const auto calls = calls_of(options + whole.string(), folder / "counts");
    for (const double part : {0.75, 0.9, 0.97}) {
        fs::remove(film);
        const std::string fault =
            "1 any " + std::to_string(long(part * double(calls.at("any")))) + " -5 ever";
        const Outcome outcome = run_faulty(options + film.string(), fault);
        EXPECT_EQ(outcome.exit, 0) << fault << "\n" << outcome.output;
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << fault << "\n" << outcome.output;
    }
}

TEST(DeviceFaults, the_device_that_shows_the_eye_the_picture_may_fail) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options =
        "render --size 48x36 --panel rgb --ppd 45 --adaptive on --spp 60" + device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    fs::remove(whole);
    const auto calls = calls_of(options + whole.string(), folder / "counts", 0);
    for (const double part : {0.5, 0.6, 0.7, 0.8, 0.9}) {
        fs::remove(film);
        const std::string fault =
            "0 any " + std::to_string(long(part * double(calls.at("any")))) + " -5 ever";
        const Outcome outcome = run_faulty(options + film.string(), fault);
        EXPECT_EQ(outcome.exit, 0) << fault << "\n" << outcome.output;
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << fault << "\n" << outcome.output;
    }
}

TEST(DeviceFaults, when_none_is_left_what_was_delivered_goes_on_and_the_exit_code_says_why) {
    const std::string device = halves();
    if (device.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string options = "render --size 64x48 --spp 1200 --checkpoint 0.1" + device + " --film ";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    ASSERT_EQ(run_triad(options + whole.string()).exit, 0);
    for (const int code : {out_of_resources, out_of_memory}) {
        fs::remove(film);
        const Outcome outcome = run_faulty(options + film.string(),
                                           "-2 clEnqueueNDRangeKernel 20 " + std::to_string(code) + " ever");
        EXPECT_EQ(outcome.exit, code == out_of_memory ? 4 : 5) << outcome.output;
        const Outcome info = run_triad("info " + film.string());
        EXPECT_NE(info.output.find("stopped"), std::string::npos) << info.output << outcome.output;
        EXPECT_EQ(run_triad("render --resume " + film.string() + device).exit, 0);
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << code;
    }
}
