// What stops a render costs nothing: films that were kept meanwhile go on to the bytes of a run that never
// stopped.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "io/io.h"
#include "program.h"
#include "running.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// The sentence with which the program ends with this exit code.
std::string refused(const std::string& arguments, int exit, const std::string& before = "") {
    const Outcome outcome = run_triad(arguments, before);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    return outcome.output;
}

void succeed(const std::string& arguments) { refused(arguments + " -q", 0); }

std::string film_option(const fs::path& film) { return " --film '" + film.string() + "'"; }
std::string resume_option(const fs::path& film) { return "render --resume '" + film.string() + "'"; }

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Kinds of renders: what decides where their samples go differs.
struct Kind {
    std::string name, options;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const std::vector<Kind> kinds{
    {"even", "--size 96x64 --spp 192"},
    {"bins", "--size 64x36 --bins 2x2 --spp 256"},
    {"crop_of_a_range", "--size 96x64 --crop 11,5,60,40 --samples 7:300"},
    {"adaptive", "--size 96x64 --spp 150 --adaptive on"},
    {"error", "--size 96x64 --error 4e-3"},
    {"panel", "--size 64x36 --panel rgb --ppd 45 --adaptive on --spp 180"},
    {"photons", "'" TRIAD_SCENES "/suite/glass.glb' --size 64x48 --spp 24 --integrator photons"},
    {"classic_map", "'" TRIAD_SCENES "/suite/glass.glb' --size 64x48 --spp 24 --integrator photon-map"}};

/// How often every kind is killed: TRIAD_TEST_KILLS, or 3.
int kills_of_a_kind() {
    const char* text = std::getenv("TRIAD_TEST_KILLS");
    return text ? std::atoi(text) : 3;
}

class Resume : public testing::TestWithParam<Kind> {};

}  // namespace

TEST_P(Resume, a_render_that_is_killed_at_any_moment_ends_with_the_bytes_of_one_that_is_not) {
    const Kind& kind = GetParam();
    const TemporaryFolder folder;
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    succeed("render " + kind.options + film_option(whole));  // makes ready what is made once
    fs::remove(whole);
    const Clock::time_point start = Clock::now();
    succeed("render " + kind.options + film_option(whole));
    const double took = since(start);
    std::mt19937 random(std::hash<std::string>{}(kind.name));
    int kills = 0;
    for (int rest = kills_of_a_kind(); rest > 0;) {
        const std::string how = " -q --checkpoint 0 --progress none";
        Running render(
            (fs::exists(film) ? resume_option(film) : "render " + kind.options + film_option(film)) + how);
        const double moment = std::uniform_real_distribution<double>(0, 1.2 * took)(random);
        ::usleep(useconds_t(1e6 * moment));
        render.send(SIGKILL);
        if (render.wait() == -1) {
            ++kills, --rest;
            if (fs::exists(film)) load_film(film);  // whole
        } else {                                    // it was faster, and is complete
            ASSERT_TRUE(bytes_of(film) == bytes_of(whole)) << "after " << kills << " kills";
            fs::remove(film);
        }
    }
    succeed((fs::exists(film) ? resume_option(film) : "render " + kind.options + film_option(film)));
    EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << "after " << kills << " kills";
    for (const auto& entry : fs::directory_iterator(folder / ""))
        EXPECT_TRUE(entry.path() == whole || entry.path() == film) << entry.path() << " was left";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Resume, testing::ValuesIn(kinds),
                         [](const auto& info) { return info.param.name; });

TEST(ResumeCommand, every_signal_that_asks_to_end_leaves_a_film_and_the_command_that_goes_on) {
    const TemporaryFolder folder;
    const std::string options = "render --size 64x36 --spp 3000 --seed 4";
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    succeed(options + film_option(whole));
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
        fs::remove(film);
        Running render(options + " --progress json" + film_option(film) + " --threads 1");
        ASSERT_TRUE(render.says("\"progress\"")) << render.said();
        render.send(signal);
        const std::string go_on =
            "To go on: triad render --resume " + film.string() + " --progress=json --threads=1";
        EXPECT_TRUE(render.says(go_on)) << render.said();
        EXPECT_EQ(render.wait(), 75) << signal;
        expect_contains(refused("info " + film.string(), 0), "begun as: triad render --spp=3000 --seed=4");
        succeed(resume_option(film));
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << signal;
    }
}

