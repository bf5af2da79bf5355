// Whatever a shell allows a program, it ends in a picture or in a sentence.
#include <gtest/gtest.h>

#include <string>

#include "program.h"
#include "unit/temporary_folder.h"

namespace {

/// The loader's own sentence ends with this one.
constexpr int loader_refused = 127;

/// What a render within a limit says; "" where it succeeds.
std::string sentence_within(const std::string& limit, const std::string& picture = "a.png") {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_triad("render --size 8x8 --spp 1 -q -o " + (folder / picture).string(), limit + ";");
    const bool is_told =
        outcome.exit == 4 || outcome.exit == 5 || outcome.exit == loader_refused || outcome.exit == 0;
    EXPECT_TRUE(is_told) << limit << ": " << outcome.exit << " " << outcome.output;
    EXPECT_EQ(outcome.output.find("terminate called"), std::string::npos) << outcome.output;
    if (outcome.exit == 0) return {};
    EXPECT_NE(outcome.output.find(outcome.exit == loader_refused ? "error while loading" : "triad: "),
              std::string::npos)
        << limit << ": " << outcome.output;
    return outcome.output;
}

}  // namespace

TEST(ShellLimits, address_space_from_less_than_the_libraries_to_enough) {
    std::string last = "nothing";
    for (int kilobytes = 10'000; kilobytes <= 1'550'000; kilobytes += kilobytes < 100'000 ? 10'000 : 50'000)
        last = sentence_within("ulimit -v " + std::to_string(kilobytes));
    EXPECT_EQ(last, "");
}

/// Their libraries start later than the program.
TEST(ShellLimits, address_space_for_pictures_that_other_libraries_write) {
    bool is_start_named = false;
    std::string last = "nothing";
    for (int kilobytes = 350'000; kilobytes <= 1'550'000; kilobytes += 50'000) {
        last = sentence_within("ulimit -v " + std::to_string(kilobytes), "a.hdr");
        is_start_named |= last.find("cannot start within") != std::string::npos;
    }
    EXPECT_TRUE(is_start_named);
    EXPECT_EQ(last, "");
}

TEST(ShellLimits, stacks_that_are_too_small_are_named) {
    for (const char* kilobytes : {"32", "64", "128"})
        EXPECT_NE(sentence_within(std::string("ulimit -s ") + kilobytes).find("ulimit -s"),
                  std::string::npos);
    EXPECT_EQ(sentence_within("ulimit -s 512"), "");
}
