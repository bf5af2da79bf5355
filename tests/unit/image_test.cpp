// Images in: what decoders must get right, and what must not reach them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "io/io.h"
#include "temporary_folder.h"
#include "test_assets.h"
#include "tiny_png.h"

using namespace triad;
using Bytes = std::vector<std::uint8_t>;

namespace {

Bytes texels(const Bytes& file) { return decode_image("test", file).texels; }

/// The sentence of the Error(scene) that decoding ends with.
std::string refusal(const Bytes& file) {
    try {
        decode_image("the picture", file);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::scene);
        EXPECT_NE(std::string(error.what()).find("the picture"), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "decoded";
    return {};
}

Bytes from_hex(std::string_view hex) {
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(std::uint8_t(std::stoul(std::string(hex.substr(i, 2)), nullptr, 16)));
    return bytes;
}

// 8 x 8 pixels of (200, 100, 50), progressive.
constexpr std::string_view progressive_jpeg =
    "ffd8ffdb004300020101010101020101010202020202040302020202050404030406050606060506060607090806070907060608"
    "0b08090a0a0a0a0a06080b0c0b0a0c090a0a0affdb004301020202020202050303050a0706070a0a0a0a0a0a0a0a0a0a0a0a0a0a"
    "0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0affc20011080008000803012200021101"
    "031101ffc4001500010100000000000000000000000000000004ffc40014010100000000000000000000000000000007ffda000c"
    "030100021003100000019c15b67fffc40014100100000000000000000000000000000000ffda00080101000105027fffc4001411"
    "0100000000000000000000000000000000ffda0008010301013f017fffc40014110100000000000000000000000000000000ffda"
    "0008010201013f017fffc40014100100000000000000000000000000000000ffda0008010100063f027fffc40014100100000000"
    "000000000000000000000000ffda0008010100013f217fffda000c0301000200030000001003ffc4001411010000000000000000"
    "0000000000000000ffda0008010301013f107fffc40014110100000000000000000000000000000000ffda0008010201013f107f"
    "ffc40014100100000000000000000000000000000000ffda0008010100013f107fffd9";

// 8 x 8 pixels of Adobe (inverted) CMYK (255, 128, 0, 200).
constexpr std::string_view cmyk_jpeg =
    "ffd8ffee000e41646f626500640000000000ffdb0043000201010101010201010102020202020403020202020504040304060506"
    "060605060606070908060709070606080b08090a0a0a0a0a06080b0c0b0a0c090a0a0affc000140800080008044311004d110059"
    "11004b1100ffc40016000101010000000000000000000000000009000affc40014100100000000000000000000000000000000ff"
    "da000e0443004d0059004b00003f007f133fe481ffd9";

void expect_near(const Bytes& rgba, std::array<int, 4> expected, int tolerance) {
    for (std::size_t i = 0; i < rgba.size(); ++i) ASSERT_NEAR(int(rgba[i]), expected[i % 4], tolerance) << i;
}

/// A segment with `marker` right after SOI.
Bytes with_segment(const Bytes& jpeg, std::uint8_t marker, const Bytes& data) {
    Bytes out(data.size() + jpeg.size() + 4);
    const std::size_t length = data.size() + 2;
    const std::array<std::uint8_t, 6> start{
        0xff, 0xd8, 0xff, marker, std::uint8_t(length >> 8), std::uint8_t(length)};
    const auto rest = std::copy(data.begin(), data.end(), std::copy(start.begin(), start.end(), out.begin()));
    std::copy(jpeg.begin() + 2, jpeg.end(), rest);
    return out;
}

}  // namespace

TEST(ImagePng, grey_and_grey_alpha_become_rgba) {
    EXPECT_EQ(texels(tiny_png::make(2, 8, 0, {{10, 200}})), (Bytes{10, 10, 10, 255, 200, 200, 200, 255}));
    EXPECT_EQ(texels(tiny_png::make(1, 8, 4, {{10, 77}})), (Bytes{10, 10, 10, 77}));
}

TEST(ImagePng, colours_under_alpha_are_not_multiplied) {
    EXPECT_EQ(texels(tiny_png::make(2, 8, 6, {{255, 200, 100, 128, 9, 8, 7, 0}})),
              (Bytes{255, 200, 100, 128, 9, 8, 7, 0}));
}

TEST(ImagePng, palette_with_transparency) {
    const Bytes png = tiny_png::make(
        4, 2, 3, {{0b00011011}}, {{"PLTE", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}, {"tRNS", {50, 255}}});
    EXPECT_EQ(texels(png), (Bytes{1, 2, 3, 50, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255}));
}

TEST(ImagePng, one_bit_grey_is_scaled_to_full_range) {
    EXPECT_EQ(texels(tiny_png::make(2, 1, 0, {{0b01000000}})), (Bytes{0, 0, 0, 255, 255, 255, 255, 255}));
}

TEST(ImagePng, sixteen_bits_stay_sixteen_in_host_order) {
    const Image image =
        decode_image("test", tiny_png::make(1, 16, 2, {{0x12, 0x34, 0xab, 0xcd, 0x00, 0x01}}));
    EXPECT_EQ(image.bits, 16u);
    std::uint16_t rgba[4];
    ASSERT_EQ(image.texels.size(), sizeof rgba);
    std::memcpy(rgba, image.texels.data(), sizeof rgba);
    EXPECT_EQ(rgba[0], 0x1234);
    EXPECT_EQ(rgba[1], 0xabcd);
    EXPECT_EQ(rgba[2], 0x0001);
    EXPECT_EQ(rgba[3], 0xffff);
}

TEST(ImagePng, gamma_and_other_ancillary_chunks_change_nothing) {
    const Bytes plain = tiny_png::make(1, 8, 2, {{10, 20, 30}});
    const Bytes gamma = tiny_png::make(1, 8, 2, {{10, 20, 30}},
                                       {{"gAMA", {0, 1, 0x86, 0xa0}}, {"iCCP", {1, 2, 3}}, {"zzZz", {}}});
    EXPECT_EQ(texels(plain), texels(gamma));
}

TEST(ImagePng, rows_keep_their_order) {
    EXPECT_EQ(texels(tiny_png::make(1, 8, 0, {{1}, {2}, {3}})),
              (Bytes{1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255}));
}

TEST(ImagePng, a_header_larger_than_its_data_is_refused_before_memory_is_asked_for) {
    Bytes png = tiny_png::make(1, 8, 2, {{10, 20, 30}});
    png[18] = 0x20;  // width 8193
    png[22] = 0x20;  // height 8193
    EXPECT_NE(refusal(png).find("too short"), std::string::npos);
    png[17] = 0x10;  // width 1 M
    EXPECT_NE(refusal(png).find("limit"), std::string::npos);
}

TEST(ImagePng, zero_size_is_refused) {
    Bytes png = tiny_png::make(1, 8, 2, {{10, 20, 30}});
    png[19] = 0;
    EXPECT_NE(refusal(png).find("0 x 1"), std::string::npos);
}

TEST(ImagePng, a_wrong_checksum_is_refused) {
    Bytes png = tiny_png::make(2, 8, 2, {{10, 20, 30, 40, 50, 60}});
    png[png.size() - 14] ^= 0xff;  // of IDAT
    refusal(png);
}

TEST(ImageJpeg, progressive) { expect_near(texels(from_hex(progressive_jpeg)), {200, 100, 50, 255}, 3); }

TEST(ImageJpeg, adobe_cmyk_becomes_rgb) { expect_near(texels(from_hex(cmyk_jpeg)), {200, 100, 0, 255}, 3); }

TEST(ImageJpeg, broken_profiles_and_metadata_are_never_parsed) {
    Bytes profile{'I', 'C', 'C', '_', 'P', 'R', 'O', 'F', 'I', 'L', 'E', 0, 9, 1, 0xff};
    Bytes exif{'E', 'x', 'i', 'f', 0, 0, 'I', 'I', 42, 0, 0xff, 0xff, 0xff, 0x7f};
    const Bytes jpeg = with_segment(with_segment(from_hex(progressive_jpeg), 0xe2, profile), 0xe1, exif);
    expect_near(texels(jpeg), {200, 100, 50, 255}, 3);
}

TEST(ImageJpeg, a_flood_of_scans_is_refused) {
    Bytes jpeg = from_hex(progressive_jpeg);
    const Bytes scan{0xff, 0xda, 0, 8, 1, 1, 0, 1, 5, 0, 0x7f};
    jpeg.resize(jpeg.size() - 2);
    for (int i = 0; i < 500; ++i) jpeg.insert(jpeg.end(), scan.begin(), scan.end());
    EXPECT_NE(refusal(jpeg).find("scans"), std::string::npos);
}

TEST(ImageWebp, colours_under_alpha_are_not_multiplied) {
    const auto folder = test_assets() / "malformed/khronos-validator/ext/EXT_texture_webp/data/image";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets";
    expect_near(texels(read_file(folder / "VP8L_red_transparent.webp")), {255, 0, 0, 128}, 0);
    expect_near(texels(read_file(folder / "VP8X_red_transparent.webp")), {255, 0, 0, 128}, 6);
    expect_near(texels(read_file(folder / "VP8_red.webp")), {255, 0, 0, 255}, 6);
}

TEST(Image, other_formats_are_not_tried) {
    for (const char* text : {"BM......................", "GIF89a", "\0\0\1\0", "DDS ", "P6 1 1 255 abc", ""})
        EXPECT_NE(refusal(Bytes(text, text + std::strlen(text))).find("no PNG, JPEG or WebP"),
                  std::string::npos);
}

TEST(Image, damaged_bytes_end_in_a_picture_or_a_sentence) {
    std::vector<Bytes> files{tiny_png::make(4, 8, 6, {Bytes(16, 7), Bytes(16, 9)}),
                             tiny_png::make(4, 2, 3, {{0x1b}}, {{"PLTE", Bytes(12, 3)}, {"tRNS", {50, 255}}}),
                             from_hex(progressive_jpeg), from_hex(cmyk_jpeg)};
    const auto webp = test_assets() /
                      "malformed/khronos-validator/ext/EXT_texture_webp/data/image/VP8X_red_transparent.webp";
    if (std::filesystem::exists(webp)) files.push_back(read_file(webp));
    std::mt19937 random(1);
    int decoded = 0, refused = 0;
    testing::internal::CaptureStderr();  // libpng speaks for itself
    for (int i = 0; i < 3000; ++i) {
        Bytes file = files[i % files.size()];
        for (int change = 0; change < 1 + i % 3; ++change) {
            if (random() % 8 == 0) file.resize(1 + random() % file.size());
            file[random() % file.size()] = std::uint8_t(random());
        }
        try {
            const Image image = decode_image("test", file);
            EXPECT_EQ(image.texels.size(), std::size_t(image.width) * image.height * 4 * image.bits / 8);
            ++decoded;
        } catch (const Error&) {
            ++refused;
        }
    }
    testing::internal::GetCapturedStderr();
    EXPECT_GT(decoded, 0);
    EXPECT_GT(refused, 0);
}

TEST(Image, known_hostile_files_end_in_a_picture_or_a_sentence) {
    const auto folder = test_assets() / "malformed/images-oiio";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const auto bytes = read_file(entry.path());
        for (const auto& open : std::initializer_list<std::function<void()>>{
                 [&] { decode_image(entry.path().string(), bytes); }, [&] { load_environment(entry.path()); },
                 [&] { read_picture(entry.path()); }}) {
            try {
                open();
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()),
                          std::string::npos);
            }
        }
        ++files;
    }
    EXPECT_GT(files, 20);
}
