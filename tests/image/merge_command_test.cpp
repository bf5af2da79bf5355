// What ranges and shares of a render promise, and triad merge of their films.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "expect_exit.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

TEST(MergeCommand, three_uneven_ranges_in_any_order_give_the_bytes_of_one_run) {
    for (const std::string bins : {"1x1", "2x2"}) {
        const TemporaryFolder folder;
        const std::string render = "render --size 40x24 --bins " + bins + " --film " + (folder / "").string();
        expect_exit(0, render + "whole --samples 0:24");
        expect_exit(0, render + "a --samples 0:4");
        expect_exit(0, render + "b --samples 4:20");
        expect_exit(0, render + "c --samples 20:24");
        const std::string whole = bytes_of(folder / "whole");
        for (const char* order : {"a b c", "a c b", "b a c", "b c a", "c a b", "c b a"}) {
            const Outcome merged = run_triad("merge " + std::string(order) + " -o m --expect-spp 24",
                                             "cd '" + (folder / "").string() + "';");
            ASSERT_EQ(merged.exit, 0) << merged.output;
            EXPECT_TRUE(bytes_of(folder / "m") == whole) << order << ", bins " << bins;
        }
    }
}

TEST(MergeCommand, an_incomplete_merge_names_the_samples_that_are_missing) {
    const TemporaryFolder folder;
    const std::string render = "render --size 8x8 --film " + (folder / "").string();
    expect_exit(0, render + "a --samples 0:2");
    expect_exit(0, render + "b --samples 5:8");
    const Outcome merged = run_triad("merge b a -o m --expect-spp 9", "cd '" + (folder / "").string() + "';");
    EXPECT_EQ(merged.exit, 6) << merged.output;
    EXPECT_NE(merged.output.find("--samples 2:5 --samples 8:9"), std::string::npos) << merged.output;
    EXPECT_TRUE(fs::exists(folder / "m"));
}

TEST(MergeCommand, ranges_of_more_samples_than_a_render_takes_are_refused) {
    for (const std::string range : {"0:4294967296", "0:4294967360", "5:1073741830"}) {
        const Outcome refused = run_triad("render -q --size 8x8 --samples " + range);
        EXPECT_EQ(refused.exit, 1) << range;
        EXPECT_NE(refused.output.find("--samples"), std::string::npos) << refused.output;
    }
}

TEST(MergeCommand, shares_of_a_render_add_up_to_it) {
    const TemporaryFolder folder;
    const std::string render = "render --size 40x24 --bins 2x1 --spp 13 --film " + (folder / "").string();
    expect_exit(0, render + "whole");
    std::string parts;
    for (const std::string share : {"0/3", "1/3", "2/3"}) {
        parts += " part" + share.substr(0, 1);
        expect_exit(0, render + "part" + share.substr(0, 1) + " --samples share:" + share);
    }
    const Outcome merged =
        run_triad("merge" + parts + " -o m --expect-spp 14", "cd '" + (folder / "").string() + "';");
    EXPECT_EQ(merged.exit, 0) << merged.output;
    EXPECT_TRUE(bytes_of(folder / "m") == bytes_of(folder / "whole"));
    expect_exit(1, render + "none --samples share:0/9");  // fewer turns of the bins than shares
    expect_exit(1, render + "none --samples share:3/3");
    expect_exit(1, "render --size 8x8 --samples share:0/2");
}
