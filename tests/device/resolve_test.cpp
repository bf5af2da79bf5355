// From bins to drives: against the same sums in double precision, for every kind of tap table, at edges, for
// sizes that fit nothing, and cut into pieces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "device_fixture.h"
#include "display/resolve.h"
#include "panel/pixel_filter.h"

using namespace triad;

namespace {

std::size_t mirrored(long i, long size) {
    const long r = ((i % (2 * size)) + 2 * size) % (2 * size);
    return std::size_t(r < size ? r : 2 * size - 1 - r);
}

/// What the taps add up to, R, G, B of every pixel.
std::vector<double> expected(const BinImage& image, const TapTable& table) {
    std::vector<double> drives;
    for (unsigned y = 0; y < image.height(); ++y)
        for (unsigned x = 0; x < image.width(); ++x)
            for (unsigned c = 0; c < 3; ++c) {
                const Taps& taps = table.of(x, y, c);
                double sum = 0;
                for (unsigned v = 0; v < taps.height; ++v)
                    for (unsigned u = 0; u < taps.width; ++u) {
                        const std::size_t row =
                                              mirrored(long(y * image.bins_y) + taps.first_y + v, image.rows),
                                          column = mirrored(long(x * image.bins_x) + taps.first_x + u,
                                                            image.columns),
                                          at = v * taps.width + u, n = taps.width * taps.height;
                        const float* bin = &image.rgba[(row * image.columns + column) * 4];
                        sum += double(taps.weights[at]) * bin[c];
                        if (!taps.cross.empty())
                            for (unsigned from = 0; from < 3; ++from)
                                sum += double(taps.cross[from * n + at]) * bin[from];
                    }
                drives.push_back(std::clamp(sum, 0.0, 1.0));
            }
    return drives;
}

BinImage random_image(unsigned columns, unsigned rows, unsigned bins_x, unsigned bins_y) {
    std::mt19937 random(columns * 131 + rows);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    BinImage image{columns, rows, bins_x, bins_y, {}};
    for (std::size_t i = 0; i < std::size_t(columns) * rows; ++i)
        for (int c = 0; c < 4; ++c) image.rgba.push_back(c < 3 ? value(random) : 1.0f);
    return image;
}

/// Outputs of every shape: other sizes, other places, some with what other colours add.
TapTable varied_table(unsigned bins_x, unsigned bins_y, unsigned cell_x, unsigned cell_y, bool cross) {
    std::mt19937 random(cell_x * 7 + cell_y + cross);
    std::uniform_real_distribution<float> value(-0.2f, 1.0f);
    TapTable table{bins_x, bins_y, cell_x, cell_y, {}};
    for (unsigned i = 0; i < cell_x * cell_y * 3; ++i) {
        Taps taps;
        taps.first_x = -int(i % 6), taps.first_y = 1 - int(i % 4);
        taps.width = 3 + i % 5, taps.height = 2 + i % 3;
        float sum = 0;
        for (unsigned n = 0; n < taps.width * taps.height; ++n)
            sum += taps.weights.emplace_back(value(random));
        for (float& w : taps.weights) w /= sum;
        if (cross && i % 3 != 1) {
            taps.cross.resize(3 * taps.weights.size());
            for (std::size_t n = 0; n < taps.cross.size(); ++n)
                if (n / taps.weights.size() != i % 3) taps.cross[n] = 0.1f * (n % 2 ? 1.0f : -1.0f);
        }
        table.outputs.push_back(std::move(taps));
    }
    return table;
}

DisplaySettings linear(const TapTable& table, bool alpha = false) {
    DisplaySettings settings;
    settings.tone_map = ToneMap::none;
    settings.taps = table;
    settings.alpha = alpha;
    return settings;
}

void expect_sums(Device& device, const BinImage& image, const TapTable& table, const std::string& what) {
    const std::vector<double> drives = expected(image, table);
    for (const bool alpha : {false, true}) {
        const std::vector<float> display = resolve_display(device, image, linear(table, alpha));
        ASSERT_EQ(display.size(), std::size_t(image.width()) * image.height() * 4) << what;
        double worst = 0;
        for (std::size_t i = 0; i < drives.size(); ++i)
            worst = std::max(worst, std::abs(display[i / 3 * 4 + i % 3] - drives[i]));
        EXPECT_LT(worst, 2e-6) << what << (alpha ? ", with alpha" : "");
        for (std::size_t p = 3; p < display.size(); p += 4) ASSERT_NEAR(display[p], 1.0f, 1e-6) << what;
    }
}

}  // namespace

