// What is seen of a panel against what should be seen: the simulated light, the metric, and the published
// table of errors per scene and method.
#include "panel/perceived.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "base/error.h"
#include "panel/design.h"
#include "panel/simulate.h"
#include "subpixel_scenes.h"

using namespace triad;

namespace {

RgbImage flat(unsigned width, unsigned height, const vec3& colour) {
    RgbImage image{width, height, {}};
    for (unsigned i = 0; i < width * height; ++i)
        for (int c = 0; c < 3; ++c) image.rgb.push_back(colour[c]);
    return image;
}

}  // namespace

TEST(Simulate, mean_light_is_the_drive_on_every_panel) {
    for (const char* name :
         {"rgb", "vbgr", "rgb-black-matrix", "qd-oled", "pentile", "woled", "off", "pentile@90"})
        for (const unsigned samples : {3u, 5u, 12u}) {
            const vec3 colour{0.25f, 0.5f, 1.0f};
            const RgbImage light = simulate_panel(builtin_panel(name).value(), flat(6, 4, colour), samples);
            ASSERT_EQ(light.width, 6 * samples);
            dvec3 mean{0};
            for (std::size_t i = 0; i < light.rgb.size(); ++i)
                mean[int(i % 3)] += light.rgb[i] / (24.0 * samples * samples);
            // Light that pentile's emitters give beyond the border is lost.
            const double near = std::string(name).starts_with("pentile") ? 0.06 : 2e-4;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], colour[c], near) << name << samples;
        }
}

TEST(Simulate, emitters_lie_where_the_panel_says) {
    const RgbImage light = simulate_panel(builtin_panel("rgb").value(), flat(1, 1, {1, 1, 1}), 3);
    for (unsigned y = 0; y < 3; ++y)
        for (unsigned x = 0; x < 3; ++x)
            for (unsigned c = 0; c < 3; ++c)
                EXPECT_NEAR(light.rgb[(y * 3 + x) * 3 + c], x == c ? 3 : 0, 1e-5) << x << y << c;
}

TEST(Simulate, drives_that_no_display_has_are_cut) {
    const RgbImage light = simulate_panel(builtin_panel("off").value(), flat(1, 1, {-1, 7, NAN}), 3);
    EXPECT_NEAR(light.rgb[0], 0, 1e-6);
    EXPECT_NEAR(light.rgb[1], 1, 1e-6);
    EXPECT_NEAR(light.rgb[2], 0, 1e-6);
}

TEST(Perceived, equal_flat_pictures_have_no_error_but_the_stripes) {
    const vec3 colour{0.2f, 0.4f, 0.1f};
    const auto error = [&](const char* panel, Eye eye, double ppd) {
        return PerceivedMetric(builtin_panel(panel).value(), flat(24 * 12, 24 * 12, colour), 12,
                               {.ppd = ppd, .eye = eye})
            .of(flat(24, 24, colour))
            .error;
    };
    EXPECT_LT(error("off", Eye::sharp, 20), 1e-4);
    EXPECT_LT(error("rgb", Eye::scielab, 45), 1e-3);
    EXPECT_GT(error("rgb", Eye::sharp, 20), 5);
}

TEST(Perceived, a_change_of_lightness_is_its_size) {
    // Y up by .01: 1.16 units of lightness, none of colour.
    const PerceivedMetric metric(builtin_panel("off").value(), flat(12 * 3, 9 * 3, vec3(0.2f)), 3,
                                 {.border = 2, .repeats = true});
    const PerceivedError error = metric.of(flat(12, 9, vec3(0.21f)));
    EXPECT_NEAR(error.lightness, 1.16, 1e-4);
    EXPECT_NEAR(error.colour, 0, 1e-4);
    EXPECT_NEAR(error.error, 1.16, 1e-4);
    EXPECT_NEAR(error.de_mean, 116 * (std::cbrt(0.21) - std::cbrt(0.2)), 1e-3);
    EXPECT_NEAR(error.de_p95, error.de_mean, 1e-4);
    ASSERT_EQ(error.map.width, 36u);
    EXPECT_NEAR(error.map.rgb[0], 1.16, 1e-4);
}

