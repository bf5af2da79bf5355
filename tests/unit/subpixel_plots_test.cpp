// Plots of the subpixel bench: every method once with a mark of its own, ranked, and nothing that beats the
// line of the best.
#include "report/subpixel_plots.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

using namespace triad;

namespace {

/// Twenty methods at 9 and 36 rays.
std::vector<SubpixelRow> twenty() {
    const char* const names[] = {
        "centre",    "ssaa:3",          "box",       "tent",           "gaussian",
        "mitchell",  "catmull-rom",     "lanczos",   "pane:4",         "pane-encoded:4",
        "platt",     "platt:3",         "subpixel3", "random3",        "random3:shared",
        "displaced", "triad-unrefined", "triad",     "triad-adaptive", "blackman-harris"};
    std::vector<SubpixelRow> rows;
    for (const unsigned rays : {9u, 36u})
        for (unsigned i = 0; i < std::size(names); ++i) {
            const double error = 0.4 * (1 + (i * 7 + 6) % 20) * (rays == 9 ? 2 : 1);
            SubpixelRow row{"scene",  "rgb", 45,           "scielab",
                            names[i], rays,  double(rays), {error, 0.9 * error, 1.1 * error}};
            row.seconds = 0.001 * rays * (1 + i % 5);
            rows.push_back(row);
        }
    return rows;
}

std::size_t times(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

}  // namespace

TEST(SubpixelPlots, every_method_has_a_letter_of_its_own) {
    const auto letters = method_letters(twenty());
    EXPECT_EQ(letters.size(), 20u);
    std::set<char> all;
    for (const auto& [name, letter] : letters) all.insert(letter);
    EXPECT_EQ(all.size(), 20u);
    EXPECT_EQ(method_family("ssaa:7"), "ssaa:N");
}

TEST(SubpixelPlots, dots_are_ranked_and_the_smallest_interval_is_drawn) {
    std::vector<SubpixelRow> rows = twenty();
    rows.resize(20);
    const auto letters = method_letters(rows);
    const std::string svg = ranked_dots(rows, letters);
    EXPECT_EQ(times(svg, "<circle"), 20u);
    EXPECT_EQ(times(svg, ">triad<"), 1u);
    std::string best;
    for (const auto& [name, letter] : letters)
        if (letter == 'A') best = name;
    for (const auto& [name, letter] : letters)
        if (letter != 'A' && name != "ssaa:N") {
            EXPECT_LT(svg.find(">" + best + "<"), svg.find(">" + name + "<")) << name;
        }
    EXPECT_EQ(ranked_dots({}, letters), "");
    // Errors of nothing have no logarithm.
    rows[0].error = {0, 0, 0};
    EXPECT_EQ(ranked_dots(rows, letters).find("nan"), std::string::npos);
    EXPECT_EQ(ranked_dots(rows, letters).find("inf"), std::string::npos);
}

TEST(SubpixelPlots, error_for_time_has_a_letter_for_every_row) {
    const auto rows = twenty();
    const std::string svg = error_for_time(rows, method_letters(rows));
    std::size_t marks = 0;
    for (const auto& [name, letter] : method_letters(rows))
        marks += times(svg, std::string(">") + letter + "<");
    EXPECT_EQ(marks, rows.size());
    EXPECT_EQ(times(svg, "<path"), 1u);
    if (const char* folder = std::getenv("TRIAD_PLOTS")) {  // to be looked at
        std::ofstream(std::string(folder) + "/time.svg") << svg;
        std::ofstream(std::string(folder) + "/dots.svg")
            << ranked_dots({rows.begin(), rows.begin() + 20}, method_letters(rows));
    }
}
