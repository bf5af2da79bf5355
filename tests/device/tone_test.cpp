// Tone maps against their published formulas in double precision, and the resolve from bins to pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "device_fixture.h"
#include "display/resolve.h"
#include "kernels/types.h"

using namespace triad;

namespace {

using Rgb = std::array<double, 3>;

Rgb khronos(Rgb c) {
    const double x = std::min({c[0], c[1], c[2]}), offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (double& v : c) v -= offset;
    const double peak = std::max({c[0], c[1], c[2]}), start = 0.8 - 0.04, d = 1 - start;
    if (peak < start) return c;
    const double to = 1 - d * d / (peak + d - start), g = 1 - 1 / (0.15 * (peak - to) + 1);
    for (double& v : c) v = v * to / peak * (1 - g) + to * g;
    return c;
}

Rgb times(const double (&m)[3][3], const Rgb& v) {
    Rgb out{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[i] += m[i][j] * v[j];
    return out;
}

Rgb aces(const Rgb& c) {
    static const double in[3][3] = {
        {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
    static const double out[3][3] = {
        {1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602}};
    Rgb v = times(in, c);
    for (double& x : v) x = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
    return times(out, v);
}

Rgb agx(const Rgb& c) {
    static const double in[3][3] = {{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                    {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                    {0.0423756549057051, 0.0784336, 0.879142973793104}};
    static const double out[3][3] = {{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                     {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                     {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}};
    Rgb v = times(in, c);
    for (double& x : v) {
        x = std::clamp((std::log2(x) + 12.47393) / (4.026069 + 12.47393), 0.0, 1.0);
        x = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) - 6.868 * x * x * x +
            0.4298 * x * x + 0.1191 * x - 0.00232;
    }
    v = times(out, v);
    for (double& x : v) x = std::pow(std::max(x, 0.0), 2.2);
    return v;
}

const char* const source = R"(#include "common/language.h"
#include "subpixel/tone_map.h"
__kernel void map_all(__global const float* radiance, __global float* display, uint count, uint which) {
    const uint i = get_global_id(0);
    if (i < count) vec3_store(tone_map(which, vec3_load(radiance, i)), display, i);
}
)";

std::vector<float> map_all(std::uint32_t which, const std::vector<float>& radiance) {
    Device& device = test_device();
    const Buffer in = device.upload(radiance), out = device.allocate(radiance.size() * sizeof(float));
    const auto count = std::uint32_t(radiance.size() / 3);
    device.run(device.build_source("tone_test.cl", source).kernel("map_all"),
               Arguments().add(in).add(out).add(count).add(which), count);
    return device.download<float>(out);
}

/// Colours over 12 decades, saturated and grey.
std::vector<float> colours(std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> exponent(-6.0f, 6.0f), ratio(-2.0f, 0.0f);
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        const float level = std::pow(10.0f, exponent(random));
        for (int c = 0; c < 3; ++c)
            values.push_back(level * (i % 4 == 0 ? 1.0f : std::pow(10.0f, ratio(random))));
    }
    return values;
}

void expect_like(std::uint32_t which, Rgb (*reference)(const Rgb&), double tolerance) {
    const std::vector<float> in = colours(20000), out = map_all(which, in);
    double worst = 0;
    for (std::size_t i = 0; i < in.size(); i += 3) {
        const Rgb expected = reference({in[i], in[i + 1], in[i + 2]});
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(out[i + c] - std::clamp(expected[c], 0.0, 1.0)));
    }
    EXPECT_LT(worst, tolerance);
}

/// A film whose bin values are given: one sample per bin.
Film film_of(unsigned width, unsigned height, unsigned bins_x, unsigned bins_y,
             const std::vector<float>& rgba) {
    Film film;
    film.full_width = film.width = width, film.full_height = film.height = height;
    film.bins_x = bins_x, film.bins_y = bins_y;
    film.quanta_log2 = 20;
    for (const float v : rgba) film.sums.push_back(std::int64_t(std::ldexp(double(v), 20)));
    film.half_sums.resize(film.pixels() * 3);
    film.samples.assign(film.pixels(), unsigned(film.bins()));
    film.ranges = {{0, film.bins()}};
    return film;
}

}  // namespace

// Tolerances: a few units in the last place of values near 1; AgX adds the cancellation in a sixth-degree
// polynomial with coefficients of 40.
TEST(ToneMap, khronos_is_the_published_curve) {
    expect_like(
        TONE_MAP_KHRONOS, [](const Rgb& c) { return khronos(c); }, 5e-7);
}
TEST(ToneMap, aces_is_the_published_fit) { expect_like(TONE_MAP_ACES, aces, 1e-6); }
TEST(ToneMap, agx_is_the_published_fit) { expect_like(TONE_MAP_AGX, agx, 2e-5); }
TEST(ToneMap, none_only_clamps) {
    expect_like(
        TONE_MAP_NONE, [](const Rgb& c) { return c; }, 1e-9);
}

TEST(ToneMap, khronos_takes_only_the_fresnel_reflection_below_its_start_of_compression) {
    // c - .04 up to .8, 6.25 c^2 below .08: the specification's two branches.
    const auto out = map_all(TONE_MAP_KHRONOS, {0.5f, 0.3f, 0.1f, 0.79f, 0.4f, 0.08f, 0.04f, 0.04f, 0.04f});
    const float expected[] = {0.46f, 0.26f, 0.06f, 0.75f, 0.36f, 0.04f, 0.01f, 0.01f, 0.01f};
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(out[i], expected[i], 1e-6) << i;
}

TEST(ToneMap, middle_grey_is_where_each_curve_puts_it) {
    const std::vector<float> grey(3, 0.18f);
    EXPECT_NEAR(map_all(TONE_MAP_KHRONOS, grey)[1], 0.14, 1e-6);
    EXPECT_NEAR(map_all(TONE_MAP_ACES, grey)[1], 0.1056, 2e-3);             // ACES: a tenth of white
    EXPECT_NEAR(map_all(TONE_MAP_AGX, grey)[1], std::pow(0.5, 2.2), 1e-2);  // AgX: half of the code range
}

TEST(ToneMap, brighter_is_never_darker) {
    std::vector<float> greys;
    for (double stop = -16; stop < 30; stop += 1.0 / 64) greys.insert(greys.end(), 3, float(std::exp2(stop)));
    for (const std::uint32_t which : {TONE_MAP_NONE, TONE_MAP_KHRONOS, TONE_MAP_ACES, TONE_MAP_AGX}) {
        const auto out = map_all(which, greys);
        for (std::size_t i = 3; i < out.size(); ++i)
            ASSERT_GE(out[i], out[i - 3] - 2e-6f) << which << " " << greys[i];
        EXPECT_GT(out.back(), 0.97f) << which;
    }
}

TEST(ToneMap, any_float_gives_a_displayable_one) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> strange{nan,   inf,  -inf,   1e6f,   3.4e38f, -1.0f,
                                     -0.0f, 0.0f, 1e-45f, 1e-38f, 1e20f};
    std::vector<float> in;
    for (const float r : strange)
        for (const float g : strange)
            for (const float b : strange) in.insert(in.end(), {r, g, b});
    for (const std::uint32_t which : {TONE_MAP_NONE, TONE_MAP_KHRONOS, TONE_MAP_ACES, TONE_MAP_AGX})
        for (const float v : map_all(which, in)) ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << which << " " << v;
}

TEST(ToneMap, colours_outside_the_gamut_keep_their_luminance_until_none_is_negative) {
    const auto luminance = [](const float* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
    const std::vector<float> in{-0.1f, 0.5f, 0.2f, 0.6f, -0.05f, -0.2f, 0.3f, 0.4f, 0.5f, -1.0f, 0.1f, 0.9f};
    const std::vector<float> out = map_all(TONE_MAP_NONE, in);
    for (std::size_t i = 0; i < 6; i += 3) {
        EXPECT_NEAR(luminance(&out[i]), luminance(&in[i]), 1e-6);
        EXPECT_NEAR(std::min({out[i], out[i + 1], out[i + 2]}), 0.0, 1e-6);
        // on the line from the colour to the grey of its luminance
        EXPECT_NEAR((out[i] - luminance(&in[i])) * (in[i + 1] - luminance(&in[i])),
                    (out[i + 1] - luminance(&in[i])) * (in[i] - luminance(&in[i])), 1e-6);
    }
    EXPECT_EQ(std::vector<float>(out.begin() + 6, out.begin() + 9), (std::vector<float>{0.3f, 0.4f, 0.5f}));
    EXPECT_EQ(std::vector<float>(out.begin() + 9, out.end()), std::vector<float>(3, 0.0f))
        << "no light is left where luminance is negative";
}

TEST(Resolve, exposure_counts_in_stops) {
    const Film film = film_of(1, 1, 1, 1, {0.125f, 0.25f, 0.5f, 1.0f});
    const auto display =
        resolve_display(test_device(), film, {.exposure_ev = 1.0f, .tone_map = ToneMap::none});
    EXPECT_EQ(display, (std::vector<float>{0.25f, 0.5f, 1.0f, 1.0f}));
}

TEST(Resolve, a_bright_bin_saturates_itself_and_not_its_pixel) {
    const Film film = film_of(1, 1, 2, 1, {1000, 1000, 1000, 1, 0, 0, 0, 1});
    const double shown = khronos({1000, 1000, 1000})[0], mean = khronos({500, 500, 500})[0];
    EXPECT_NEAR(resolve_display(test_device(), film, {.order = ToneOrder::per_bin})[0], shown / 2, 1e-6);
    EXPECT_NEAR(resolve_display(test_device(), film, {.order = ToneOrder::per_pixel})[0], mean, 1e-6);
}

TEST(Resolve, coverage_does_not_change_the_tone_of_what_is_covered) {
    const Film film = film_of(1, 1, 1, 1, {2.0f, 1.0f, 0.5f, 0.5f});
    const Rgb full = khronos({4.0, 2.0, 1.0});
    for (const ToneOrder order : {ToneOrder::per_pixel, ToneOrder::per_bin, ToneOrder::per_bin_encoded}) {
        const auto display = resolve_display(test_device(), film, {.order = order});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(display[c], full[c] / 2, 1e-6);
        EXPECT_EQ(display[3], 0.5f);
    }
}

TEST(Resolve, a_pixel_without_samples_is_transparent_black) {
    Film film = film_of(1, 1, 1, 1, {0, 0, 0, 0});
    film.samples[0] = 0;
    EXPECT_EQ(resolve_display(test_device(), film, {}), std::vector<float>(4, 0.0f));
}

TEST(Resolve, pixels_keep_their_places_over_many_slabs) {
    const unsigned width = 700, height = 500;  // 350 000 pixels: more than one slab
    std::vector<float> rgba;
    for (unsigned p = 0; p < width * height; ++p)
        for (const unsigned v : {p % 1009, p % 997, p % 503, 1024u}) rgba.push_back(float(v) / 1024.0f);
    const Film film = film_of(width, height, 1, 1, rgba);
    EXPECT_EQ(resolve_display(test_device(), film, {.tone_map = ToneMap::none}), rgba);
    EXPECT_EQ(resolve_linear(film), rgba);
}

TEST(Encode, eight_and_sixteen_bits_round_to_nearest_and_divide_by_alpha) {
    const std::vector<float> rgba{0.0f, 1.0f, 0.5f, 1.0f, 0.25f, 0.125f, 0.0f, 0.5f, 2.0f, -1.0f, NAN, 0.0f};
    EXPECT_EQ(encode_srgb(rgba, 4, 8),
              (std::vector<std::uint8_t>{0, 255, 188, 255, 188, 137, 0, 128, 255, 0, 0, 0}));
    EXPECT_EQ(encode_srgb(rgba, 3, 8), (std::vector<std::uint8_t>{0, 255, 188, 137, 99, 0, 255, 0, 0}));
    const auto deep = encode_srgb({0.5f, 0.0f, 1.0f, 1.0f}, 3, 16);
    std::uint16_t codes[3];
    ASSERT_EQ(deep.size(), sizeof codes);
    std::memcpy(codes, deep.data(), sizeof codes);
    EXPECT_EQ(codes[0], 48192);  // 65535 * .735357
    EXPECT_EQ(codes[1], 0);
    EXPECT_EQ(codes[2], 65535);
}

TEST(Encode, every_8_bit_code_survives_decoding_and_encoding) {
    std::vector<float> rgba;
    for (int code = 0; code < 256; ++code) {
        const double e = code / 255.0, linear = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        rgba.insert(rgba.end(), {float(linear), float(linear), float(linear), 1.0f});
    }
    const auto codes = encode_srgb(rgba, 3, 8);
    for (int code = 0; code < 256; ++code) EXPECT_EQ(codes[std::size_t(code) * 3], code);
}

TEST(Background, is_seen_through_what_is_not_covered) {
    std::vector<float> rgba{0.25f, 0.0f, 0.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f};
    put_on_background(rgba, {0.5f, 1.0f, 0.0f});
    EXPECT_EQ(rgba, (std::vector<float>{0.5f, 0.5f, 0.0f, 1.0f, 0.5f, 1.0f, 0.0f, 1.0f}));
}
