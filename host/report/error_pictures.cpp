#include "report/error_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "display/resolve.h"
#include "io/io.h"
#include "report/small_type.h"

namespace triad {
namespace {

using Colour = std::array<double, 3>;  // 8-bit sRGB

// Both can be told apart with any kind of colour blindness. Magma: matplotlib, at equal distances; it is
// FLIP's own. The other: ColorBrewer's RdBu, blue where the picture is too dark.
constexpr Colour magma[] = {{0, 0, 4},      {28, 16, 68},   {79, 18, 123},   {129, 37, 129}, {181, 54, 122},
                            {229, 80, 100}, {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};
constexpr Colour blue_red[] = {{5, 48, 97},     {33, 102, 172},  {67, 147, 195},
                               {146, 197, 222}, {247, 247, 247}, {244, 165, 130},
                               {214, 96, 77},   {178, 24, 43},   {103, 0, 31}};

std::span<const Colour> stops_of(const ColourScale& scale) {
    return scale.signed_error ? std::span<const Colour>(blue_red) : std::span<const Colour>(magma);
}

Colour colour_of(double t, std::span<const Colour> stops) {
    const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
    Colour colour;
    for (int c = 0; c < 3; ++c)
        colour[c] = std::lerp(stops[i][c], stops[i + 1][c], x - static_cast<double>(i));
    return colour;
}

std::array<std::uint8_t, 3> false_colour(float value, const ColourScale& scale) {
    if (std::isnan(value)) return {0, 0, 0};
    const Colour colour = colour_of((value - scale.low) / (scale.high - scale.low), stops_of(scale));
    std::array<std::uint8_t, 3> bytes;
    for (std::size_t c = 0; c < 3; ++c) bytes[c] = static_cast<std::uint8_t>(std::lround(colour[c]));
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> png_of(const RgbImage& display) {
    std::vector<float> rgba(display.rgb.size() / 3 * 4, 1.0f);
    for (std::size_t i = 0; i < rgba.size(); ++i)
        if (i % 4 < 3) rgba[i] = display.rgb[i / 4 * 3 + i % 4];
    return encode_picture(".png", {display.width, display.height, 3, 8, encode_srgb(rgba, 3, 8), {}});
}

std::vector<std::uint8_t> false_colour_png(const std::vector<float>& values, unsigned width, unsigned height,
                                           const ColourScale& scale) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size() * 3);
    for (const float value : values) {
        const std::array<std::uint8_t, 3> colour = false_colour(value, scale);
        bytes.insert(bytes.end(), colour.begin(), colour.end());
    }
    return encode_picture(".png", {width, height, 3, 8, std::move(bytes), {}});
}

std::vector<std::uint8_t> false_colour_map_png(const std::vector<float>& values, unsigned width,
                                               unsigned height, const ColourScale& scale) {
    constexpr unsigned bar = 8, gap = 4, least_width = 96;
    const unsigned zoom = width >= 480 ? 2 : 1;
    BytePicture picture(std::max(width, least_width), height + bar + 3 * gap + type_height(zoom),
                        {24, 24, 24});
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x)
            picture.set(x, y, false_colour(values[std::size_t(y) * width + x], scale));
    for (unsigned x = gap; x + gap < picture.width; ++x) {
        const double t = double(x - gap) / (picture.width - 2 * gap - 1);
        for (unsigned y = 0; y < bar; ++y)
            picture.set(x, height + gap + y, false_colour(float(std::lerp(scale.low, scale.high, t)), scale));
    }
    for (const double t : {0.0, 0.5, 1.0}) {
        char text[24];
        std::snprintf(text, sizeof text, "%.3g", std::lerp(scale.low, scale.high, t));
        const unsigned room = picture.width - 2 * gap - type_width(text, zoom);
        draw_type(picture, text, gap + unsigned(t * room), height + bar + 2 * gap, zoom, {230, 230, 230});
    }
    return encode_picture(".png", {picture.width, picture.height, 3, 8, std::move(picture.rgb), {}});
}

std::string css_gradient(const ColourScale& scale) {
    std::string css = "linear-gradient(to right";
    const auto stops = stops_of(scale);
    for (const Colour& c : stops) {
        char text[16];
        std::snprintf(text, sizeof text, ", #%02x%02x%02x", unsigned(c[0]), unsigned(c[1]), unsigned(c[2]));
        css += text;
    }
    return css + ")";
}

double round_limit(const std::vector<const std::vector<float>*>& values) {
    std::vector<double> sizes;
    for (const auto* map : values)
        for (const float value : *map)
            if (std::isfinite(value)) sizes.push_back(std::abs(double(value)));
    if (sizes.empty()) return 1;
    const auto place =
        sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), place, sizes.end());
    if (*place <= 0) return 1;
    const double decade = std::pow(10.0, std::floor(std::log10(*place)));
    for (const double step : {1.0, 2.0, 5.0})
        if (*place <= step * decade) return step * decade;
    return 10 * decade;
}

}  // namespace triad
