// The filter designer against published taps, and the properties that its formulation promises.
#include "panel/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "panel/designer.h"

using namespace triad;

namespace {

/// The published design with these changes.
TapDesign published(TapDesign design = {}) {
    design.reach = published_design.reach, design.eyes = published_design.eyes;
    design.pull = published_design.pull;
    return design;
}

double total(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum;
}

/// The sums of taps over their rows (along x) or columns.
std::vector<double> marginal(const Taps& taps, bool along_x) {
    std::vector<double> sums(along_x ? taps.width : taps.height);
    for (unsigned y = 0; y < taps.height; ++y)
        for (unsigned x = 0; x < taps.width; ++x) sums[along_x ? x : y] += taps.weights[y * taps.width + x];
    return sums;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double most = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t i = 0; most < INFINITY && i < a.size(); ++i)
        most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

}  // namespace

// Published tables: a prototype's, by another method (dense least squares on twelve samples per
// pixel).

TEST(Design, agrees_with_published_taps_of_the_rgb_stripe) {
    const TapTable t45 = design_taps(builtin_panel("rgb").value(), 45, published()),
                   t80 = design_taps(builtin_panel("rgb").value(), 80, published());
    EXPECT_EQ(t45.of(0, 0, 0).first_x, -4);
    EXPECT_EQ(t45.of(0, 0, 0).first_y, -3);
    EXPECT_EQ(t45.of(0, 0, 2).first_x, -2);
    EXPECT_LT(farthest(marginal(t45.of(0, 0, 0), true),
                       {-.0456, -.0210, .0807, .3150, .3608, .2946, .0649, -.0086, -.0408}),
              .002);
    EXPECT_LT(farthest(marginal(t45.of(0, 0, 2), false),
                       {-.0662, -.0041, .0639, .3351, .3427, .3351, .0639, -.0041, -.0662}),
              .002);
    EXPECT_LT(farthest(marginal(t80.of(0, 0, 1), true),
                       {-.0418, -.0033, .0667, .3044, .3467, .3059, .0709, -.0105, -.0389}),
              .003);
    const std::vector<double> green = {
        .0070,  -.0029, -.0012, -.0262, -.0196, -.0261, -.0018, -.0014, .0062,   //
        -.0021, -.0032, .0028,  -.0061, -.0015, -.0057, .0027,  -.0021, -.0030,  //
        -.0022, .0015,  .0122,  .0157,  .0211,  .0156,  .0120,  .0022,  -.0025,  //
        -.0196, .0001,  .0176,  .1067,  .1129,  .1089,  .0201,  -.0033, -.0193,  //
        -.0133, .0040,  .0222,  .1112,  .1197,  .1130,  .0246,  .0006,  -.0124,  //
        -.0196, .0001,  .0176,  .1067,  .1129,  .1089,  .0201,  -.0033, -.0193,  //
        -.0022, .0015,  .0122,  .0157,  .0211,  .0156,  .0120,  .0022,  -.0025,  //
        -.0021, -.0032, .0028,  -.0061, -.0015, -.0057, .0027,  -.0021, -.0030,  //
        .0070,  -.0029, -.0012, -.0262, -.0196, -.0261, -.0018, -.0014, .0062};
    const auto& mine = t45.of(0, 0, 1).weights;
    EXPECT_LT(farthest({mine.begin(), mine.end()}, green), .0007);
}

TEST(Design, agrees_with_published_taps_of_triangles_and_diamonds) {
    const TapTable oled =
        design_taps(builtin_panel("qd-oled").value(), 45, published({.bins_x = 4, .bins_y = 4}));
    EXPECT_EQ(oled.of(0, 0, 0).first_x, -5);
    EXPECT_EQ(oled.of(0, 0, 1).first_y, -5);
    EXPECT_LT(farthest(marginal(oled.of(0, 0, 1), true), {-.0430, -.0234, .0150, .0699, .2182, .2593, .2611,
                                                          .2248, .0753, .0137, -.0265, -.0444}),
              .002);
    const TapTable pentile =
        design_taps(builtin_panel("pentile").value(), 45, published({.bins_x = 4, .bins_y = 4}));
    const Taps& green = pentile.of(0, 0, 1);
    EXPECT_EQ(green.first_x, -5);
    const auto row = green.weights.begin() + 4 * green.width;
    EXPECT_LT(farthest({row, row + green.width}, {-.0194, -.0098, -.0025, .0085, .0546, .0584, .0632, .0616,
                                                  .0120, .0022, -.0046, -.0127}),
              .004);  // red and blue, which are further apart, reach further than the published ones
    const Taps& blue = pentile.of(1, 0, 2);
    EXPECT_EQ(blue.first_x + 4, -1);  // in the cell's bins
    EXPECT_EQ(pentile.of(0, 0, 2).weights, full_pixel_taps(4, 4).of(0, 0, 2).weights);
}

