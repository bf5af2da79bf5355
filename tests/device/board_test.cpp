// Measures of a board are of right answers: rays hit the same in every format, and a picture that is not the
// known one, or has other bits by another way, is found.
#include <gtest/gtest.h>

#include "bench/board_errors.h"
#include "bench/ray_bench.h"
#include "bench/reference_error.h"
#include "device_fixture.h"
#include "render/renderer.h"
#include "scene/builtin_scene.h"
#include "scene/film.h"
#include "scene/view.h"

namespace triad {
namespace {

const auto always = [] { return true; };

const BoardScene& little_scene() {
    static const BoardScene scene = [] {
        BoardScene s;
        s.name = "built-in", s.scene = builtin_scene();
        validate(s.scene);
        s.settings.width = 32, s.settings.height = 16;
        s.settings.view = view_of(s.scene.cameras.front(), 2);
        s.settings.seed = 77;
        Renderer renderer(test_device(), s.scene, s.settings);
        renderer.render({0, 512}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        s.known = {picture_of(film), 512, estimated_relmse(film)};
        return s;
    }();
    return scene;
}

const BoardErrorPlan little{.spp = 8, .repetitions = 2};

}  // namespace

TEST(BoardRays, of_all_kinds_hit_the_same_in_every_format) {
    const auto rows = measure_rays(test_device(), "cornell", 32, always);
    ASSERT_EQ(rows.size(), rows[2].format == "bvh8 packets" ? 7u : 6u);
    for (const BoardRow& row : rows) {
        EXPECT_TRUE(row.is_right) << row.name << " " << row.format;
        EXPECT_GT(row.value.value, 0);
        EXPECT_LE(row.value.low, row.value.high);
    }
    EXPECT_NE(rows[0].format, rows[1].format);
}

TEST(BoardErrors, fall_with_samples_to_the_known_picture) {
    FilmDigests digests;
    const auto rows = measure_errors(test_device(), little_scene(), little, digests, always);
    ASSERT_GE(rows.size(), 5u);  // 1, 2, 4, 8 and their efficiency
    EXPECT_EQ(rows.back().part, BoardPart::efficiency);
    EXPECT_TRUE(rows.back().is_right) << rows.back().note;
    const BoardRow& last = rows[rows.size() - 2];
    EXPECT_GE(last.spp, 8);
    EXPECT_LT(last.value.value, rows[0].value.value);
    for (std::size_t i = 1; i + 1 < rows.size(); ++i) EXPECT_EQ(rows[i].spp, 2 * rows[i - 1].spp);
    // The same again, by the same bits.
    EXPECT_TRUE(measure_errors(test_device(), little_scene(), little, digests, always).back().is_right);
}

TEST(BoardErrors, another_picture_is_not_right) {
    BoardScene other = little_scene();
    for (float& v : other.known.mean.rgb) v *= 1.5f;
    FilmDigests digests;
    const BoardRow row = measure_errors(test_device(), other, little, digests, always).back();
    EXPECT_FALSE(row.is_right);
    EXPECT_NE(row.note.find("Not the reference's picture"), std::string::npos) << row.note;
}

TEST(BoardErrors, other_bits_than_those_of_the_first_way_are_not_right) {
    FilmDigests digests{"another film"};
    const BoardRow row = measure_errors(test_device(), little_scene(), little, digests, always).back();
    EXPECT_FALSE(row.is_right);
    EXPECT_NE(row.note.find("other bits"), std::string::npos) << row.note;
}

TEST(BoardErrors, end_where_time_does) {
    FilmDigests digests;
    EXPECT_TRUE(measure_errors(test_device(), little_scene(), little, digests, [] { return false; }).empty());
}

}  // namespace triad
