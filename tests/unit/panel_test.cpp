// Panels as data: geometry, light, changes of direction, and the boxes of one pixel.
#include "panel/panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "panel/aperture.h"
#include "panel/design.h"
#include "panel/eye.h"

using namespace triad;

namespace {

const Emitter& fed_by(const Panel& panel, Feed feed) {
    for (const Emitter& e : panel.emitters)
        if (e.feed == feed) return e;
    throw std::logic_error("no such emitter");
}

double sum(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum;
}

}  // namespace

TEST(Panel, every_built_in_is_sound_and_white_is_d65) {
    for (const Panel& panel : builtin_panels()) {
        SCOPED_TRACE(panel.name);
        EXPECT_NO_THROW(check_panel(panel));
        const dvec3 white = panel_light(panel).white;
        EXPECT_NEAR(white.x, 0.95047, 1e-4);
        EXPECT_NEAR(white.y, 1, 1e-12);
        EXPECT_NEAR(white.z, 1.08883, 3e-4);
    }
}

TEST(Panel, a_display_upside_down_is_its_bgr_and_turned_back_is_itself) {
    const Panel bgr = builtin_panel("bgr").value(), turned_rgb = builtin_panel("rgb@180").value(),
                same = builtin_panel("rgb@90@270").value();
    for (unsigned c = 0; c < 3; ++c) {
        EXPECT_LT(glm::distance(fed_by(bgr, Feed(c)).centre, fed_by(turned_rgb, Feed(c)).centre), 1e-12);
        EXPECT_LT(
            glm::distance(fed_by(builtin_panel("rgb").value(), Feed(c)).centre, fed_by(same, Feed(c)).centre),
            1e-12);
    }
    EXPECT_LT(fed_by(builtin_panel("vrgb").value(), Feed::red).centre.y, 0.2);
    EXPECT_GT(fed_by(builtin_panel("vbgr").value(), Feed::red).centre.y, 0.8);
    EXPECT_NEAR(fed_by(builtin_panel("qd-oled@180").value(), Feed::green).centre.y, 0.75, 1e-12);
    EXPECT_NEAR(builtin_panel("woled@180").value().advice.shift.x, 0.125, 1e-12);
}

TEST(Panel, is_known_by_its_emitters_and_not_by_its_name) {
    EXPECT_EQ(panel_id(builtin_panel("bgr").value()), panel_id(builtin_panel("rgb@180").value()));
    EXPECT_EQ(panel_id(builtin_panel("pentile").value()),
              panel_id(builtin_panel("pentile@90@flip@flip@270").value()));
    EXPECT_EQ(builtin_panel("pentile@90").value().name, "pentile@90");
    std::set<std::string> ids;
    for (const Panel& panel : builtin_panels()) ids.insert(panel_id(panel));
    EXPECT_EQ(ids.size(), builtin_panels().size());
    for (const double shift : {1e-9, 0.01}) {
        Panel moved = builtin_panel("rgb").value();
        moved.emitters[1].centre.x += shift;
        EXPECT_EQ(panel_id(moved) == panel_id(builtin_panel("rgb").value()), shift < 1e-6) << shift;
    }
    Panel other = builtin_panel("rgb").value();
    std::swap(other.emitters[0].feed, other.emitters[2].feed);
    EXPECT_NE(panel_id(other), panel_id(builtin_panel("rgb").value()));
}

TEST(Panel, turns_and_mirrors_are_recorded_as_mirror_then_turns) {
    // Whatever was done in whatever order: mirroring first and then turning as recorded gives the same.
    for (const char* changes : {"@90", "@flip", "@90@flip", "@flip@90", "@270@flip@180", "@flip@90@flip"}) {
        SCOPED_TRACE(changes);
        const Panel panel = builtin_panel(std::string("pentile") + changes).value();
        Panel again = builtin_panel("pentile").value();
        if (panel.flipped) again = mirrored(again);
        again = turned(again, panel.quarter_turns);
        for (std::size_t i = 0; i < panel.emitters.size(); ++i) {
            EXPECT_LT(glm::distance(panel.emitters[i].centre, again.emitters[i].centre), 1e-12);
            EXPECT_EQ(panel.emitters[i].pixel_x, again.emitters[i].pixel_x);
            EXPECT_EQ(panel.emitters[i].pixel_y, again.emitters[i].pixel_y);
        }
    }
}

