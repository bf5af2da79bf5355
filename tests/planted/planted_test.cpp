// The test of the tests: each of these faults, planted into a copy of the kernels, is caught by a named case
// of triad check, and that case passes without the fault.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "check/check.h"
#include "device/device_fixture.h"
#include "faults.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A copy of the kernels with one text replaced.
class FaultyKernels {
  public:
    FaultyKernels(const std::string& file, const std::string& right, const std::string& wrong) {
        fs::remove_all(folder);
        fs::copy(fs::path(TRIAD_SOURCE_DIR) / "kernels", folder, fs::copy_options::recursive);
        std::string text = text_of(folder / file);
        const auto at = text.find(right);
        found_once = at != std::string::npos && text.find(right, at + 1) == std::string::npos;
        if (found_once)
            std::ofstream(folder / file, std::ios::binary) << text.replace(at, right.size(), wrong);
    }
    ~FaultyKernels() {
        kernel_source::set_folder({});
        fs::remove_all(folder);
    }

    const fs::path folder = fs::temp_directory_path() / ("triad-planted-" + std::to_string(::getpid()));
    bool found_once = false;
};

class Planted : public testing::TestWithParam<Fault> {};

TEST_P(Planted, is_caught_and_only_then) {
    const Fault& fault = GetParam();
    const CheckCase by = cases_of(CheckLevel::quick, {fault.caught_by}).front();
    const CheckResult right = run_case(test_device(), by, CheckLevel::quick);
    EXPECT_TRUE(right.ok.value_or(false))
        << by.name() << ": " << right.value << " is more than " << right.bound;

    const FaultyKernels kernels(fault.file, fault.right, fault.wrong);
    ASSERT_TRUE(kernels.found_once) << "\"" << fault.right << "\" is not, or not once, in kernels/"
                                    << fault.file;
    kernel_source::set_folder(kernels.folder);
    const CheckResult wrong = run_case(test_device(), by, CheckLevel::quick);
    EXPECT_FALSE(wrong.ok.value_or(true))
        << by.name() << " does not see it: " << wrong.value << ", bound " << wrong.bound;
    for (const std::string& failure : wrong.failures)
        EXPECT_EQ(failure.find("clBuildProgram"), std::string::npos) << failure;
}