TEST(Taps, filters_are_the_sums_that_they_say) {
    for (const std::string& name : filter_names()) {
        const BinImage image = random_image(3 * 37, 2 * 23, 3, 2);
        expect_sums(test_device(), image, filter_taps(parse_filter(name), 3, 2), name);
    }
    expect_sums(test_device(), random_image(37, 23, 1, 1), filter_taps(parse_filter("lanczos"), 1, 1), "1x1");
    expect_sums(test_device(), random_image(64, 48, 16, 16), filter_taps(parse_filter("tent"), 16, 16),
                "16x16");
}

TEST(Taps, displaced_filters_lie_where_they_are_put) {
    const std::array<dvec2, 3> emitters = {dvec2(1 / 6.0, 0.5), dvec2(0.5, 0.5), dvec2(5 / 6.0, 0.25)};
    const TapTable table = filter_taps({}, 3, 4, emitters);
    EXPECT_EQ(table.outputs[0].first_x, -1);
    EXPECT_EQ(table.outputs[2].first_x, 1);
    EXPECT_EQ(table.outputs[2].first_y, -1);
    expect_sums(test_device(), random_image(3 * 21, 4 * 10, 3, 4), table, "displaced");
}

TEST(Taps, outputs_of_a_cell_have_their_own_in_any_picture) {
    for (const auto& [cell_x, cell_y] : {std::pair(1u, 1u), {2u, 1u}, {1u, 3u}, {2u, 2u}, {3u, 2u}})
        for (const auto& [width, height] :
             {std::pair(1u, 1u), {1u, 7u}, {13u, 1u}, {2u, 2u}, {31u, 17u}, {53u, 29u}})
            for (const bool cross : {false, true})
                expect_sums(test_device(), random_image(width * 3, height * 2, 3, 2),
                            varied_table(3, 2, cell_x, cell_y, cross),
                            std::to_string(cell_x) + "x" + std::to_string(cell_y) + " in " +
                                std::to_string(width) + "x" + std::to_string(height) +
                                (cross ? " cross" : ""));
}

TEST(Taps, a_picture_whose_bins_end_within_a_pixel_reflects_the_rest) {
    for (const auto& [columns, rows] : {std::pair(1u, 1u), {4u, 5u}, {97u, 61u}, {98u, 2u}})
        expect_sums(test_device(), random_image(columns, rows, 3, 4), varied_table(3, 4, 2, 1, true),
                    std::to_string(columns) + "x" + std::to_string(rows));
}

TEST(Taps, pieces_of_little_memory_and_any_shape_of_work_give_the_bits_of_one) {
    Device small = limited_device(240 * 1024);
    const BinImage image = random_image(200 * 3, 151 * 3, 3, 3);
    for (const TapTable& table : {filter_taps(parse_filter("mitchell"), 3, 3), varied_table(3, 3, 2, 2, true),
                                  varied_table(3, 3, 1, 3, false)}) {
        DisplaySettings settings = linear(table);
        const std::vector<float> whole = resolve_display(test_device(), image, settings);
        EXPECT_EQ(resolve_display(small, image, settings), whole);
        for (const DisplayShape shape : {DisplayShape{16, 1}, {16, 2}, {1, 1}, {1, 3}, {1, 4}}) {
            settings.shape = shape;
            EXPECT_EQ(resolve_display(small, image, settings), whole)
                << shape.lanes << " lanes, " << shape.rows << " rows";
        }
    }
}

