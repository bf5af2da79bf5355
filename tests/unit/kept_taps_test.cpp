// Taps from the user's cache are those of the designer, whatever has become of the files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "own_cache.h"
#include "panel/design.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

void expect_same(const TapTable& a, const TapTable& b, const std::string& what) {
    ASSERT_EQ(a.outputs.size(), b.outputs.size()) << what;
    EXPECT_TRUE(a.bins_x == b.bins_x && a.bins_y == b.bins_y && a.cell_x == b.cell_x && a.cell_y == b.cell_y)
        << what;
    for (std::size_t i = 0; i < a.outputs.size(); ++i) {
        const Taps &x = a.outputs[i], &y = b.outputs[i];
        EXPECT_TRUE(x.first_x == y.first_x && x.first_y == y.first_y && x.width == y.width &&
                    x.height == y.height && x.weights == y.weights && x.across == y.across &&
                    x.down == y.down && x.cross == y.cross)
            << what << ", output " << i;
    }
}

class KeptTapsElsewhere : public testing::Test {
  protected:
    const OwnCache cache;
    std::vector<fs::path> files() const { return cache.files("taps"); }
};

}  // namespace

TEST(KeptTaps, are_what_the_designer_says) {
    const auto compare = [](const Panel& panel, const TapDesign& design) {
        const TapTable fresh = design_taps(panel, 45, design);
        expect_same(kept_taps(panel, 45, design), fresh, panel.name);  // of whatever the user has
        expect_same(kept_taps(panel, 45, design), fresh, panel.name + ", kept");
    };
    for (const Panel& panel : builtin_panels()) compare(panel, {});
    compare(*builtin_panel("rgb"), {.cross_colour = true, .separable = true});
}

TEST_F(KeptTapsElsewhere, are_read_back_and_told_apart) {
    const Panel rgb = *builtin_panel("rgb");
    kept_taps(rgb, 45);
    ASSERT_EQ(files().size(), 1u);
    std::string text;
    std::getline(std::ifstream(files().front()), text);
    const std::string key = "\"first_x\":";
    const std::size_t number = text.find(key) + key.size();
    ASSERT_NE(text.substr(number, 2), "-9");
    std::ofstream(files().front()) << text.replace(number, text.find(',', number) - number, "-9");
    EXPECT_EQ(kept_taps(rgb, 45).of(0, 0, 0).first_x, -9) << "the file was not read";
    kept_taps(rgb, 46), kept_taps(rgb, 45, {.separable = true}), kept_taps(rgb, 45, {.reach = 2});
    kept_taps(*builtin_panel("bgr"), 45), kept_taps(rgb, 45, {.bins_x = 2}), kept_taps(rgb, 45);
    EXPECT_EQ(files().size(), 6u);
}

TEST_F(KeptTapsElsewhere, of_panels_that_differ_by_rounding_are_their_own) {
    const Panel bgr = *builtin_panel("bgr"), turned_rgb = *builtin_panel("rgb@180");
    ASSERT_EQ(panel_id(bgr), panel_id(turned_rgb));
    kept_taps(turned_rgb, 45);
    expect_same(kept_taps(bgr, 45), design_taps(bgr, 45), "bgr after rgb@180");
}

TEST_F(KeptTapsElsewhere, are_designed_again_when_their_file_is_damaged) {
    const Panel rgb = *builtin_panel("rgb");
    const TapTable fresh = design_taps(rgb, 45);
    kept_taps(rgb, 45);
    std::string text;
    std::getline(std::ifstream(files().front()), text);
    const auto without = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        return changed.replace(changed.find(from), from.size(), to);
    };
    for (const std::string& damaged :
         {std::string(), text.substr(0, text.size() / 2), std::string("[1, 2]"), std::string("\0\xff", 2),
          without("\"bins_x\":3", "\"bins_x\":4"), without("\"weights\":[", "\"weights\":[0.5,"),
          without("\"weights\":[", "\"weights\":[\"a\","), without("\"width\":", "\"width\":1")}) {
        std::ofstream(files().front()) << damaged;
        expect_same(kept_taps(rgb, 45), fresh, damaged.substr(0, 40));
    }
}

TEST_F(KeptTapsElsewhere, are_designed_where_nothing_can_be_kept) {
    std::ofstream(cache.folder() / "triad") << "a file where the folder would be";
    const Panel rgb = *builtin_panel("rgb");
    expect_same(kept_taps(rgb, 45), design_taps(rgb, 45), "no folder");
}