INSTANTIATE_TEST_SUITE_P(Faults, Planted, testing::ValuesIn(faults),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FirstPicture, of_a_device_that_errs_is_written_by_force_alone) {
    const FaultyKernels kernels("traversal/triangle.h", "(TRIANGLE_LOAD(lane, block->primitive) != skip)",
                                "(t > 1e-4f)");
    ASSERT_TRUE(kernels.found_once);
    const fs::path folder = fs::temp_directory_path() / ("triad-first-" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    const auto render = [&](const std::string& more) {
        const std::string command = "cd " + folder.string() + " && XDG_CACHE_HOME=$PWD/cache " +
                                    TRIAD_PROGRAM + " render --size 16x16 --spp 1 --kernels " +
                                    kernels.folder.string() + " -o a.png --film a.film --json a.json " +
                                    more + " > said 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    const auto none_is_there = [&] {
        for (const char* name : {"a.png", "a.film", "a.json"})
            EXPECT_FALSE(fs::exists(folder / name)) << name;
    };
    // Checked at its first use, and known from then on.
    for (const char* beginning : {"First use of ", "triad: "}) {
        EXPECT_EQ(render(""), 5);
        const std::string said = text_of(folder / "said");
        EXPECT_EQ(said.find(beginning), 0u) << said;
        EXPECT_NE(said.find("computes wrong answers: C3"), std::string::npos) << said;
        none_is_there();
    }
    EXPECT_EQ(render("--force"), 0);
    EXPECT_NE(text_of(folder / "said").find("The picture may be wrong"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "a.png"));
    fs::remove_all(folder);
}

/// What the simulator says about a case; empty: nothing. `format`: of nodes.
std::string oclgrind(const std::string& options, const fs::path& kernels, const std::string& id,
                     const std::string& format = "bvh8") {
    const fs::path log = fs::temp_directory_path() / ("triad-oclgrind-" + std::to_string(::getpid()));
    // A cache of its own: what it compiled otherwise would lack these build options.
    const fs::path cache = fs::temp_directory_path() / ("triad-oclgrind-cache-" + std::to_string(::getpid()));
    const std::string command =
        "XDG_CACHE_HOME=" + cache.string() + " oclgrind --build-options '-cl-opt-disable -DTRIAD_CALLS' " +
        options + " --log " + log.string() + " " + TRIAD_PROGRAM + " check --tiny --device oclgrind --case " +
        id + " --format " + format + " --kernels " + kernels.string() + " > /dev/null 2>&1";
    [[maybe_unused]] const int status = std::system(command.c_str());
    const std::string text = text_of(log);
    fs::remove(log);
    fs::remove_all(cache);
    return text;
}

TEST(Simulator, sees_a_read_out_of_bounds_that_changes_no_value) {
    if (std::system("oclgrind --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "oclgrind is not installed";
    EXPECT_EQ(oclgrind("", fs::path(TRIAD_SOURCE_DIR) / "kernels", "C16e"), "");
    const FaultyKernels kernels("shading/environment.h", "math_clamp_int((int)fy + 1, 0, h - 1)",
                                "(int)fy + 1");
    ASSERT_TRUE(kernels.found_once);
    EXPECT_NE(oclgrind("", kernels.folder, "C16e").find("Invalid read"), std::string::npos);
}

TEST(Simulator, sees_an_empty_child_that_a_ray_of_no_numbers_meets) {
    if (std::system("oclgrind --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "oclgrind is not installed";
    const auto expect_seen = [](const std::string& format, const char* right, const char* wrong) {
        EXPECT_EQ(oclgrind("", fs::path(TRIAD_SOURCE_DIR) / "kernels", "C25", format), "") << format;
        const FaultyKernels kernels("traversal/slab.h", right, wrong);
        ASSERT_TRUE(kernels.found_once) << right;
        EXPECT_NE(oclgrind("", kernels.folder, "C25", format).find("Invalid read"), std::string::npos)
            << format;
    };
    expect_seen("bvh8", "tf = t_max < tf ? (float8)(t_max) : tf;", "tf = tf < t_max ? tf : (float8)(t_max);");
    // In bvh4 one fault is not enough: BVH_EMPTY is TRIAD_NONE, which its walk takes for no child.
    EXPECT_EQ(oclgrind("", fs::path(TRIAD_SOURCE_DIR) / "kernels", "C25", "bvh4"), "");
}

TEST(Simulator, sees_a_race_whatever_the_number_of_threads) {
    if (std::system("oclgrind --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "oclgrind is not installed";
    EXPECT_EQ(oclgrind("--data-races", fs::path(TRIAD_SOURCE_DIR) / "kernels", "R1"), "");
    const FaultyKernels kernels("common/film.h", "atomic_add(counters + 2u * which, amount)",
                                "(counters[2u * which] += amount) - amount");
    ASSERT_TRUE(kernels.found_once);
    EXPECT_NE(oclgrind("--data-races", kernels.folder, "R1").find("data race"), std::string::npos);
}

int exit_code(const std::string& command, const fs::path& said) {
    const int status = std::system((command + " > " + said.string() + " 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(FirstRender, refuses_kernels_that_compute_wrong_answers_unless_forced) {
    const FaultyKernels kernels("shading/base_sample.h", "eta * eta * -wi_h / l2", "1.0f");
    ASSERT_TRUE(kernels.found_once);
    const fs::path cache = kernels.folder / "cache", picture = kernels.folder / "picture.png",
                   said = kernels.folder / "said.txt";
    const std::string render = "XDG_CACHE_HOME=" + cache.string() + " " + TRIAD_PROGRAM +
                               " render -q --spp 1 --size 8x8 -o " + picture.string() + " --kernels " +
                               kernels.folder.string();
    EXPECT_EQ(exit_code(render, said), 5) << text_of(said);
    EXPECT_FALSE(fs::exists(picture));
    EXPECT_EQ(exit_code(render, said), 5) << "the kept verdict: " << text_of(said);
    EXPECT_EQ(exit_code(render + " --force", said), 0) << text_of(said);
    EXPECT_TRUE(fs::exists(picture));
}

}  // namespace
}  // namespace triad
