// Bad and missing OpenCL drivers. Each case runs in a process of its own, because a loader reads its drivers
// once.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "device/device.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

class Drivers : public testing::Test {
  protected:
    fs::path folder;
    void SetUp() override {
        GTEST_FLAG_SET(death_test_style, "threadsafe");
        folder = fs::path(TRIAD_FAKE_DRIVER).parent_path() / "vendors";
        fs::create_directories(folder / "none");
        fs::create_directories(folder / "fake");
        std::ofstream(folder / "fake/fake.icd") << TRIAD_FAKE_DRIVER << "\n";
    }
    /// The only drivers that this process will see.
    void use(const char* name) const { ::setenv("OCL_ICD_VENDORS", (folder / name).c_str(), 1); }

    [[noreturn]] void show(const char* name) const {
        use(name);
        const DeviceList list = list_devices();
        for (const auto& [platform, why] : list.problems)
            std::cerr << "problem " << platform << ": " << why << "\n";
        for (const DeviceInfo& device : list.devices)
            std::cerr << device.index << " '" << device.name << "' " << device.type
                      << (device.usable ? " usable" : "") << (device.preferred ? " preferred" : "") << " "
                      << device.why_unusable << "\n";
        std::cerr << list.devices.size() << " devices";
        std::exit(0);
    }
    [[noreturn]] void open(const char* name, const char* selector) const {
        use(name);
        try {
            Device::open({.selector = selector});
        } catch (const Error& error) {
            std::cerr << error.what();
            std::exit(static_cast<int>(error.exit()));
        }
        std::exit(0);
    }
};

TEST_F(Drivers, that_misbehave_are_listed_and_hide_no_other) {
    EXPECT_EXIT(show("fake"), testing::ExitedWithCode(0),
                "problem Empty: The platform is installed but offers no device.\n"
                "problem Failing: The platform cannot list its devices: CL_OUT_OF_HOST_MEMORY .-6.*\n"
                "0 '' other +The driver says that the device is not available.\n"
                "1 'No compiler' other +The driver has no compiler.*\n"
                "2 'Old' other +It offers \"OpenCL 1.1\".*\n"
                "3 'Zero' other usable preferred *\n"
                "4 devices");
}

TEST_F(Drivers, that_are_missing_leave_an_empty_list_and_a_device_error) {
    EXPECT_EXIT(show("none"), testing::ExitedWithCode(0), "^0 devices");
    EXPECT_EXIT(open("none", ""), testing::ExitedWithCode(static_cast<int>(Exit::device)),
                "There is no OpenCL device. Install a driver: .*apt-get install pocl-opencl-icd");
}

TEST_F(Drivers, that_cannot_be_used_are_refused_with_the_reason) {
    EXPECT_EXIT(open("fake", "old"), testing::ExitedWithCode(static_cast<int>(Exit::usage)),
                "No usable device is called \"old\".*2  Old .other, Odd.: It offers \"OpenCL 1.1\"");
    EXPECT_EXIT(open("fake", "no such thing"), testing::ExitedWithCode(static_cast<int>(Exit::usage)),
                "3  Zero");
    EXPECT_EXIT(open("fake", "gpu"), testing::ExitedWithCode(static_cast<int>(Exit::usage)), "There are:");
}

}  // namespace
