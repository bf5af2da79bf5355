// Drivers that take a program down, beside PoCL: when they are loaded, when they compile, and PoCL itself
// over what lies in its cache. The built program runs as a user runs it, with folders of its own.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "program.h"
#include "temporary_folder.h"
#include "tiny_png.h"

namespace fs = std::filesystem;

namespace {

const fs::path pocl_icd = "/etc/OpenCL/vendors/pocl.icd";

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, std::string_view bytes) { std::ofstream(path, std::ios::binary) << bytes; }

class DyingDrivers : public testing::Test {
  protected:
    TemporaryFolder folder;
    fs::path vendors = folder / "vendors", picture = folder / "in.png", result = folder / "out.png";
    fs::path pocl_cache = folder / "cache/pocl";

    void SetUp() override {
        if (!fs::exists(pocl_icd)) GTEST_SKIP() << pocl_icd << " is missing; apt-get install pocl-opencl-icd";
        fs::create_directory(vendors);
        fs::create_directory(folder / "temporary");
        fs::copy(pocl_icd, vendors / "pocl.icd");
        const tiny_png::Bytes png = tiny_png::make(2, 8, 0, {{10, 200}, {30, 40}});
        write(picture, {reinterpret_cast<const char*>(png.data()), png.size()});
    }
    void add_driver(const std::string& library) const { write(vendors / "fake.icd", library + "\n"); }

    /// `variables`: more of them, and changes to these.
    Outcome run(const std::string& arguments, const std::string& variables = "") const {
        return run_triad(arguments, "env -u LD_LIBRARY_PATH -u POCL_CACHE_DIR -u OCL_ICD_FILENAMES HOME=" +
                                        (folder / "home").string() +
                                        " XDG_CACHE_HOME=" + (folder / "cache").string() +
                                        " TMPDIR=" + (folder / "temporary").string() +
                                        " OCL_ICD_VENDORS=" + vendors.string() + " " + variables);
    }
    /// A picture from a picture: the least work that compiles and runs kernels.
    Outcome resolve(const std::string& variables = "", const std::string& more = "") const {
        fs::remove(result);
        return run("resolve " + picture.string() + " -o " + result.string() + " " + more, variables);
    }
    void expect_picture(const Outcome& outcome) const {
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        EXPECT_TRUE(fs::exists(result)) << outcome.output;
        EXPECT_TRUE(fs::is_empty(folder / "temporary")) << "something temporary was left behind";
    }
};

void expect(const Outcome& outcome, const std::string& sentence) {
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << sentence << "\nis not in\n"
                                                                << outcome.output;
}

void expect_no(const Outcome& outcome, const std::string& sentence) {
    EXPECT_EQ(outcome.output.find(sentence), std::string::npos) << sentence << "\nis in\n" << outcome.output;
}

struct Fault {
    const char *mode, *library, *why;
};
const Fault faults[] = {
    {"abort at load", TRIAD_FAKE_DRIVER, "It died of signal 6 (Aborted) when it was loaded"},
    {"abort", TRIAD_FAKE_DRIVER, "and said: fake driver: cannot go on"},
    {"exit", TRIAD_FAKE_DRIVER, "It ended the process with exit status 3"},
    {"hang", TRIAD_FAKE_DRIVER, "It was not done after 10 s"},
    {"none", "/nowhere/libfake.so",
     "Its library /nowhere/libfake.so cannot be loaded (/nowhere/libfake.so: "
     "cannot open shared object file: No such file or directory)"}};

TEST_F(DyingDrivers, are_left_out_with_the_reason_and_the_next_one_is_taken) {
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.mode);
        add_driver(fault.library);
        const std::string mode = "'OCL_FAKE=" + std::string(fault.mode) + "'";
        const Outcome first = resolve(mode);
        expect_picture(first);
        expect(first, "triad: warning: The OpenCL driver fake.icd is left out. ");
        expect(first, fault.why);
        const Outcome again = resolve(mode);
        expect_picture(again);
        expect_no(again, "fake");
        expect(resolve(mode, "-v"), "Platform fake.icd is left out. ");
        const Outcome list = run("devices", mode);
        EXPECT_EQ(list.exit, 0) << list.output;
        expect(list, std::string("platform fake.icd: "));
        expect(list, fault.why);
        expect(run("devices --json -", mode), "\"platform\": \"fake.icd\"");
        const Outcome wanted = resolve(mode, "--device fake");
        EXPECT_EQ(wanted.exit, 5) << wanted.output;
        expect(wanted, "The OpenCL driver fake.icd cannot be used. ");
    }
}