TEST(ResumeCommand, a_signal_that_was_ignored_stays_so) {
    const TemporaryFolder folder;
    const fs::path film = folder / "a.film";
    Running render("render --size 64x36 --spp 3000 --progress json" + film_option(film), "trap '' HUP;");
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    render.send(SIGHUP);
    EXPECT_EQ(render.wait(), 0);
}

TEST(ResumeCommand, options_may_be_repeated_goals_replaced_and_contradictions_are_named) {
    const TemporaryFolder folder;
    const fs::path whole = folder / "whole.film", film = folder / "a.film";
    const std::string options = "render --size 32x24 --seed 7";
    succeed(options + " --spp 40" + film_option(whole));
    Running render(options + " --spp 1000000 --progress json" + film_option(film));
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    render.interrupt();
    ASSERT_EQ(render.wait(), 75);
    expect_contains(refused(resume_option(film) + " --seed 8", 1), "--seed=8: the film");
    expect_contains(refused(resume_option(film) + " --max-depth 3", 1), "max_depth 0 there and 3 here");
    expect_contains(refused(resume_option(film) + " '" TRIAD_SCENES "/suite/glass.glb'", 2), "another scene");
    const unsigned more = load_film(film).samples[0] + 8;
    const std::string goal = " --spp " + std::to_string(more);
    succeed(resume_option(film) + " --seed 7" + goal);
    succeed(options + goal + film_option(folder / "more.film"));
    EXPECT_TRUE(bytes_of(film) == bytes_of(folder / "more.film"));
    expect_contains(refused(resume_option(film), 0), "is complete");
    expect_contains(refused(options + goal + film_option(film), 1), "is there already");
}

TEST(ResumeCommand, a_complete_film_goes_on_to_more_samples_and_to_another_file) {
    const TemporaryFolder folder;
    const fs::path film = folder / "a.film", more = folder / "b.film";
    succeed("render --size 32x24 --spp 8" + film_option(film));
    const std::string before = bytes_of(film);
    succeed(resume_option(film) + " --size 32x24 --spp 40" + film_option(more));
    succeed("render --size 32x24 --spp 40" + film_option(folder / "whole.film"));
    EXPECT_TRUE(bytes_of(more) == bytes_of(folder / "whole.film"));
    EXPECT_TRUE(bytes_of(film) == before);
}

TEST(ResumeCommand, a_render_that_time_ended_within_a_sample_goes_on) {
    const TemporaryFolder folder;
    for (const std::string how : {"", " --integrator photons --photons 20000"}) {
        const std::string options =
            "render '" TRIAD_SCENES "/suite/glass.glb' --size 400x300 --adaptive off" + how;
        const fs::path film = folder / "a.film", whole = folder / "whole.film";
        fs::remove(film), fs::remove(whole);
        succeed(options + " --time 0.7" + film_option(film));
        expect_contains(refused(resume_option(film), 0), "--time ended it");
        const Film cut = load_film(film);
        const std::string goal = " --spp " + std::to_string(cut.sample_numbers().most + 1);
        succeed(resume_option(film) + goal);
        succeed(options + goal + film_option(whole));
        EXPECT_TRUE(bytes_of(film) == bytes_of(whole)) << cut.sample_numbers().least << how;
    }
}

TEST(ResumeCommand, a_film_of_other_kernels_goes_on_with_a_warning) {
    const TemporaryFolder folder;
    const fs::path film = folder / "a.film", older = folder / "older.film";
    succeed("render --size 32x24 --time 0.2" + film_option(film));
    Film begun = load_film(film);
    ASSERT_TRUE(begun.progress && !begun.progress->kernels.empty());
    begun.progress->kernels = "of another version";
    save_film(older, begun);
    expect_contains(refused(resume_option(older) + " --time 0.2", 0), "rendered with other kernels");
    const Film both = load_film(older);
    EXPECT_EQ(both.progress.value().kernels, "several");
    const std::string goal = " --spp " + std::to_string(both.sample_numbers().most + 8);
    expect_contains(refused(resume_option(older) + goal, 0), "rendered with other kernels");
    const std::string said = refused(resume_option(film) + goal, 0);
    EXPECT_EQ(said.find("other kernels"), std::string::npos) << said;
    EXPECT_TRUE(bytes_of(film) == bytes_of(older)) << "the kernels were these";
}

