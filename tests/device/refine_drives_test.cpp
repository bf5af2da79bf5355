// The bounded refinement of drives: against the same steps in double precision, its purpose, its pieces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "device_fixture.h"
#include "display/resolve.h"
#include "panel/pixel_filter.h"

using namespace triad;

namespace {

/// A low pass of falling weights, symmetric and positive definite, some of it between channels, that keeps no
/// pattern more than whole.
RefineStencil stencil_of(unsigned cell_x, unsigned cell_y, unsigned radius) {
    RefineStencil s{cell_x, cell_y, radius, {}};
    const int r = int(radius);
    double most = 0;
    for (unsigned phase = 0; phase < cell_x * cell_y; ++phase)
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (int dy = -r; dy <= r; ++dy)
                for (int dx = -r; dx <= r; ++dx)
                    for (int from = 0; from < 3; ++from) {
                        const double w = std::exp(-0.8 * (dx * dx + dy * dy)) * (from == c ? 1.0 : 0.3);
                        s.weights.push_back(float(w));
                        sum += w;
                    }
            most = std::max(most, sum);
        }
    for (float& w : s.weights) w /= float(most);
    return s;
}

/// d0 of every pixel and channel, as the taps give them, and the same steps as the device's.
std::vector<double> expected(const std::vector<double>& d0, int width, int height, const RefineStencil& s,
                             unsigned steps) {
    const int r = int(s.radius), side = 2 * r + 1;
    std::vector<double> v(d0.size()), turned(d0.size());
    const auto cut = [](double x) { return std::clamp(x, 0.0, 1.0); };
    for (std::size_t i = 0; i < d0.size(); ++i) v[i] = 2 * d0[i] - cut(d0[i]);
    for (unsigned step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < v.size(); ++i) turned[i] = 2 * cut(v[i]) - v[i] - d0[i];
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const std::size_t phase = (unsigned(y) % s.cell_y) * s.cell_x + unsigned(x) % s.cell_x;
                    double smooth = 0;
                    for (int dy = -r; dy <= r; ++dy)
                        for (int dx = -r; dx <= r; ++dx)
                            for (int from = 0; from < 3; ++from) {
                                if (y + dy < 0 || y + dy >= height || x + dx < 0 || x + dx >= width) continue;
                                const std::size_t at =
                                    std::size_t((y + dy) * width + x + dx) * 3 + std::size_t(from);
                                const std::size_t w = (((phase * 3 + std::size_t(c)) * std::size_t(side) +
                                                        std::size_t(dy + r)) *
                                                           std::size_t(side) +
                                                       std::size_t(dx + r)) *
                                                          3 +
                                                      std::size_t(from);
                                smooth += double(s.weights[w]) * turned[at];
                            }
                    const std::size_t i = std::size_t(y * width + x) * 3 + std::size_t(c);
                    v[i] += d0[i] - cut(v[i]) + turned[i] - smooth;
                }
    }
    for (double& x : v) x = cut(x);
    return v;
}

/// Bins of black and white, so that sharp taps leave [0, 1].
BinImage checks(unsigned width, unsigned height, unsigned bins) {
    std::mt19937 random(width + height);
    BinImage image{width * bins, height * bins, bins, bins, {}};
    for (std::size_t i = 0; i < std::size_t(image.columns) * image.rows; ++i) {
        const float level = float(random() % 4 / 3);
        image.rgba.insert(image.rgba.end(), {level, 1 - level, level, 1.0f});
    }
    return image;
}

/// One tap of weight 1.5 and neighbours that take it back.
TapTable sharp_table(unsigned bins, unsigned cell_x, unsigned cell_y) {
    TapTable table{bins, bins, cell_x, cell_y, {}};
    for (unsigned i = 0; i < cell_x * cell_y * 3; ++i)
        table.outputs.push_back({-1, 0, 3, 1, {-0.25f, 1.5f, -0.25f}, {}, {}, {}});
    return table;
}

DisplaySettings settings_of(const TapTable& table, const RefineStencil& stencil, unsigned steps) {
    DisplaySettings settings;
    settings.tone_map = ToneMap::none;
    settings.taps = table, settings.refine = stencil, settings.refine_steps = steps;
    settings.alpha = false;
    return settings;
}

std::vector<double> sharp_sums(const BinImage& image) {
    std::vector<double> d0;
    const long columns = image.columns;
    for (unsigned y = 0; y < image.height(); ++y)
        for (unsigned x = 0; x < image.width(); ++x)
            for (unsigned c = 0; c < 3; ++c) {
                double sum = 0;
                for (long u = -1; u <= 1; ++u) {
                    long at = long(x * image.bins_x) + u;
                    at = at < 0 ? -1 - at : at >= columns ? 2 * columns - 1 - at : at;
                    sum +=
                        (u == 0 ? 1.5 : -0.25) *
                        double(
                            image.rgba[(std::size_t(y * image.bins_y) * image.columns + std::size_t(at)) * 4 +
                                       c]);
                }
                d0.push_back(sum);
            }
    return d0;
}

}  // namespace