TEST(Perceived, sizes_that_do_not_fit_are_refused) {
    const Panel rgb = builtin_panel("rgb").value();
    EXPECT_THROW(PerceivedMetric(rgb, flat(13, 12, vec3(0)), 4), Error);
    EXPECT_THROW(PerceivedMetric(rgb, flat(12, 12, vec3(0)), 2), Error);
    EXPECT_THROW(PerceivedMetric(rgb, {}, 3), Error);
    EXPECT_THROW(PerceivedMetric(rgb, flat(12, 12, vec3(0)), 4, {.border = 0}).of(flat(4, 3, vec3(0))),
                 Error);
    EXPECT_EQ(samples_per_pixel(flat(4, 2, vec3(0)), flat(12, 6, vec3(0))), 3u);
    EXPECT_THROW(samples_per_pixel(flat(4, 2, vec3(0)), flat(12, 8, vec3(0))), Error);
    EXPECT_THROW(samples_per_pixel({}, flat(12, 8, vec3(0))), Error);
    EXPECT_NO_THROW(PerceivedMetric(rgb, flat(3, 3, vec3(0)), 3, {.border = 0}).of(flat(1, 1, vec3(0))));
}

TEST(Perceived, too_small_a_picture_is_refused_with_the_size_that_is_needed) {
    const Panel rgb = builtin_panel("rgb").value();
    for (const auto& [ppd, least] : {std::pair(30.0, 22u), {45.0, 24u}, {90.0, 32u}, {110.0, 36u}}) {
        EXPECT_EQ(least_perceived_size(ppd), least);
        const auto of_size = [&, ppd = ppd](unsigned side) {
            return PerceivedMetric(rgb, flat(40 * 3, side * 3, vec3(0)), 3, {.ppd = ppd})
                .of(flat(40, side, vec3(0)));
        };
        EXPECT_NO_THROW(of_size(least));
        try {
            of_size(least - 1);
            ADD_FAILURE() << ppd;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(std::to_string(least) + " x " + std::to_string(least)),
                      std::string::npos)
                << error.what();
        }
    }
}

