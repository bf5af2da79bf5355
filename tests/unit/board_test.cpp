// Boards as they are sent and set side by side, and the time that they are measured in.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "bench/time_plan.h"
#include "cli/board_scenes.h"
#include "cli/suite.h"
#include "io/io.h"
#include "report/board_json.h"
#include "report/board_page.h"
#include "report/board_plots.h"
#include "report/board_table.h"
#include "report/error_plots.h"
#include "sentence_of.h"
#include "temporary_folder.h"

namespace triad {
namespace {

const std::string hostile_name = "a<script>alert(1)</script> & \"b\" 'c'";

/// `speed` times as fast as another.
Board board(const std::string& device, double speed) {
    Board b{.device = device,
            .driver = "1.2",
            .platform = "Somewhere",
            .machine = "2 cores",
            .version = "0.1.0",
            .seconds = 60};
    const auto exactly = [](double v) { return Estimate{v, 0.9 * v, 1.1 * v}; };
    b.rows = {
        {.part = BoardPart::check, .name = "C1 edges", .value = exactly(0)},
        {.part = BoardPart::peak, .name = "multiply-adds", .value = exactly(100 * speed), .unit = "GFLOP/s"},
        {.part = BoardPart::rays,
         .name = "room, camera",
         .format = "bvh8",
         .value = exactly(8 * speed),
         .unit = "M/s"},
        {.part = BoardPart::rays,
         .name = "room, camera",
         .format = "bvh4",
         .value = exactly(4 * speed),
         .unit = "M/s"},
        {.part = BoardPart::stage,
         .name = "trace_paths",
         .format = "bvh8",
         .path_driver = "mega",
         .value = exactly(900 / speed),
         .unit = "ms/M samples",
         .note = "10 % of the roof"}};
    for (const std::string driver : {"mega", "wave"}) {
        const double seconds = (driver == "mega" ? 1 : 2) / speed;
        for (double spp = 1; spp <= 4; spp *= 2)
            b.rows.push_back({.part = BoardPart::error,
                              .name = "knot",
                              .format = "bvh8",
                              .path_driver = driver,
                              .value = exactly(0.1 / spp),
                              .unit = "relMSE",
                              .spp = spp,
                              .seconds = seconds * spp});
        b.rows.push_back({.part = BoardPart::efficiency,
                          .name = "knot",
                          .format = "bvh8",
                          .path_driver = driver,
                          .value = exactly(10 / seconds),
                          .unit = "1/s",
                          .spp = 4});
    }
    b.left_out = {"There was no time for: functions alone."};
    return b;
}

void write_boards_to(const std::filesystem::path& path, const std::vector<Board>& boards) {
    write_report(path.string(), "bench-device", nullptr, rows_of(boards), {{"boards", boards_json(boards)}});
}

}  // namespace

TEST(Boards, are_read_as_they_were_written) {
    const TemporaryFolder folder;
    std::vector<Board> boards{board(hostile_name, 1), board("other", 2)};
    boards[1].rows[1].value.high = INFINITY;
    boards[1].rows[0].is_right = false;
    write_boards_to(folder.path() / "a.json", boards);
    const std::vector<Board> read = read_boards(folder.path() / "a.json");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].device, hostile_name);
    EXPECT_EQ(read[1].left_out, boards[1].left_out);
    EXPECT_TRUE(read[0].is_right());
    EXPECT_FALSE(read[1].is_right());
    EXPECT_TRUE(std::isnan(read[1].rows[1].value.high));
    for (std::size_t b = 0; b < 2; ++b) {
        ASSERT_EQ(read[b].rows.size(), boards[b].rows.size());
        for (std::size_t i = 0; i < read[b].rows.size(); ++i) {
            const BoardRow &was = boards[b].rows[i], &is = read[b].rows[i];
            EXPECT_EQ(is.part, was.part);
            EXPECT_EQ(is.name + way_of(is) + is.unit + is.note, was.name + way_of(was) + was.unit + was.note);
            EXPECT_EQ(is.value.value, was.value.value);
            EXPECT_EQ(is.spp, was.spp);
            EXPECT_EQ(is.seconds, was.seconds);
        }
    }
}

TEST(Boards, what_is_no_report_is_refused_with_a_sentence) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.json";
    write_boards_to(path, {board("one", 1)});
    std::ifstream file(path);
    const Json good = Json::parse(file);
    const auto refusal = [&](const std::string& text) {
        std::ofstream(path) << text;
        return sentence_of(Exit::scene, [&] { read_boards(path); });
    };
    EXPECT_NE(refusal("{").find("no JSON"), std::string::npos);
    EXPECT_NE(refusal("[1]").find("no JSON object"), std::string::npos);
    EXPECT_NE(refusal("{}").find("missing"), std::string::npos);
    EXPECT_NE(refusal(R"({"schema": "triad.profile/1"})").find("triad.profile/1"), std::string::npos);
    EXPECT_NE(refusal(R"({"schema": 3})").find("its schema is 3"), std::string::npos);
    const auto changed = [&](const std::function<void(Json&)>& change) {
        Json bad = good;
        change(bad);
        return refusal(bad.dump());
    };
    for (const char* member : {"rows", "boards"})
        EXPECT_NE(changed([&](Json& j) { j.erase(member); }).find(member), std::string::npos);
    changed([](Json& j) { j["rows"] = 3; });
    changed([](Json& j) { j["rows"][0]["board"] = 7; });
    changed([](Json& j) { j["rows"][0]["board"] = -1; });
    changed([](Json& j) { j["rows"][0]["value"] = "much"; });
    changed([](Json& j) { j["rows"][0]["right"] = 1; });
    changed([](Json& j) { j["boards"][0]["left_out"] = 1; });
    EXPECT_NE(changed([](Json& j) { j["rows"][0]["part"] = "wheels"; }).find("wheels"), std::string::npos);
    EXPECT_NE(
        changed([](Json& j) { j["boards"] = Json::array(), j["rows"] = Json::array(); }).find("no board"),
        std::string::npos);
    sentence_of(Exit::scene, [&] { read_boards(folder.path() / "none.json"); });
}

