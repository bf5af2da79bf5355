// The first picture on a device: its check runs beside it, and ends with it.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "program.h"
#include "running.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

class FirstPicture : public testing::Test {
  protected:
    void SetUp() override {
        if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "nothing runs beside anything";
    }

    const TemporaryFolder folder_;
    const std::string own_cache_ = "XDG_CACHE_HOME=" + (folder_ / "cache").string();
    const fs::path picture_ = folder_ / "a.png", film_ = folder_ / "a.film",
                   verdicts_ = folder_ / "cache/triad/checked";
    const std::string endless_ =
        "render --size 64x36 --spp 1000000 -o " + picture_.string() + " --film " + film_.string();

    std::vector<fs::path> verdicts() const {
        std::vector<fs::path> files;
        std::error_code none;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(verdicts_, none))
            if (entry.is_regular_file()) files.push_back(entry.path());
        return files;
    }
    /// Of a process, empty where it has ended meanwhile.
    static std::string told(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        std::string text;
        std::getline(file, text, '\xff');
        return text;
    }
    /// The process that checks for the render with this cache; 0: there is none.
    pid_t checking() const {
        std::error_code failed;
        for (fs::directory_iterator at("/proc", failed), end; !failed && at != end; at.increment(failed)) {
            const fs::path process = at->path();
            if (told(process / "cmdline").find(std::string("check\0--first", 13)) != std::string::npos &&
                told(process / "environ").find(own_cache_) != std::string::npos)
                return pid_t(std::stoi(process.filename().string()));
        }
        return 0;
    }
    /// That of a render that has begun.
    pid_t check_of(Running& render) const {
        EXPECT_TRUE(render.says("is checked beside the picture")) << render.said();
        EXPECT_TRUE(soon([&] { return checking() != 0; }));
        return checking();
    }
    template <class Is>
    static bool soon(const Is& is) {
        for (int i = 0; i < 500 && !is(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return is();
    }
};

}  // namespace

TEST_F(FirstPicture, that_is_stopped_waits_for_its_check_and_is_saved) {
    Running render(endless_ + " --checkpoint 0.1 --progress json", own_cache_);
    const pid_t check = check_of(render);
    ASSERT_GT(check, 0);
    ::kill(check, SIGSTOP);
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    EXPECT_FALSE(fs::exists(film_)) << "a film of a device that may be wrong";
    render.interrupt();
    EXPECT_TRUE(render.says("Waiting for the check")) << render.said();
    EXPECT_FALSE(fs::exists(picture_) || fs::exists(film_));
    ::kill(check, SIGCONT);
    EXPECT_TRUE(render.says("To go on")) << render.said();
    EXPECT_EQ(render.wait(), 75) << render.said();
    EXPECT_TRUE(fs::exists(picture_) && fs::exists(film_)) << render.said();
    EXPECT_EQ(verdicts().size(), 1u);
}

TEST_F(FirstPicture, whose_check_dies_checks_itself) {
    Running render("render --size 16x9 --spp 1 -o " + picture_.string(), own_cache_);
    const pid_t check = check_of(render);
    ASSERT_GT(check, 0);
    ::kill(check, SIGKILL);
    EXPECT_TRUE(render.says("a few seconds to check")) << render.said();
    EXPECT_EQ(render.wait(), 0) << render.said();
    EXPECT_TRUE(fs::exists(picture_));
    EXPECT_EQ(verdicts().size(), 1u);
}

TEST_F(FirstPicture, that_is_killed_takes_its_check_along) {
    Running render(endless_, own_cache_);
    ASSERT_GT(check_of(render), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // until it knows whose it is
    render.send(SIGKILL);
    EXPECT_EQ(render.wait(), -1);
    EXPECT_TRUE(soon([&] { return checking() == 0; }));
    EXPECT_TRUE(verdicts().empty()) << "it went on to its end";
    EXPECT_FALSE(fs::exists(picture_) || fs::exists(film_)) << render.said();
}

TEST_F(FirstPicture, is_checked_before_where_the_check_would_take_its_time_or_its_processor) {
    for (const char* options : {"--time 0.1", "--threads 1 --spp 1"}) {
        fs::remove_all(verdicts_);
        const Outcome outcome =
            run_triad("render --size 16x9 " + std::string(options) + " -o " + picture_.string(), own_cache_);
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        EXPECT_NE(outcome.output.find("a few seconds to check"), std::string::npos) << outcome.output;
        EXPECT_EQ(verdicts().size(), 1u);
    }
}

TEST_F(FirstPicture, is_checked_once_where_no_verdict_can_be_kept) {
    const Outcome outcome =
        run_triad("render --size 16x9 --spp 1 -v -o " + picture_.string(), "XDG_CACHE_HOME=/dev/null");
    EXPECT_EQ(outcome.exit, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("a few seconds to check"), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find("beside the picture"), std::string::npos) << outcome.output;
}