TEST(Design, keeps_every_flat_colour) {
    for (const char* name : {"rgb", "rgb-black-matrix", "qd-oled", "pentile", "woled", "off"}) {
        const Panel panel = builtin_panel(name).value();
        for (const TapDesign& design :
             {TapDesign{.cross_colour = panel.cell_x == 1}, TapDesign{.separable = true}, TapDesign{3, 1},
              TapDesign{1, 1}, TapDesign{.bins_x = 4, .bins_y = 2, .reach = 2}})
            for (const Taps& taps : design_taps(panel, 45, design).outputs) {
                EXPECT_NEAR(total(taps.weights), 1, 1e-6) << panel.name;
                ASSERT_EQ(taps.weights.size(), taps.width * taps.height);
                if (taps.cross.empty()) continue;
                ASSERT_EQ(taps.cross.size(), 3 * taps.weights.size());
                for (unsigned j = 0; j < 3; ++j) {
                    const auto begin = taps.cross.begin() + j * taps.weights.size();
                    EXPECT_NEAR(total({begin, begin + taps.weights.size()}), 0, 1e-6);
                }
            }
    }
}

TEST(Design, a_panel_turned_or_mirrored_turns_and_mirrors_its_taps) {
    const TapTable rgb = design_taps(builtin_panel("rgb").value(), 45),
                   bgr = design_taps(builtin_panel("bgr").value(), 45),
                   vrgb = design_taps(builtin_panel("vrgb").value(), 45);
    for (unsigned c = 0; c < 3; ++c)
        for (unsigned y = 0; y < 15; ++y)
            for (unsigned x = 0; x < 15; ++x) {
                const float w = rgb.of(0, 0, c).weights[y * 15 + x];
                EXPECT_NEAR(bgr.of(0, 0, c).weights[y * 15 + 14 - x], w, 1e-6);
                EXPECT_NEAR(vrgb.of(0, 0, c).weights[x * 15 + y], w, 1e-6);
            }
    // Diamonds differ from pixel to pixel: turned, the pixels change places too.
    const TapTable pentile = design_taps(builtin_panel("pentile").value(), 45),
                   half = design_taps(builtin_panel("pentile@180").value(), 45);
    for (unsigned c = 0; c < 3; ++c)
        for (unsigned pixel = 0; pixel < 4; ++pixel) {
            const Taps &a = pentile.outputs[pixel * 3 + c], &b = half.outputs[(3 - pixel) * 3 + c];
            ASSERT_EQ(a.weights.size(), b.weights.size());
            for (std::size_t i = 0; i < a.weights.size(); ++i)
                EXPECT_NEAR(a.weights[i], b.weights[b.weights.size() - 1 - i], 1e-5);
        }
}

TEST(Design, no_small_change_of_taps_lowers_the_cost) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (const char* name : {"rgb", "qd-oled", "pentile"})
        for (const bool cross : {false, true}) {
            if (cross && std::string(name) == "pentile") continue;  // seconds
            const Designer designer(builtin_panel(name).value(), 45, published({.cross_colour = cross}));
            const auto best = designer.solve();
            const double least = designer.cost(best);
            for (int trial = 0; trial < 10; ++trial) {
                auto changed = best;
                for (const TapFilter& f : designer.filters()) {  // of constant sums
                    double sum = 0;
                    const std::size_t count = f.width * f.height;
                    for (std::size_t i = f.begin; i < f.begin + count; ++i) {
                        const double change = 1e-3 * normal(random);
                        changed[i] += change, sum += change;
                    }
                    for (std::size_t i = f.begin; i < f.begin + count; ++i) changed[i] -= sum / double(count);
                }
                EXPECT_GT(designer.cost(changed), least) << name;
            }
        }
}