TEST_F(DyingDrivers, are_tried_once_and_then_remembered) {
    add_driver(TRIAD_FAKE_DRIVER);
    const fs::path verdicts = folder / "cache/triad/drivers";
    run("devices");
    ASSERT_EQ(std::distance(fs::directory_iterator(verdicts), {}), 1);
    const fs::path verdict = fs::directory_iterator(verdicts)->path();
    const auto kept = fs::last_write_time(verdict);
    // A library that became bad without a change is noticed by dying of it.
    const Outcome later = run("devices");
    EXPECT_EQ(later.exit, 0) << later.output;
    EXPECT_EQ(fs::last_write_time(verdict), kept) << "tried again without need";
    write(verdict, "{");
    EXPECT_EQ(run("devices").exit, 0);
    EXPECT_GT(contents(verdict).size(), 1u) << "a damaged verdict is not replaced";
}

TEST_F(DyingDrivers, are_tried_again_when_they_change_or_after_a_day) {
    add_driver("/nowhere/libfake.so");
    expect(run("devices"), "platform fake.icd: ");
    add_driver(TRIAD_FAKE_DRIVER);
    expect_no(run("devices"), "platform fake.icd: ");
    expect(run("devices", "OCL_FAKE=abort"), "platform fake.icd: ");
    for (const auto& verdict : fs::directory_iterator(folder / "cache/triad/drivers"))
        fs::last_write_time(verdict, fs::file_time_type::clock::now() - std::chrono::hours(25));
    expect(run("devices", "OCL_FAKE=abort"), "triad: warning: The OpenCL driver fake.icd is left out. ");
}

TEST_F(DyingDrivers, that_were_good_when_they_were_tried_are_tried_again) {
    const fs::path library = folder / "libfake.so";
    fs::copy(TRIAD_FAKE_DRIVER, library);
    add_driver(library.string());
    const fs::path verdicts = folder / "cache/triad/drivers";
    const std::string mode = "OCL_FAKE=abort";
    run("devices", mode);
    const fs::path verdict = fs::directory_iterator(verdicts)->path();
    write(verdict, R"({"schema": "triad.drivers/1", "bad": []})");
    const Outcome outcome = resolve(mode);
    expect_picture(outcome);
    expect(outcome, "The OpenCL driver fake.icd is left out. ");
}

TEST_F(DyingDrivers, that_are_all_there_is_end_with_their_reasons) {
    add_driver(TRIAD_FAKE_DRIVER);
    fs::remove(vendors / "pocl.icd");
    for (const char* arguments : {"devices", "render --size 8x8"}) {
        const Outcome outcome = run(arguments, "OCL_FAKE=abort");
        EXPECT_EQ(outcome.exit, 5) << outcome.output;
        expect(outcome, "fake.icd: It died of signal 6 (Aborted)");
    }
    // One ICD alone, as OCL_ICD_VENDORS also names it: by file and by library.
    for (const std::string& name : {(vendors / "fake.icd").string(), std::string(TRIAD_FAKE_DRIVER)}) {
        const Outcome outcome = run("devices", "OCL_FAKE=abort OCL_ICD_VENDORS=" + name);
        EXPECT_EQ(outcome.exit, 5) << outcome.output;
        expect(outcome, "It died of signal 6 (Aborted)");
    }
}

TEST_F(DyingDrivers, of_a_program_that_they_compile_are_left_out_for_a_day) {
    add_driver(TRIAD_FAKE_DRIVER);
    const std::string mode = "OCL_FAKE=compiler";
    expect(run("devices", mode), "*  0  gpu   Fragile");
    const std::string why =
        "Its driver died of signal 8 (Floating point exception) when it compiled subpixel/";
    const Outcome first = resolve(mode);
    expect_picture(first);
    expect(first, "triad: warning: Fragile is left out. " + why);
    const Outcome again = resolve(mode);
    expect_picture(again);
    expect_no(again, "Fragile");
    expect(resolve(mode, "-v"), "Fragile is left out. " + why);
    expect(run("devices", mode), "UNUSABLE: " + why);
    const Outcome wanted = resolve(mode, "--device fragile");
    EXPECT_EQ(wanted.exit, 5) << wanted.output;
    expect(wanted, "Fragile cannot be used. " + why);
    for (const auto& kept : fs::directory_iterator(folder / "cache/triad/died"))
        fs::last_write_time(kept, fs::file_time_type::clock::now() - std::chrono::hours(25));
    const Outcome asked = resolve(mode, "--device fragile");
    EXPECT_EQ(asked.exit, 5) << asked.output;
    expect(asked, "Fragile cannot be used. " + why);
    fs::remove(vendors / "pocl.icd");
    const Outcome alone = resolve(mode);
    EXPECT_EQ(alone.exit, 5) << alone.output;
    expect(alone, why);
}

