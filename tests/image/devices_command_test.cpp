// Several devices make one picture: parts of one device its bytes, others a film that says who took what.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "device/device.h"
#include "expect_exit.h"
#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

/// A CPU device that can be halved, or none.
std::string cpu() {
    for (const DeviceInfo& device : list_devices().devices)
        if (device.usable && device.type == "cpu" && device.compute_units > 1)
            return std::to_string(device.index);
    return "";
}

}  // namespace

TEST(DevicesCommand, two_halves_of_a_device_give_its_bytes_and_are_recorded_as_it) {
    if (cpu().empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    for (const std::string options :
         {"--size 96x64 --spp 64", "--size 96x64 --spp 60 --adaptive on",
          "--size 64x36 --bins 2x2 --error 6e-3", "--size 64x36 --panel rgb --ppd 45 --adaptive on --spp 60",
          "'" TRIAD_SCENES "/suite/glass.glb' --size 64x48 --spp 20 --integrator photons",
          "'" TRIAD_SCENES "/suite/glass.glb' --size 64x48 --spp 20 --integrator photon-map"}) {
        const TemporaryFolder folder;
        const std::string render = "render " + options + " -q --film ";
        const fs::path whole = folder / "whole.film", halves = folder / "halves.film",
                       json = folder / "a.json";
        expect_exit(0, render + whole.string() + " --device " + cpu());
        expect_exit(0, render + halves.string() + " --device " + cpu() + "/2 --json " + json.string());
        EXPECT_TRUE(bytes_of(whole) == bytes_of(halves)) << options;
        const auto devices = nlohmann::json::parse(bytes_of(json))["rows"][0]["devices"];
        ASSERT_EQ(devices.size(), 2u);
        for (const auto& device : devices) EXPECT_GT(device["samples"], 0) << options;
    }
}

TEST(DevicesCommand, a_render_of_two_halves_that_is_killed_goes_on) {
    if (cpu().empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    const std::string options = "--size 128x96 --spp 900 --device " + cpu();
    expect_exit(0, "render " + options + " -q --film " + whole.string());
    Running render("render " + options + "/2 --progress json --checkpoint 0 --film " + film.string());
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    render.send(SIGKILL);
    EXPECT_EQ(render.wait(), -1);
    expect_exit(0, "render --resume " + film.string() + " -q --device " + cpu() + "/2");
    EXPECT_TRUE(bytes_of(whole) == bytes_of(film));
}

TEST(DevicesCommand, what_cannot_be_is_said) {
    if (cpu().empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    expect_exit(1, "render --device " + cpu() + "/999 --size 8x8 --spp 1 -o /tmp/none.png", "compute units");
    expect_exit(1, "render --device " + cpu() + ",nothing-like-it --size 8x8 --spp 1 -o /tmp/none.png",
                "nothing-like-it");
    expect_exit(1, "render --device " + cpu() + "/0 --size 8x8 --spp 1 -o /tmp/none.png",
                "at least one part");
}

TEST(DevicesCommand, one_that_is_named_twice_is_told_once) {
    if (cpu().empty()) GTEST_SKIP() << "there is no CPU device of several cores";
    const TemporaryFolder folder;
    const std::string render =
        "render --size 16x16 --spp 4 -o " + (folder / "a.png").string() + " --device " + cpu();
    for (const std::string& more : {"," + cpu(), "," + cpu() + "," + cpu(), "/2," + cpu()}) {
        const Outcome outcome = run_triad(render + more);
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        const auto at = outcome.output.find("more than once");
        ASSERT_NE(at, std::string::npos) << more << "\n" << outcome.output;
        EXPECT_EQ(outcome.output.find("more than once", at + 1), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(run_triad(render + "/2").output.find("more than once"), std::string::npos);
}

TEST(DevicesCommand, all_is_every_piece_of_hardware_once) {
    const TemporaryFolder folder;
    const fs::path json = folder / "a.json";
    expect_exit(0, "render --device all --size 16x16 --spp 4 -q -o " + (folder / "a.png").string() +
                       " --json " + json.string());
    std::vector<std::string> hardware;
    for (const DeviceInfo& device : list_devices().devices)
        if (device.usable && std::find(hardware.begin(), hardware.end(), device.hardware) == hardware.end())
            hardware.push_back(device.hardware);
    EXPECT_EQ(nlohmann::json::parse(bytes_of(json))["rows"][0]["devices"].size(), hardware.size());
}

TEST(DevicesCommand, sixty_four_devices_make_the_film_of_one) {
    std::string kinds, numbers;
    for (int i = 0; i < 64; ++i) kinds += "basic ", numbers += (i ? "," : "") + std::to_string(i);
    const std::string sixty_four = "POCL_DEVICES='" + kinds + "'";
    const Outcome devices = run_triad("devices", sixty_four);
    if (devices.output.find("\n  63  ") == std::string::npos) GTEST_SKIP() << "PoCL is not the only driver";
    const TemporaryFolder folder;
    const std::string render = "render --size 64x48 --spp 16 -q --film ";
    const fs::path one = folder / "one.film", many = folder / "many.film";
    Outcome outcome = run_triad(render + one.string() + " --device 0", sixty_four);
    ASSERT_EQ(outcome.exit, 0) << outcome.output;
    outcome = run_triad(render + many.string() + " --device " + numbers, sixty_four);
    ASSERT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_TRUE(bytes_of(one) == bytes_of(many));
}

TEST(DevicesCommand, a_machine_without_a_device_is_told_what_to_install) {
    const Outcome outcome =
        run_triad("render --size 8x8 --spp 1 -o /tmp/none.png", "OCL_ICD_VENDORS=/nowhere");
    EXPECT_EQ(outcome.exit, 5);
    EXPECT_NE(outcome.output.find("apt-get install pocl-opencl-icd"), std::string::npos) << outcome.output;
    EXPECT_EQ(run_triad("devices", "OCL_ICD_VENDORS=/nowhere").exit, 5);
}