TEST(Panel, a_drive_lights_its_own_pixel_after_every_turn) {
    for (const char* name : {"pentile", "pentile@90", "pentile@180@flip", "qd-oled@270"}) {
        const Panel panel = builtin_panel(name).value();
        for (const Emitter& e : panel.emitters) {
            EXPECT_EQ(unsigned(e.centre.x), e.pixel_x) << name;
            EXPECT_EQ(unsigned(e.centre.y), e.pixel_y) << name;
        }
    }
}

TEST(Panel, unknown_names_and_changes_are_none) {
    for (const char* name : {"", "RGB", "rgb@45", "rgb@", "rgb90", "@90", "rgb@90@"})
        EXPECT_FALSE(builtin_panel(name)) << name;
}

TEST(Panel, no_panel_is_made_of_nonsense) {
    const auto refused = [](auto&& change) {
        Panel panel = builtin_panel("rgb").value();
        change(panel);
        EXPECT_THROW(check_panel(panel), Error);
    };
    refused([](Panel& p) { p.cell_x = 0; });
    refused([](Panel& p) { p.cell_y = 9; });
    refused([](Panel& p) { p.emitters.pop_back(); });  // no blue
    refused([](Panel& p) { p.emitters.clear(); });
    refused([](Panel& p) { p.emitters[1].luminance = 0; });
    refused([](Panel& p) { p.emitters[1].luminance = NAN; });
    refused([](Panel& p) { p.emitters[1].chromaticity = {0.5, 0}; });
    refused([](Panel& p) { p.emitters[1].centre.x = 4; });
    refused([](Panel& p) { p.emitters[1].pixel_x = 1; });
    refused([](Panel& p) { p.emitters[1].aperture = {}; });
    refused([](Panel& p) { p.emitters[1].aperture = {{}, -0.2}; });
    refused([](Panel& p) { p.emitters[1].aperture = {{{0, 0}, {1, 0}, {2, 0}}}; });
    refused([](Panel& p) { p.emitters[1].aperture.corners[0].x = INFINITY; });
    refused([](Panel& p) { p.emitters[1].feed = Feed::white; });
    refused([](Panel& p) { p.ppd = 0; });
}

TEST(Panel, a_channel_without_emitter_in_its_pixel_is_an_output_without_one) {
    const auto outputs = panel_outputs(builtin_panel("pentile").value());
    ASSERT_EQ(outputs.size(), 12u);
    unsigned empty = 0;
    for (const Output& o : outputs) {
        empty += o.emitters.empty();
        if (o.emitters.empty()) {
            EXPECT_LT(glm::distance(o.centre, dvec2(o.x + 0.5, o.y + 0.5)), 1e-12);
        }
    }
    EXPECT_EQ(empty, 4u);
}

TEST(Panel, degrees_are_those_of_the_usual_desks) {
    EXPECT_NEAR(pixels_per_degree(0.7, 0.7 / 3840), 67.02, 0.01);
    EXPECT_NEAR(pixels_per_degree(600, 0.2331), 44.9, 0.1);  // 27 inches, 2560 x 1440
}

TEST(Aperture, transforms_are_the_integrals_that_they_stand_for) {
    const Aperture shapes[] = {
        {{{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}}},
        {{{0, -0.38}, {0.38, 0}, {0, 0.38}, {-0.38, 0}}},
        {{{0, 0}, {0.5, 0.1}, {0.4, 0.6}, {0.2, 0.25}}},  // concave, off its centre
        {{{0, 0}, {0.2, 0.25}, {0.4, 0.6}, {0.5, 0.1}}},  // the other way around
        {{}, 0.3},
    };
    for (const Aperture& shape : shapes) {
        constexpr int n = 200;  // cells of 1/n px, each counted by the area inside of it
        constexpr double h = 1.0 / n;
        double area = 0;
        std::vector<std::pair<dvec2, double>> parts;
        for (int y = -n / 2; y < n * 7 / 10; ++y)
            for (int x = -n / 2; x < n * 7 / 10; ++x) {
                const dvec2 lo{x * h, y * h};
                const double part = aperture_overlap(shape, lo, lo + h);
                if (part > 0) area += part, parts.push_back({lo + h / 2, part});
            }
        EXPECT_NEAR(area, aperture_area(shape), 1e-9);
        for (const dvec2 f : {dvec2(0, 0), dvec2(0.015625, 0), dvec2(1, -2), dvec2(0, 3)}) {
            std::complex<double> expected = 0;
            for (const auto& [at, part] : parts) expected += std::polar(part, -2 * pi * glm::dot(f, at));
            EXPECT_LT(std::abs(aperture_transform(shape, f) - expected / area), 2e-4) << f.x << " " << f.y;
        }
        dvec2 centroid{0};
        for (const auto& [at, part] : parts) centroid += at * part / area;
        EXPECT_LT(glm::distance(centroid, aperture_centroid(shape)), 2e-5);
    }
}

