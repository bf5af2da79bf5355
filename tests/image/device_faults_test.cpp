// A device that fails costs no sample: others do again what it had not delivered. Every OpenCL call is made
// to fail.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include "device/device.h"
#include "io/io.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

/// The program with the faulty library before OpenCL's.
Outcome run_faulty(const std::string& arguments, const std::string& fault, const std::string& more = "") {
    return run_triad(arguments, more + " TRIAD_FAULT='" + fault + "' LD_PRELOAD='" TRIAD_FAULTY "'");
}

constexpr int out_of_resources = -5, out_of_memory = -4;

/// A render on two halves of a device, and the film that it comes to.
class DeviceFaults : public testing::Test {
  protected:
    void SetUp() override {
        for (const DeviceInfo& device : list_devices().devices)
            if (device.usable && device.type == "cpu" && device.compute_units > 1)
                device_ = " --device " + std::to_string(device.index) + "/2";
        if (device_.empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    }

    void render_whole(const std::string& options) {
        command_ = "render " + options + device_ + " --film ";
        const Outcome outcome = run_triad(command_ + whole_.string());
        ASSERT_EQ(outcome.exit, 0) << outcome.output;
    }
    /// The calls of one half, from its context's creation to the end of the render.
    std::map<std::string, long> calls_of(long half) {
        const fs::path counts = folder_ / "counts";
        const Outcome outcome = run_faulty(command_ + (folder_ / "counted.film").string(), "",
                                           "TRIAD_FAULT_COUNTS='" + counts.string() + "'");
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        std::map<std::string, long> calls;
        std::ifstream file(counts);
        long context, count;
        for (std::string call; file >> context >> call >> count;)
            if (context == half) calls[call] = count;
        return calls;
    }
    /// With this fault the film is the same. Returns what was said.
    std::string expect_whole_with(const std::string& fault) {
        fs::remove(film_);
        const Outcome outcome = run_faulty(command_ + film_.string(), fault);
        EXPECT_EQ(outcome.exit, 0) << fault << "\n" << outcome.output;
        EXPECT_TRUE(bytes_of(film_) == bytes_of(whole_)) << fault << "\n" << outcome.output;
        return outcome.output;
    }
    /// One half vanishes after each of these parts of its calls.
    void expect_whole_without(long half, std::initializer_list<double> parts) {
        const long calls = calls_of(half).at("any");
        for (const double part : parts)
            expect_whole_with(std::to_string(half) + " any " + std::to_string(long(part * double(calls))) +
                              " " + std::to_string(out_of_resources) + " ever");
    }

    const TemporaryFolder folder_;
    const fs::path whole_ = folder_ / "whole.film", film_ = folder_ / "a.film";
    std::string device_, command_;
};

}  // namespace

TEST_F(DeviceFaults, every_call_of_one_of_two_devices_may_fail_and_the_picture_is_whole) {
    render_whole("--size 64x48 --spp 60 --checkpoint 0.02");
    const auto calls = calls_of(1);
    ASSERT_GT(calls.at("clEnqueueNDRangeKernel"), 4);
    int told = 0;
    for (const auto& [call, count] : calls)
        for (const auto& [n, how] : {std::pair(count / 2 + 1, "once"), std::pair(count, "ever")})
            told += expect_whole_with("1 " + call + " " + std::to_string(n) + " " +
                                      std::to_string(out_of_resources) + " " + how)
                        .find("left out") != std::string::npos;
    // Some answers are not needed: the size of the largest work-group, the last call of a render.
    EXPECT_GT(told, int(calls.size()));
}

TEST_F(DeviceFaults, a_device_that_never_answers_is_given_up) {
    render_whole("--size 64x48 --spp 60");
    const std::string said = expect_whole_with("1 clSetEventCallback 3 1 ever");
    EXPECT_NE(said.find("has not answered for 10 s"), std::string::npos) << said;
}

TEST_F(DeviceFaults, an_only_device_that_never_answers_ends_the_render_which_goes_on) {
    device_.clear();
    render_whole("--size 64x48 --spp 1200 --checkpoint 0.1");
    fs::remove(film_);
    const Outcome outcome = run_faulty(command_ + film_.string(), "0 clSetEventCallback 60 1 ever");
    EXPECT_EQ(outcome.exit, 5) << outcome.output;
    EXPECT_NE(outcome.output.find("has not answered for 60 s"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("To go on: triad render --resume"), std::string::npos) << outcome.output;
    EXPECT_EQ(run_triad("render --resume " + film_.string()).exit, 0);
    EXPECT_TRUE(bytes_of(film_) == bytes_of(whole_));
}

TEST_F(DeviceFaults, a_device_that_brings_garbage_is_given_up) {
    render_whole("--size 64x48 --spp 60 --checkpoint 0.05");
    // Sums, half sums, samples and counters are read, each time.
    for (const auto& [n, words] : {std::pair("3", "did not take the samples"),
                                   {"4", "no numbers"},
                                   {"7", "did not take the samples"}}) {
        const std::string said = expect_whole_with("1 clEnqueueReadBuffer " + std::string(n) + " 1 once");
        EXPECT_NE(said.find(words), std::string::npos) << n << said;
    }
}

TEST_F(DeviceFaults, with_photons_whole_samples_are_done_again) {
    render_whole("'" TRIAD_SCENES "/suite/glass.glb' --size 48x36 --spp 24 --integrator photons");
    expect_whole_without(1, {0.75, 0.9, 0.97});
}

TEST_F(DeviceFaults, the_device_that_shows_the_eye_the_picture_may_fail) {
    render_whole("--size 48x36 --panel rgb --ppd 45 --adaptive on --spp 60");
    expect_whole_without(0, {0.5, 0.6, 0.7, 0.8, 0.9});
}

TEST_F(DeviceFaults, when_none_is_left_what_was_delivered_goes_on_and_the_exit_code_says_why) {
    render_whole("--size 64x48 --spp 1200 --checkpoint 0.1");
    for (const int code : {out_of_resources, out_of_memory}) {
        fs::remove(film_);
        const Outcome outcome = run_faulty(command_ + film_.string(),
                                           "-2 clEnqueueNDRangeKernel 20 " + std::to_string(code) + " ever");
        EXPECT_EQ(outcome.exit, code == out_of_memory ? 4 : 5) << outcome.output;
        const Outcome info = run_triad("info " + film_.string());
        EXPECT_NE(info.output.find("stopped"), std::string::npos) << info.output << outcome.output;
        EXPECT_EQ(run_triad("render --resume " + film_.string() + device_).exit, 0);
        EXPECT_TRUE(bytes_of(film_) == bytes_of(whole_)) << code;
    }
}