TEST(Boards, stand_side_by_side_and_times_and_rates_both_say_which_is_faster) {
    const std::vector<Board> boards{board("one", 1), board("two", 2)};
    for (const BoardPart part : {BoardPart::peak, BoardPart::rays, BoardPart::stage, BoardPart::efficiency})
        for (const BoardLine& line : lines_of(boards, part)) {
            ASSERT_TRUE(line.speed_of(1)) << line.name;
            EXPECT_NEAR(*line.speed_of(1), 2, 1e-9) << line.name;
        }
    EXPECT_TRUE(lines_of(boards, BoardPart::check).empty());  // all are right
    const auto best = best_lines(boards, BoardPart::rays);
    ASSERT_EQ(best.size(), 1u);
    EXPECT_EQ(best[0].of_board[0]->format, "bvh8");
    const std::string table = table_of(boards);
    for (const char* part : {"A: one", "B: two", "16 (x2)", "450 (x2)", "1 answers right", "no time for"})
        EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
}

TEST(Boards, a_measure_that_one_lacks_has_no_speed) {
    std::vector<Board> boards{board("one", 1), board("two", 2)};
    boards[0].rows.erase(boards[0].rows.begin() + 1);
    boards[1].rows[0].is_right = false;
    const auto peaks = lines_of(boards, BoardPart::peak);
    ASSERT_EQ(peaks.size(), 1u);
    EXPECT_FALSE(peaks[0].speed_of(1));
    EXPECT_EQ(value_text(peaks[0], 0), "-");
    EXPECT_NE(table_of(boards).find("C1 edges"), std::string::npos);  // and a wrong answer is a line
    EXPECT_NE(table_of(boards).find("WRONG"), std::string::npos);
}

TEST(Boards, efficiency_is_drawn_as_points_on_a_logarithmic_axis) {
    const std::vector<Board> one{board("one", 1)}, two{board("one", 1), board("two", 2)};
    for (const auto& boards : {one, two}) {
        const std::string script = efficiency_plot_script(error_bench_of(boards), "1 / (relMSE x seconds)");
        EXPECT_NE(script.find("logscale x"), std::string::npos);
        EXPECT_EQ(script.find("box"), std::string::npos) << script;
    }
    EXPECT_EQ(error_bench_of(one).curves.size(), 2u);  // each way
    EXPECT_EQ(error_bench_of(two).curves.size(), 2u);  // each board, by its best way
    EXPECT_EQ(error_bench_of(two).curves[0].points.size(), 3u);
    EXPECT_TRUE(speed_plot_script(one).empty());
    EXPECT_NE(speed_plot_script(two).find("with points"), std::string::npos);
}

TEST(Boards, their_page_needs_nothing_from_outside_and_no_name_breaks_it) {
    const std::string page = board_page({board(hostile_name, 1), board("two", 2)}, "triad bench device");
    for (const char* part : {"a&lt;script&gt;", "no time for", "10 % of the roof", "</html>"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    for (const char* outside : {"src=\"http", "href=\"http", "url(http", "<script"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(BoardReferences, are_of_the_scenes_as_they_are_now) {
    const std::filesystem::path folder = std::filesystem::path(TRIAD_SOURCE_DIR) / "scenes";
    for (const NamedOptions& named : suite_scenes(folder)) {
        const BoardScene scene = board_scene(named, folder);
        EXPECT_GE(scene.known.spp, 8192) << named.name;
        EXPECT_LT(scene.known.relmse, 3e-4) << named.name;
        EXPECT_EQ(scene.settings.width, scene.known.mean.width);
        const Picture picture = read_picture(folder / "references" / (named.name + ".exr"));
        EXPECT_EQ(picture.metadata.at("triad:scene"), hash_of(scene.scene)) << named.name;
        EXPECT_LT(std::filesystem::file_size(folder / "references" / (named.name + ".exr")), 60'000u);
    }
}

TEST(TimePlan, begins_what_fits_and_estimates_within_the_limit) {
    TimePlan plan(100);
    for (const double guess : {500.0, 20.0, 300.0, 1.0}) plan.add(guess);
    EXPECT_LE(plan.estimate(), 100);
    EXPECT_TRUE(plan.begin());  // the first always does
    EXPECT_GT(plan.left_of_step(), 0);
    EXPECT_TRUE(plan.begin());
    EXPECT_GT(plan.left_of_step(), 0);
    EXPECT_LE(plan.estimate(), plan.left() + 1e-3);
    plan.begin();
    plan.begin();
    EXPECT_NEAR(plan.done(), 0, 1);
    TimePlan spent(0.01);
    for (const double guess : {1.0, 1.0}) spent.add(guess);
    EXPECT_TRUE(spent.begin());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_LE(spent.left_of_step(), 0);
    EXPECT_FALSE(spent.begin());
    EXPECT_EQ(spent.estimate(), 0);
    EXPECT_NEAR(spent.done(), 1, 1e-6);
}

}  // namespace triad