TEST(Taps, constants_stay_and_white_is_one) {
    for (const float level : {1.0f, 0.5f, 0.2f, 0.0f})
        for (const std::string& name : filter_names())
            for (const unsigned bins : {1u, 3u, 5u}) {
                BinImage image = random_image(11 * bins, 7 * bins, bins, bins);
                std::fill(image.rgba.begin(), image.rgba.end(), level);
                for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 1.0f;
                const auto display = resolve_display(test_device(), image,
                                                     linear(filter_taps(parse_filter(name), bins, bins)));
                for (std::size_t i = 0; i < display.size(); ++i)
                    ASSERT_NEAR(display[i], i % 4 == 3 ? 1.0f : level, 1e-6) << name << " " << bins;
                if (level == 1.0f) {
                    for (const std::uint8_t code : encode_srgb(display, 3, 8)) ASSERT_EQ(code, 255);
                }
            }
}

TEST(Taps, hdr_bins_give_drives_that_a_display_shows) {
    BinImage image = random_image(31 * 3, 17 * 3, 3, 3);
    for (std::size_t i = 0; i < image.rgba.size(); i += 28)
        for (int c = 0; c < 3; ++c) image.rgba[i + c] = 1e6f;
    for (const ToneOrder order : {ToneOrder::per_pixel, ToneOrder::per_bin, ToneOrder::per_bin_encoded})
        for (const ToneMap map : {ToneMap::none, ToneMap::khronos, ToneMap::aces, ToneMap::agx}) {
            DisplaySettings settings = linear(filter_taps(parse_filter("lanczos"), 3, 3));
            settings.order = order, settings.tone_map = map;
            for (const float v : resolve_display(test_device(), image, settings))
                ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << v;
        }
}

TEST(Taps, encoded_values_are_averaged_where_that_is_asked_for) {
    BinImage image{2, 1, 2, 1, {0, 0, 0, 1, 1, 1, 1, 1}};
    DisplaySettings settings = linear(filter_taps({}, 2, 1));
    settings.order = ToneOrder::per_bin_encoded;
    EXPECT_NEAR(resolve_display(test_device(), image, settings)[0], std::pow((0.5 + 0.055) / 1.055, 2.4),
                1e-6);
    image.encoded = true;  // 8-bit pictures: light is added, not codes
    image.rgba = {0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1};
    settings.order = ToneOrder::per_bin;
    settings.tone_map = ToneMap::khronos, settings.exposure_ev = 3;
    EXPECT_NEAR(resolve_display(test_device(), image, settings)[0], std::pow((0.5 + 0.055) / 1.055, 2.4),
                1e-6);
}

TEST(Taps, a_table_for_other_bins_is_refused) {
    const BinImage image = random_image(4, 4, 2, 2);
    EXPECT_THROW(resolve_display(test_device(), image, linear(filter_taps({}, 3, 3))), Error);
    TapTable broken = filter_taps({}, 2, 2);
    broken.outputs[1].weights.pop_back();
    EXPECT_THROW(resolve_display(test_device(), image, linear(broken)), Error);
    broken.outputs.pop_back();
    EXPECT_THROW(resolve_display(test_device(), image, linear(broken)), Error);
}

TEST(Background, is_there_before_the_taps) {
    // Half a pixel covered by white, on black: with taps that reach over, light of the neighbour comes in.
    BinImage image{4, 1, 2, 1, {1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
    DisplaySettings settings = linear(filter_taps({}, 2, 1));
    settings.background = vec3(0.25f, 0.5f, 1.0f);
    const auto display = resolve_display(test_device(), image, settings);
    EXPECT_NEAR(display[0], 0.625, 1e-6);
    EXPECT_NEAR(display[5], 0.5, 1e-6);
    EXPECT_EQ(display[3], 1.0f);
}