namespace {

using namespace subpixel_scenes;

/// A method, from samples to drives, and its published errors per scene (subpixel scenes' order) at 45 pixels
/// per degree.
struct Method {
    const char* name;
    std::function<RgbImage(const RgbImage&)> drives;
    double published[7];
};

/// The published design with these changes.
TapDesign published(TapDesign design = {}) {
    design.reach = published_design.reach, design.eyes = published_design.eyes;
    design.pull = published_design.pull;
    return design;
}

/// Means of the 2 x 2 samples around the points of each channel, in px.
RgbImage points(const RgbImage& samples, const double (&x)[3]) {
    RgbImage drives{64, 64, std::vector<float>(64 * 64 * 3)};
    for (unsigned y = 0; y < 64; ++y)
        for (unsigned px = 0; px < 64; ++px)
            for (unsigned c = 0; c < 3; ++c)
                for (unsigned k = 0; k < 4; ++k) {
                    const unsigned sx = px * 12 + unsigned(12 * x[c]) - k % 2, sy = y * 12 + 6 - k / 2;
                    drives.rgb[(y * 64 + px) * 3 + c] += samples.rgb[(sy * 768 + sx) * 3 + c] / 4;
                }
    return drives;
}

RgbImage on_film(const RgbImage& samples, const TapTable& table, Beyond beyond = Beyond::again) {
    return filtered(block_means(samples, 12 / table.bins_x, 12 / table.bins_y), table, beyond);
}

std::vector<Method> methods() {
    const Panel rgb = builtin_panel("rgb").value();
    const auto film = [](TapTable table) {
        return [table = std::move(table)](const RgbImage& s) { return on_film(s, table); };
    };
    TapTable own{3, 1, 1, 1, {}};
    for (int c = 0; c < 3; ++c) own.outputs.push_back({c, 0, 1, 1, {1}, {}, {}, {}});
    const TapTable opt3 = design_taps(rgb, 45, published());
    return {
        {"full pixel", film(full_pixel_taps(3, 3)), {2.57, 2.24, 1.69, 2.08, 1.15, 2.75, 1.74}},
        {"three rays at centres",
         [](const RgbImage& s) {
             return points(s, {1 / 6.0, 0.5, 5 / 6.0});
         },
         {.75, 2.02, 5.44, 7.83, .63, 2.94, 5.01}},
        {"three rays, jittered", film(own), {1.38, 1.73, 3.57, 5.37, .42, 1.71, 2.73}},
        {"displaced box", film(displaced_box_taps(rgb)), {1.72, .33, 1.03, 1.35, .24, 1.05, .94}},
        {"opt9",
         film(design_taps(rgb, 45, published({.cross_colour = true}))),
         {.57, .09, .48, 1.78, .08, .42, .28}},
        {"opt3", film(opt3), {.58, .09, .48, 1.77, .08, .44, .29}},
        {"opt3 separable",
         film(design_taps(rgb, 45, published({.separable = true}))),
         {.55, .08, .47, 1.74, .08, .49, .32}},
        {"opt3 on 3x1", film(design_taps(rgb, 45, published({3, 1}))), {.61, .09, .62, 2.11, .10, .48, .49}},
        {"opt3, refined",
         [opt3, stencil = design_refine(rgb, 45)](const RgbImage& s) {
             return refined(on_film(s, opt3), stencil, 8);
         },
         {.57, .09, .36, 1.16, .06, .30, .28}}};
}

}  // namespace

// 5 %, and half of the last digit that was printed. The scenes' pictures repeat there.
TEST(PublishedErrors, of_every_scene_and_method_are_found_again) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    const std::vector<Method> all = methods();
    std::vector<double> squares(all.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const RgbImage scene = load(names[i]);
        const PerceivedMetric metric(builtin_panel("rgb").value(), scene, 12, {.ppd = 45, .repeats = true});
        for (std::size_t m = 0; m < all.size(); ++m) {
            const double error = metric.of(clamped(all[m].drives(scene))).error;
            const double near = 0.05 * all[m].published[i] + 0.005;
            EXPECT_LT(error, all[m].published[i] + near) << names[i] << ", " << all[m].name;
            // Triad's refinement is better than the published one.
            if (m + 1 < all.size()) {
                EXPECT_GT(error, all[m].published[i] - near) << names[i] << ", " << all[m].name;
            }
            squares[m] += error * error / double(names.size());
        }
    }
    const auto mean = [&](std::size_t m) { return std::sqrt(squares[m]); };
    EXPECT_NEAR(mean(0), 2.10, 0.02);
    EXPECT_NEAR(mean(3), 1.07, 0.02);
    EXPECT_NEAR(mean(5), 0.76, 0.03);
    EXPECT_LT(mean(8), 0.50);
    EXPECT_LT(mean(5) / mean(3), 0.8);
}