TEST(ResumeCommand, the_holes_of_a_merged_film_are_filled) {
    const TemporaryFolder folder;
    const std::string options = "render --size 32x24 --bins 2x1";
    const fs::path film = folder / "m.film";
    succeed(options + " --samples 2:4" + film_option(folder / "a"));
    succeed(options + " --samples 8:14" + film_option(folder / "b"));
    succeed(options + " --spp 20" + film_option(folder / "whole"));
    refused("merge '" + (folder / "a").string() + "' '" + (folder / "b").string() + "' -o '" + film.string() +
                "'",
            6);
    succeed(resume_option(film) + " --size 32x24 --bins 2x1 --spp 20");
    EXPECT_TRUE(bytes_of(film) == bytes_of(folder / "whole"));
    expect_contains(refused(resume_option(folder / "a") + " --size 32x24 --bins 2x1 --error 1e-9", 1),
                    "several ranges");
}

TEST(ResumeCommand, one_process_renders_onto_a_film) {
    const TemporaryFolder folder;
    const fs::path film = folder / "a.film";
    Running render("render --size 64x36 --spp 1000000 --progress json --checkpoint 0" + film_option(film));
    ASSERT_TRUE(render.says("\"progress\"")) << render.said();
    expect_contains(refused(resume_option(film), 2), "is in use: process");
    render.send(SIGKILL);
    EXPECT_EQ(render.wait(), -1);
    succeed(resume_option(film) + " --spp 1");  // the lock went with the process
}

TEST(ResumeCommand, what_a_killed_write_left_is_removed_by_the_next_run) {
    const TemporaryFolder folder;
    std::ofstream(folder / ".a.part1.film") << "half";  // of a process that lives, but no longer writes it
    std::ofstream(folder / ".b.part999999999.png") << "half";
    std::ofstream(folder / ".b.part1.png") << "half";
    fs::last_write_time(folder / ".b.part999999999.png",
                        fs::file_time_type::clock::now() - std::chrono::hours(1));
    succeed("render --size 8x8 --spp 1" + film_option(folder / "a.film") + " -o '" +
            (folder / "b.png").string() + "'");
    EXPECT_FALSE(fs::exists(folder / ".a.part1.film"));
    EXPECT_FALSE(fs::exists(folder / ".b.part999999999.png"));
    EXPECT_TRUE(fs::exists(folder / ".b.part1.png"));
}

TEST(ResumeCommand, a_full_disk_keeps_the_old_film_and_rendering_goes_on) {
    const TemporaryFolder folder;
    const fs::path film = folder / "a.film";
    succeed("render --size 640x360 --spp 2" + film_option(film));
    const std::string before = bytes_of(film), go_on = resume_option(film) + " --size 640x360 --spp 16";
    // More than what a driver's compiler writes, less than the film.
    const std::string said = refused(go_on + " --checkpoint 0.1", 2, "ulimit -f 16000;");
    expect_contains(said, "The film as it was last written stays, and rendering goes on.");
    EXPECT_TRUE(bytes_of(film) == before);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), {}), 1);
    succeed(go_on);
    EXPECT_EQ(load_film(film).samples[0], 16u);
}

TEST(ResumeCommand, damaged_rows_are_rendered_again) {
    const TemporaryFolder folder;
    for (const std::string how : {"", "--integrator photons"}) {
        const std::string options = "'" TRIAD_SCENES "/suite/glass.glb' --size 40x40 --spp 12 " + how;
        const fs::path whole = folder / "whole.film", film = folder / "a.film";
        fs::remove(whole);
        succeed("render " + options + film_option(whole));
        std::string bytes = bytes_of(whole);
        bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 4);
        std::ofstream(film, std::ios::binary)
            << bytes.substr(0, bytes.size() - 100);  // and the end is missing
        expect_contains(refused("info '" + film.string() + "'", 0),
                        "rows 16 to 23, 32 to 39 of its crop are damaged");
        expect_contains(
            refused("resolve '" + film.string() + "' -o '" + (folder / "a.png").string() + "'", 2),
            "--resume");
        succeed(resume_option(film) + " " + options);
        const Film mended = load_film(film), right = load_film(whole);
        EXPECT_TRUE(mended.sums == right.sums) << how;
        EXPECT_TRUE(mended.half_sums == right.half_sums) << how;
        EXPECT_TRUE(mended.samples == right.samples) << how;
        EXPECT_FALSE(mended.progress.has_value());
    }
}