TEST(Refinement, takes_the_steps_that_it_says) {
    for (const auto& [cell_x, cell_y] : {std::pair(1u, 1u), {2u, 2u}, {3u, 1u}})
        for (const auto& [width, height] : {std::pair(1u, 1u), {1u, 9u}, {37u, 19u}, {50u, 5u}})
            for (const unsigned steps : {0u, 1u, 8u}) {
                const BinImage image = checks(width, height, 2);
                const RefineStencil stencil = stencil_of(cell_x, cell_y, 3);
                const auto shown = resolve_display(
                    test_device(), image, settings_of(sharp_table(2, cell_x, cell_y), stencil, steps));
                const auto d = expected(sharp_sums(image), int(width), int(height), stencil, steps);
                for (std::size_t i = 0; i < d.size(); ++i)
                    ASSERT_NEAR(shown[i / 3 * 4 + i % 3], d[i], 5e-6)
                        << cell_x << "x" << cell_y << ", " << width << "x" << height << ", " << steps
                        << " steps";
            }
}

TEST(Refinement, every_shape_of_work_gives_the_same_bits) {
    for (const auto& [cell_x, cell_y] : {std::pair(1u, 1u), {2u, 2u}, {1u, 3u}})
        for (const auto& [width, height] : {std::pair(1u, 1u), {1u, 9u}, {37u, 19u}, {50u, 5u}}) {
            const BinImage image = checks(width, height, 3);
            RefineStencil stencil = stencil_of(cell_x, cell_y, 2);
            for (std::size_t i = 0; i < stencil.weights.size(); ++i)  // so that no phase is like another
                stencil.weights[i] *= 1.0f - 0.1f * float(i) / float(stencil.weights.size());
            DisplaySettings settings = settings_of(sharp_table(3, cell_x, cell_y), stencil, 3);
            std::vector<float> first;
            for (const DisplayShape shape : {DisplayShape{16, 1}, {1, 1}, {1, 2}, {1, 3}, {1, 4}, {16, 2}}) {
                settings.shape = shape;
                const auto shown = resolve_display(test_device(), image, settings);
                if (first.empty()) first = shown;
                ASSERT_EQ(shown, first) << cell_x << "x" << cell_y << ", " << width << "x" << height << ", "
                                        << shape.lanes << " lanes, " << shape.rows << " rows";
            }
        }
}

TEST(Refinement, changes_nothing_that_is_not_clipped) {
    BinImage image = checks(40, 30, 2);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (i % 4 != 3) image.rgba[i] = 0.3f + 0.2f * image.rgba[i];
    DisplaySettings with = settings_of(sharp_table(2, 1, 1), stencil_of(1, 1, 4), 8), without = with;
    without.refine.reset();
    const auto a = resolve_display(test_device(), image, with),
               b = resolve_display(test_device(), image, without);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-6);
}

TEST(Refinement, white_stays_white_and_black_black) {
    for (const float level : {0.0f, 1.0f}) {
        BinImage image = checks(17, 11, 2);
        std::fill(image.rgba.begin(), image.rgba.end(), level);
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 1.0f;
        const auto shown =
            resolve_display(test_device(), image, settings_of(sharp_table(2, 2, 2), stencil_of(2, 2, 2), 8));
        for (std::size_t i = 0; i < shown.size(); ++i) ASSERT_NEAR(shown[i], i % 4 == 3 ? 1.0f : level, 1e-6);
        for (const std::uint8_t code : encode_srgb(shown, 3, 8)) ASSERT_EQ(code, level == 0.0f ? 0 : 255);
    }
}

TEST(Refinement, pieces_of_little_memory_give_the_bits_of_one) {
    Device small = limited_device(128 * 1024);
    const BinImage image = checks(80, 300, 2);
    for (const unsigned cell : {1u, 2u}) {
        const DisplaySettings settings =
            settings_of(sharp_table(2, cell, cell), stencil_of(cell, cell, 4), 8);
        EXPECT_EQ(resolve_display(small, image, settings), resolve_display(test_device(), image, settings));
    }
}

TEST(Refinement, another_panels_stencil_is_refused) {
    const BinImage image = checks(4, 4, 2);
    EXPECT_THROW(
        resolve_display(test_device(), image, settings_of(sharp_table(2, 1, 1), stencil_of(2, 1, 1), 8)),
        Error);
    RefineStencil broken = stencil_of(1, 1, 2);
    broken.weights.pop_back();
    EXPECT_THROW(resolve_display(test_device(), image, settings_of(sharp_table(2, 1, 1), broken, 8)), Error);
}