TEST(Design, nine_filters_gain_little_over_three_and_both_much_over_the_box) {
    // Costs above the one of unlimited filters, published: box 11093, three 505, nine 487.
    const Panel panel = builtin_panel("rgb").value();
    const Designer three(panel, 45, published()), nine(panel, 45, published({.cross_colour = true}));
    const TapTable boxes = displaced_box_taps(panel);
    Designer::Values box(3 * 81);
    for (unsigned c = 0; c < 3; ++c)
        for (unsigned y = 3; y < 6; ++y)
            for (unsigned x = 3; x < 6; ++x) box[c * 81 + y * 9 + x] = boxes.of(0, 0, c).weights[0];
    const double of_box = three.cost(box), of_three = three.cost(three.solve()),
                 of_nine = nine.cost(nine.solve());
    EXPECT_LT(of_nine, of_three);
    EXPECT_GT((of_box - of_three) / (of_box - of_nine), 0.99);
}

TEST(Design, separable_taps_are_their_own_product) {
    for (const Taps& taps : design_taps(builtin_panel("rgb").value(), 45, {.separable = true}).outputs) {
        EXPECT_NEAR(total(taps.across), 1, 1e-6);
        EXPECT_NEAR(total(taps.down), 1, 1e-6);
        for (unsigned y = 0; y < taps.height; ++y)
            for (unsigned x = 0; x < taps.width; ++x)
                EXPECT_NEAR(taps.weights[y * taps.width + x], taps.across[x] * taps.down[y], 1e-7);
    }
    EXPECT_TRUE(design_taps(builtin_panel("rgb").value(), 45).of(0, 0, 0).across.empty());
}

TEST(Design, refuses_what_cannot_be_designed) {
    EXPECT_THROW(design_taps(builtin_panel("rgb").value(), 0), Error);
    EXPECT_THROW(design_taps(builtin_panel("rgb").value(), NAN), Error);
    EXPECT_THROW(design_taps(builtin_panel("rgb").value(), 45, {.bins_x = 0}), Error);
    EXPECT_THROW(design_taps(builtin_panel("rgb").value(), 45, {.bins_y = 17}), Error);
    EXPECT_THROW(design_taps(builtin_panel("rgb").value(), 45, {.reach = 9}), Error);
}

TEST(Design, a_whole_pixel_panel_gets_its_box) {
    EXPECT_EQ(design_taps(builtin_panel("off").value(), 45).of(3, 3, 1).weights,
              full_pixel_taps(3, 3).of(0, 0, 1).weights);
    EXPECT_EQ(design_taps(builtin_panel("woled").value(), 45).of(0, 0, 1).first_x, -1);
}

// The steps of the refinement stay bounded where the low pass has eigenvalues from 0 to 1.
TEST(Refine, keeps_of_every_pattern_between_nothing_and_all) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (const char* name : {"rgb", "vbgr", "qd-oled", "pentile"})
        for (const double ppd : {20.0, 45.0, 110.0}) {
            const RefineStencil s = design_refine(builtin_panel(name).value(), ppd);
            constexpr int n = 12;
            const int r = int(s.radius);
            const auto at = [](int x, int y) {
                return std::size_t((y + 2 * n) % n * n + (x + 2 * n) % n) * 3;
            };
            std::vector<float> d(n * n * 3), g(d.size());
            for (float& v : d) v = normal(random);
            for (int step = 0; step < 20; ++step) {
                double kept = 0, square = 0;
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x)
                        for (unsigned c = 0; c < 3; ++c) {
                            const std::size_t pixel =
                                std::size_t(y) % s.cell_y * s.cell_x + std::size_t(x) % s.cell_x;
                            const float* w = s.weights.data() +
                                             (pixel * 3 + c) * std::size_t((2 * r + 1) * (2 * r + 1) * 3);
                            double sum = 0;
                            for (int dy = -r; dy <= r; ++dy)
                                for (int dx = -r; dx <= r; ++dx, w += 3)
                                    for (unsigned j = 0; j < 3; ++j)
                                        sum += double(w[j]) * d[at(x + dx, y + dy) + j];
                            g[at(x, y) + c] = float(sum);
                            kept += sum * d[at(x, y) + c],
                                square += double(d[at(x, y) + c]) * d[at(x, y) + c];
                        }
                EXPECT_GE(kept, -1e-6 * square) << name << " " << ppd << " step " << step;
                EXPECT_LE(kept, square * (1 + 1e-6)) << name << " " << ppd << " step " << step;
                // Towards the pattern that is kept most, then towards the one that is kept least.
                for (std::size_t i = 0; i < d.size(); ++i) d[i] = step < 10 ? g[i] : d[i] - g[i];
            }
        }
}

