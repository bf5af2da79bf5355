// Films on the command line: none is lost, and what a sentence says to do about one can be done.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/io.h"
#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

class FilmCommand : public testing::Test {
  protected:
    const TemporaryFolder folder_;
    const std::string here_ = "cd '" + (folder_ / "").string() + "';";

    /// What is said by a command in the folder that ends with this exit code.
    std::string said(const std::string& command, int exit) const {
        const Outcome outcome = run_triad(command, here_);
        EXPECT_EQ(outcome.exit, exit) << command << "\n" << outcome.output;
        return outcome.output;
    }
    void damage(const std::string& film) const {
        std::string bytes = bytes_of(folder_ / film);
        bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
        std::ofstream(folder_ / film, std::ios::binary) << bytes;
    }
};

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

const std::string knot = TRIAD_SCENES "/suite/knot.glb --size 40x40";

TEST_F(FilmCommand, a_complete_film_that_is_damaged_is_mended_without_a_goal) {
    said("render -q " + knot + " --spp 6 --film whole.film", 0);
    fs::copy(folder_ / "whole.film", folder_ / "a.film");
    damage("a.film");
    expect_contains(said("resolve a.film -o a.png", 2), "--resume a.film, with the scene and the options");
    expect_contains(said("render --resume a.film -o a.png", 2), "the built-in scene");
    EXPECT_FALSE(fs::exists(folder_ / "a.png"));
    said("render -q --resume a.film " + knot + " -o a.png", 0);
    EXPECT_TRUE(load_film(folder_ / "a.film").sums == load_film(folder_ / "whole.film").sums);
}

TEST_F(FilmCommand, of_a_complete_film_no_picture_is_missing_in_silence) {
    said("render -q " + knot + " --spp 2 --film a.film -o a.png", 0);
    expect_contains(said("render --resume a.film -o a.png", 0), "is complete");
    expect_contains(said("render --resume a.film -o b.png", 1), "b.png is not there");
}

TEST_F(FilmCommand, frames_go_on_beyond_complete_ones_without_pictures) {
    said("render -q " + knot + " --spp 2 -o a.png --film a.film --frames 0:1", 0);
    fs::remove(folder_ / "a.0000.png");
    expect_contains(said("render " + knot + " -o a.png --resume a.film --frames 0:2", 0),
                    "a.0000.png is not there");
    EXPECT_TRUE(fs::exists(folder_ / "a.0001.png"));
}

TEST_F(FilmCommand, what_a_film_says_to_go_on_by_goes_on) {
    said("render -q " + knot + " --time 0.1 --film a.film -o a.png", 0);
    expect_contains(said("info a.film", 0), "--resume a.film --time S");
    const double before = load_film(folder_ / "a.film").sample_numbers().mean;
    said("render -q --resume a.film --time 0.1 -o a.png", 0);
    EXPECT_GT(load_film(folder_ / "a.film").sample_numbers().mean, before);
}

TEST_F(FilmCommand, a_merge_replaces_no_film_that_holds_more) {
    const std::string render = "render -q " + knot + " --film ";
    said(render + "a.film --samples 0:2", 0);
    said(render + "b.film --samples 2:4", 0);
    said(render + "more.film --samples 0:6", 0);
    said(render + "other.film --samples 0:2 --max-depth 3", 0);
    said(render + "adaptive.film --spp 4 --adaptive on", 0);
    said(render + "guided.film --samples 0:2 --denoise own", 0);
    for (const std::string film : {"more.film", "other.film", "adaptive.film", "guided.film"}) {
        const std::string before = bytes_of(folder_ / film);
        expect_contains(said("merge a.film b.film -o " + film, 1), "holds what these films do not");
        EXPECT_TRUE(bytes_of(folder_ / film) == before);
    }
    said("merge a.film -o whole.film --expect-spp 4", 6);
    said("merge a.film b.film -o whole.film --expect-spp 4", 0);
    said("merge a.film b.film -o whole.film --expect-spp 4", 0);
}

}  // namespace