TEST(PublishedErrors, of_other_panels_eyes_and_distances_are_found_again) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    std::vector<RgbImage> scenes;
    for (const std::string& name : names) scenes.push_back(load(name));
    const auto mean = [&](const Panel& shown_on, const TapTable& taps, const PerceivedChoice& choice) {
        double sum = 0;
        for (const RgbImage& scene : scenes) {
            const PerceivedMetric metric(shown_on, scene, 12, choice);
            const double error = metric.of(clamped(on_film(scene, taps, Beyond::mirrored))).error;
            sum += error * error / double(scenes.size());
        }
        return std::sqrt(sum);
    };
    const auto near = [](double value, double published) {
        EXPECT_NEAR(value, published, 0.05 * published + 0.005);
    };
    const Panel rgb = builtin_panel("rgb").value(), oled = builtin_panel("qd-oled").value(),
                pentile = builtin_panel("pentile").value(), bgr = builtin_panel("bgr").value();
    const PerceivedChoice sharp{.ppd = 60, .eye = Eye::sharp}, flip{.ppd = 67, .eye = Eye::flip},
        near35{.ppd = 35};
    near(mean(rgb, design_taps(rgb, 45, published()), sharp), 4.12);
    near(mean(rgb, displaced_box_taps(rgb), flip), 1.01);
    near(mean(oled, design_taps(oled, 35, published()), near35), 1.05);
    near(mean(pentile, design_taps(pentile, 35, published()), near35), 1.40);
    near(mean(builtin_panel("woled").value(), displaced_box_taps(builtin_panel("woled").value()), near35),
         3.18);
    near(mean(bgr, design_taps(rgb, 35, published()), near35),
         5.05);  // the wrong panel: worse than the full pixel's 3.03
}

namespace {

/// A picture that goes on by `more` px on all sides: copies of it.
RgbImage going_on(const RgbImage& image, unsigned more) {
    RgbImage large{image.width + 2 * more, image.height + 2 * more, {}};
    large.rgb.reserve(std::size_t(large.width) * large.height * 3);
    for (unsigned y = 0; y < large.height; ++y)
        for (unsigned x = 0; x < large.width; ++x) {
            const unsigned from_x = (x + image.width - more) % image.width,
                           from_y = (y + image.height - more) % image.height;
            const float* rgb = image.rgb.data() + (std::size_t(from_y) * image.width + from_x) * 3;
            large.rgb.insert(large.rgb.end(), rgb, rgb + 3);
        }
    return large;
}

}  // namespace

// What lies beyond a picture is not known, and must not decide: the number of a picture alone is that of the
// same pixels where the picture goes on.
TEST(Borders, tell_nothing_of_what_lies_beyond) {
    if (!present()) GTEST_SKIP() << "no " << folder();
    constexpr unsigned samples = 6, more = 32;
    double squares = 0, count = 0;
    for (const char* name : {"rgb", "qd-oled", "pentile"})
        for (const double ppd : {45.0, 90.0, 110.0}) {
            const Panel panel = builtin_panel(name).value();
            const TapTable taps = design_taps(panel, ppd), boxes = displaced_box_taps(panel);
            const RefineStencil stencil = design_refine(panel, ppd);
            for (const char* scene : {"text", "voronoi"}) {
                const RgbImage alone = block_means(load(scene), 2, 2),
                               within = going_on(alone, more * samples);
                const auto errors = [&](const RgbImage& picture, unsigned outside) {
                    const PerceivedMetric metric(panel, picture, samples,
                                                 {.ppd = ppd, .border = outside + perceived_border(ppd)});
                    const RgbImage bins = block_means(picture, 2, 2);
                    return std::pair(
                        metric.of(refined(filtered(bins, taps, Beyond::mirrored), stencil, 5)).error,
                        metric.of(clamped(filtered(bins, boxes, Beyond::mirrored))).error);
                };
                const auto [triad, box] = errors(alone, 0);
                const auto [triad_within, box_within] = errors(within, more);
                std::printf("| %s | %g | %s | %.3g | %.3g | %.3g | %.3g |\n", name, ppd, scene, triad_within,
                            triad, box_within, box);
                for (const auto& [one, other] : {std::pair(triad, triad_within), {box, box_within}}) {
                    EXPECT_NEAR(one, other, 0.1 * other + 0.002) << name << ", " << ppd << ", " << scene;
                    squares += std::pow(one / other - 1, 2), ++count;
                }
            }
        }
    EXPECT_LT(std::sqrt(squares / count), 0.04);
}