TEST_F(DyingDrivers, that_catch_their_own_abort_are_left_out) {
    add_driver(TRIAD_FAKE_DRIVER);
    const Outcome outcome = resolve("'OCL_FAKE=catching compiler'");
    expect_picture(outcome);
    expect(outcome, "Fragile is left out. Its driver died of signal 6 (Aborted) when it compiled subpixel/");
}

/// What an accident leaves of a file.
struct Damage {
    const char* name;
    std::string (*of)(const std::string&);
};
const Damage damages[] = {{"emptied", [](const std::string&) { return std::string(); }},
                          {"truncated", [](const std::string& s) { return s.substr(0, s.size() / 2); }},
                          {"rubbish", [](const std::string& s) { return std::string(s.size(), 'x'); }}};

TEST_F(DyingDrivers, PoCL_over_its_damaged_cache_gets_a_temporary_one) {
    expect_picture(resolve());
    const fs::path good = folder / "good";
    fs::copy(pocl_cache, good, fs::copy_options::recursive);
    for (const char* const kind : {".bc", ".so"}) {
        for (const Damage& damage : damages) {
            SCOPED_TRACE(std::string(damage.name) + " " + kind);
            fs::remove_all(pocl_cache);
            fs::copy(good, pocl_cache, fs::copy_options::recursive);
            int damaged = 0;
            std::vector<fs::path> files;
            for (const auto& entry : fs::recursive_directory_iterator(pocl_cache))
                files.push_back(entry.path());
            for (const fs::path& file : files) {
                if (file.extension() == kind) write(file, damage.of(contents(file))), ++damaged;
                // What is not compiled yet is compiled from the .bc file.
                if (file.extension() == ".so" && kind == std::string(".bc")) fs::remove(file);
            }
            ASSERT_GT(damaged, 0);
            const Outcome outcome = resolve();
            expect_picture(outcome);
            expect(outcome, "triad: warning: PoCL died of ");
            expect(outcome, "What it keeps in " + (pocl_cache / "kcache").string() + " may be damaged");
            EXPECT_TRUE(fs::exists(pocl_cache / "kcache")) << "deleted without being asked";
        }
    }
}

TEST_F(DyingDrivers, PoCL_on_a_full_disk_gets_a_temporary_cache) {
    const fs::path disk = folder / "disk";
    fs::create_directory(disk);
    std::string mount;
    // Root of a chroot may mount, but have no users of its own.
    for (const char* user : {"", "--map-root-user "}) {
        mount = std::string("unshare --mount ") + user + "sh -c 'mount -t tmpfs -o size=40k tmpfs " +
                disk.string() + " && exec \"$@\"' sh ";
        if (std::system((mount + "true 2>/dev/null").c_str()) == 0) break;
        mount.clear();
    }
    if (mount.empty()) GTEST_SKIP() << "no small disk can be mounted here";
    const Outcome outcome = resolve("POCL_CACHE_DIR=" + disk.string() + " " + mount);
    expect_picture(outcome);
    expect(outcome, "triad: warning: PoCL died of ");
    expect(outcome, "or that disk full");
}

TEST_F(DyingDrivers, PoCL_without_a_folder_that_can_be_written_gets_a_temporary_one) {
    for (const char* variables : {"POCL_CACHE_DIR=/proc/nothing", "XDG_CACHE_HOME= HOME=/proc/nothing",
                                  "XDG_CACHE_HOME=/proc/nothing"}) {
        SCOPED_TRACE(variables);
        const Outcome outcome = resolve(variables);
        expect_picture(outcome);
        expect(outcome, "triad: warning: PoCL cannot keep compiled kernels in /proc/nothing");
        if (std::string(variables).find("POCL") == std::string::npos)
            expect(outcome, "triad: warning: Nothing can be kept for later runs: /proc/nothing");
    }
}

}  // namespace
