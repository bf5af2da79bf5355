// The whole way from bins to drives for every built-in panel: white, constants, turned panels, bright bins,
// 8 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "device_fixture.h"
#include "display/reconstruction.h"

using namespace triad;

namespace {

DisplaySettings settings_for(const std::string& panel, const std::string& method = "triad") {
    ReconstructionChoice choice;
    choice.method = method;
    choice.panel = PanelView{*builtin_panel(panel), 45};
    DisplaySettings settings;
    settings.tone_map = ToneMap::none;
    apply(reconstruction_of(choice), settings);
    return settings;
}

BinImage constant(unsigned width, unsigned height, const std::array<float, 3>& colour) {
    BinImage image{width * 3, height * 3, 3, 3, {}};
    for (unsigned i = 0; i < image.columns * image.rows; ++i)
        image.rgba.insert(image.rgba.end(), {colour[0], colour[1], colour[2], 1.0f});
    return image;
}

/// Edges and noise of black, white and colours.
BinImage busy(unsigned width, unsigned height) {
    std::mt19937 random(5);
    BinImage image{width * 3, height * 3, 3, 3, {}};
    for (unsigned y = 0; y < image.rows; ++y)
        for (unsigned x = 0; x < image.columns; ++x) {
            const bool light = (x / 11 + y / 7) % 2;
            for (int c = 0; c < 3; ++c) image.rgba.push_back(light ? 1.0f : float(random() % 100) / 400.0f);
            image.rgba.push_back(1.0f);
        }
    return image;
}

/// The image with rows as columns.
BinImage transposed(const BinImage& image) {
    BinImage t{image.rows, image.columns, image.bins_y, image.bins_x, std::vector<float>(image.rgba.size())};
    for (unsigned y = 0; y < image.rows; ++y)
        for (unsigned x = 0; x < image.columns; ++x)
            std::copy_n(&image.rgba[(y * image.columns + x) * 4], 4, &t.rgba[(x * image.rows + y) * 4]);
    return t;
}
BinImage mirrored_image(const BinImage& image) {
    BinImage m = image;
    for (unsigned y = 0; y < image.rows; ++y)
        for (unsigned x = 0; x < image.columns; ++x)
            std::copy_n(&image.rgba[(y * image.columns + x) * 4], 4,
                        &m.rgba[(y * image.columns + image.columns - 1 - x) * 4]);
    return m;
}
/// Turned clockwise.
BinImage turned_image(const BinImage& image) { return mirrored_image(transposed(image)); }

}  // namespace

TEST(PanelDrives, white_is_one_and_constants_stay_on_every_panel) {
    for (const Panel& panel : builtin_panels()) {
        const DisplaySettings settings = settings_for(panel.name);
        for (const std::array<float, 3>& colour :
             {std::array<float, 3>{1, 1, 1}, {0, 0, 0}, {0.5f, 0.2f, 0.8f}, {1, 0, 0.01f}}) {
            const auto drives = resolve_display(test_device(), constant(23, 13, colour), settings);
            for (std::size_t i = 0; i < drives.size(); ++i)
                ASSERT_NEAR(drives[i], i % 4 == 3 ? 1.0f : colour[i % 4], 1e-6) << panel.name;
            if (colour[1] == 1.0f) {
                for (const std::uint8_t code : encode_srgb(drives, 3, 8)) ASSERT_EQ(code, 255) << panel.name;
            }
        }
    }
}

TEST(PanelDrives, pictures_of_any_size_have_edges_like_their_middle) {
    for (const char* panel : {"rgb", "pentile", "qd-oled"})
        for (const auto& [width, height] : {std::pair(1u, 1u), {1u, 5u}, {7u, 1u}, {13u, 11u}, {2u, 3u}}) {
            const auto drives = resolve_display(test_device(), constant(width, height, {0.7f, 0.7f, 0.7f}),
                                                settings_for(panel));
            ASSERT_EQ(drives.size(), std::size_t(width) * height * 4);
            for (std::size_t i = 0; i < drives.size(); ++i)
                ASSERT_NEAR(drives[i], i % 4 == 3 ? 1.0f : 0.7f, 1e-6)
                    << panel << " " << width << "x" << height;
        }
}

TEST(PanelDrives, turned_and_mirrored_panels_are_turned_and_mirrored_pictures) {
    // An even number of pixels, so that the cells of PenTile, which tile from the top left corner, stay
    // cells.
    const BinImage image = busy(20, 14);
    for (const char* panel : {"rgb", "qd-oled", "pentile"}) {
        const std::string name = panel;
        const auto straight = resolve_display(test_device(), image, settings_for(name));
        const auto quarter = resolve_display(test_device(), turned_image(image), settings_for(name + "@90"));
        const auto flipped =
            resolve_display(test_device(), mirrored_image(image), settings_for(name + "@flip"));
        for (unsigned y = 0; y < 14; ++y)
            for (unsigned x = 0; x < 20; ++x)
                for (unsigned c = 0; c < 3; ++c) {
                    const float value = straight[(y * 20 + x) * 4 + c];
                    ASSERT_NEAR(quarter[(x * 14 + 13 - y) * 4 + c], value, 2e-4) << name << " turned";
                    ASSERT_NEAR(flipped[(y * 20 + 19 - x) * 4 + c], value, 2e-4) << name << " mirrored";
                }
    }
}

TEST(PanelDrives, bins_of_a_million_are_finite_drives) {
    BinImage image = busy(19, 17);
    for (std::size_t i = 0; i < image.rgba.size(); i += 44) image.rgba[i] = image.rgba[i + 1] = 1e6f;
    for (const char* method : {"triad", "displaced"})
        for (const char* panel : {"rgb", "pentile", "off"})
            for (const float v : resolve_display(test_device(), image, settings_for(panel, method)))
                ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << panel << " " << v;
}

TEST(PanelDrives, eight_bits_of_refined_drives_are_within_half_a_code) {
    const auto drives = resolve_display(test_device(), busy(31, 22), settings_for("rgb"));
    const auto codes = encode_srgb(drives, 3, 8);
    double worst = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const double v = drives[i / 3 * 4 + i % 3];
        const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        worst = std::max(worst, std::abs(encoded * 255 - codes[i]));
    }
    EXPECT_LE(worst, 0.5 + 1e-4);
}