TEST(Refine, keeps_what_eyes_see_and_leaves_out_what_they_do_not) {
    // Grey, and grey that alternates from pixel to pixel.
    for (const char* name : {"rgb", "qd-oled"}) {
        const RefineStencil s = design_refine(builtin_panel(name).value(), 45);
        const int r = int(s.radius);
        for (unsigned c = 0; c < 3; ++c) {
            double flat = 0, fine = 0;
            const float* w = s.weights.data() + c * std::size_t((2 * r + 1) * (2 * r + 1) * 3);
            for (int dy = -r; dy <= r; ++dy)
                for (int dx = -r; dx <= r; ++dx)
                    for (unsigned j = 0; j < 3; ++j, ++w) flat += *w, fine += (dx + dy) % 2 ? -*w : *w;
            EXPECT_GT(flat, 0.7) << name << c;
            EXPECT_LT(std::abs(fine), 0.5 * flat) << name << c;
        }
    }
}

TEST(Platt, agrees_with_a_prototype_at_twenty_pixels_per_degree) {
    const TapTable taps = platt_taps(builtin_panel("rgb").value(), 20, true);
    EXPECT_EQ(taps.bins_x, 3u);
    EXPECT_EQ(taps.bins_y, 1u);
    const auto of = [&](unsigned c) {
        const auto& w = taps.of(0, 0, c).weights;
        return std::vector<double>(w.begin(), w.end());
    };
    EXPECT_EQ(taps.of(0, 0, 1).first_x, 1 - 7);
    EXPECT_LT(farthest(of(1), {.010, .000, -.026, -.042, .000, .121, .267, .333, .266, .120, .000, -.043,
                               -.028, .000, .012}),
              .006);
    EXPECT_LT(farthest(of(0), {.020, .000, -.037, -.052, .000, .127, .269, .333, .271, .128, .000, -.051,
                               -.035, .000, .017}),
              .006);
    float most = 0;  // green to blue: published .055
    for (unsigned i = 0; i < 15; ++i) most = std::max(most, std::abs(taps.of(0, 0, 2).cross[15 + i]));
    EXPECT_NEAR(most, .055, .003);
}

TEST(Platt, keeps_flat_colours_turns_with_the_panel_and_refuses_triangles) {
    for (const double ppd : {20.0, 45.0, 80.0})
        for (const char* name : {"rgb", "bgr", "vrgb", "rgb-black-matrix"})
            for (const Taps& taps : platt_taps(builtin_panel(name).value(), ppd, true).outputs) {
                EXPECT_NEAR(total(taps.weights), 1, 1e-5) << name << ppd;
                EXPECT_NEAR(total(taps.cross), 0, 1e-4) << name << ppd;
            }
    const TapTable rgb = platt_taps(builtin_panel("rgb").value(), 35, false),
                   bgr = platt_taps(builtin_panel("bgr").value(), 35, false),
                   vrgb = platt_taps(builtin_panel("vrgb").value(), 35, false);
    EXPECT_TRUE(rgb.of(0, 0, 0).cross.empty());
    EXPECT_EQ(vrgb.bins_y, 3u);
    for (unsigned c = 0; c < 3; ++c)
        for (unsigned i = 0; i < 15; ++i) {
            EXPECT_NEAR(bgr.of(0, 0, c).weights[14 - i], rgb.of(0, 0, c).weights[i], 1e-5);
            EXPECT_NEAR(vrgb.of(0, 0, c).weights[i], rgb.of(0, 0, c).weights[i], 1e-6);
        }
    EXPECT_EQ(vrgb.of(0, 0, 0).first_y, -7);
    for (const char* name : {"qd-oled", "pentile", "off", "woled"})
        EXPECT_THROW(platt_taps(builtin_panel(name).value(), 45, true), Error);
}