TEST(Eye, sees_every_flat_colour_and_no_very_fine_pattern) {
    const dvec3 white = panel_light(builtin_panel("rgb").value()).white;
    for (const Eye eye : {Eye::scielab, Eye::sharp, Eye::flip}) {
        EXPECT_EQ(eye_named(eye_name(eye)), eye);
        const EyeResponse response(eye, white);
        const dmat3 flat = response.at(0), axes = linear_lab_of_xyz(white);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) EXPECT_NEAR(flat[c][r], axes[c][r], 1e-9);
        double last = 2;
        for (const double f : {0.0, 5.0, 15.0, 30.0, 60.0, 120.0}) {
            const double seen = contrast_sensitivity(eye, f).x;
            EXPECT_LE(seen, std::min(last, 1.0 + 1e-5));
            last = seen;
        }
        EXPECT_LT(last, 0.01);
    }
    EXPECT_FALSE(eye_named("SCIELAB"));
    // Half of the contrast in lightness at 9.4 cycles per degree: how blurry S-CIELAB is known to be.
    EXPECT_NEAR(contrast_sensitivity(Eye::scielab, 9.4).x, 0.45, 0.06);
}

TEST(Eye, lab_agrees_with_linear_axes_around_mid_grey) {
    const dvec3 white{0.95, 1, 1.09};
    const dvec3 grey = 0.1925 * white, change{0.0002, 0.0003, -0.0001};
    const dvec3 exact = lab_of_xyz(grey + change, white) - lab_of_xyz(grey, white);
    const dvec3 linear = linear_lab_of_xyz(white) * change;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(exact[i], linear[i], 0.02 * glm::length(linear));
    EXPECT_NEAR(lab_of_xyz(white, white).x, 100, 1e-9);
}

TEST(BoxTaps, lie_around_the_light_and_sum_to_one) {
    const TapTable rgb = displaced_box_taps(builtin_panel("rgb").value());
    EXPECT_EQ(rgb.of(5, 9, 0).first_x, -1);  // red: a third to the left
    EXPECT_EQ(rgb.of(5, 9, 1).first_x, 0);
    EXPECT_EQ(rgb.of(5, 9, 2).first_x, 1);
    EXPECT_EQ(rgb.of(5, 9, 0).width, 3u);
    for (const char* name : {"rgb", "qd-oled", "pentile", "woled", "off", "vrgb", "rgb@90@flip"})
        for (const unsigned bins : {1u, 2u, 3u, 4u, 5u}) {
            const Panel panel = builtin_panel(name).value();
            const TapTable table = displaced_box_taps(panel, bins, bins);
            EXPECT_EQ(table.outputs.size(), 3 * table.cell_x * table.cell_y);
            for (const Taps& taps : table.outputs) {
                EXPECT_EQ(taps.weights.size(), taps.width * taps.height);
                EXPECT_NEAR(sum(taps.weights), 1, 1e-6) << name << bins;
                EXPECT_NEAR(sum(taps.across), 1, 1e-6);
                EXPECT_NEAR(sum(taps.down), 1, 1e-6);
                for (const float w : taps.weights) EXPECT_GE(w, 0);
            }
        }
    EXPECT_EQ(displaced_box_taps(builtin_panel("off").value()).of(0, 0, 2).across,
              std::vector<float>(3, 1.0f / 3));
}

TEST(BoxTaps, a_fraction_of_a_bin_counts_as_such) {
    const TapTable woled =
        displaced_box_taps(builtin_panel("woled").value(), 4, 4);  // an eighth to the left: half a bin
    EXPECT_EQ(woled.of(0, 0, 0).first_x, -1);
    EXPECT_EQ(woled.of(0, 0, 0).across, (std::vector<float>{0.125f, 0.25f, 0.25f, 0.25f, 0.125f}));
    const TapTable coarse = displaced_box_taps(builtin_panel("qd-oled").value(), 1, 1);
    EXPECT_EQ(coarse.of(0, 0, 0).across, (std::vector<float>{0.25f, 0.75f}));
}
