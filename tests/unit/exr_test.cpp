// Pictures out, and back in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "io/exr_header.h"
#include "io/io.h"
#include "sentence_of.h"
#include "temporary_folder.h"

using namespace triad;

namespace {

Picture random_picture(unsigned width, unsigned height, const std::vector<std::string>& names) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(-2.0f, 100.0f);
    Picture picture;
    picture.width = width, picture.height = height;
    for (const std::string& name : names) {
        picture.channels.push_back({name, std::vector<float>(std::size_t(width) * height)});
        for (float& v : picture.channels.back().values) v = value(random);
    }
    return picture;
}

EncodedPicture ramp(unsigned channels, unsigned bits) {
    EncodedPicture picture{16, 8, channels, bits, {}, {}};
    picture.bytes.resize(16 * 8 * channels * bits / 8);
    for (std::size_t i = 0; i < picture.bytes.size(); ++i) picture.bytes[i] = std::uint8_t(i * 37 + i / 64);
    return picture;
}

/// Type of an attribute in the file, by OpenEXR's layout: name, zero, type, zero.
std::string attribute_type(const std::vector<std::uint8_t>& exr, const std::string& name) {
    const std::string text(exr.begin(),
                           exr.begin() + std::ptrdiff_t(std::min<std::size_t>(4096, exr.size())));
    const std::size_t at = text.find(name + '\0');
    return at == text.npos ? "" : std::string(text.c_str() + at + name.size() + 1);
}

}  // namespace

TEST(Exr, floats_of_every_channel_come_back_exactly) {
    const TemporaryFolder folder;
    Picture picture =
        random_picture(67, 131, {"R", "G", "B", "A", "albedo.R", "normal.X", "depth.Z", "samplecount.Y"});
    picture.channels[0].values[5] = std::numeric_limits<float>::infinity();
    write_exr(folder / "a.exr", picture);
    const Picture back = read_picture(folder / "a.exr");
    EXPECT_EQ(back.width, 67u);
    EXPECT_EQ(back.height, 131u);
    ASSERT_EQ(back.channels.size(), picture.channels.size());
    for (const Channel& channel : picture.channels) {
        ASSERT_NE(back.find(channel.name), nullptr) << channel.name;
        EXPECT_EQ(back.find(channel.name)->values, channel.values) << channel.name;
    }
}

TEST(Exr, a_crop_keeps_its_place_in_the_full_picture) {
    const TemporaryFolder folder;
    Picture picture = random_picture(5, 4, {"R", "G", "B"});
    picture.x = 10, picture.y = 20, picture.full_width = 64, picture.full_height = 48;
    write_exr(folder / "crop.exr", picture);
    const Picture back = read_picture(folder / "crop.exr");
    EXPECT_EQ(back.x, 10u);
    EXPECT_EQ(back.y, 20u);
    EXPECT_EQ(back.width, 5u);
    EXPECT_EQ(back.height, 4u);
    EXPECT_EQ(back.full_width, 64u);
    EXPECT_EQ(back.full_height, 48u);
    EXPECT_EQ(back.find("G")->values, picture.channels[1].values);
}

TEST(Exr, metadata_keep_their_names_and_pbrt_types) {
    Picture picture = random_picture(3, 3, {"R", "G", "B"});
    picture.metadata = {{"triad:spp", "64"},
                        {"triad:rays", "123456789012345"},
                        {"triad:relmse", "0.00213700001"},
                        {"triad:scene", "12345678"},
                        {"triad:device", "a device, \"quoted\""},
                        {"renderTimeSeconds", "1.5"},
                        {"samplesPerPixel", "64"},
                        {"worldToCamera", "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16"}};
    const auto bytes = encode_exr(picture);
    const Metadata back = clean_exr("test", bytes).metadata;
    for (const char* name : {"triad:spp", "triad:rays", "triad:relmse"}) {
        EXPECT_EQ(back.at(name), picture.metadata.at(name));
        EXPECT_EQ(attribute_type(bytes, name), "double") << name;
    }
    EXPECT_EQ(attribute_type(bytes, "triad:scene"), "string") << "a hash of digits alone is no number";
    EXPECT_EQ(back.at("triad:device"), "a device, \"quoted\"");
    EXPECT_EQ(back.at("renderTimeSeconds"), "1.5");
    EXPECT_EQ(back.at("samplesPerPixel"), "64");
    EXPECT_EQ(attribute_type(bytes, "renderTimeSeconds"), "float");
    EXPECT_EQ(attribute_type(bytes, "samplesPerPixel"), "int");
    EXPECT_EQ(attribute_type(bytes, "worldToCamera"), "m44f");
}

TEST(Exr, colours_say_what_they_are_unless_they_drive_a_panel) {
    Picture picture = random_picture(3, 3, {"R", "G", "B"});
    EXPECT_EQ(attribute_type(encode_exr(picture), "chromaticities"), "chromaticities");
    picture.metadata["triad:panel"] = "rgb";
    EXPECT_EQ(attribute_type(encode_exr(picture), "chromaticities"), "");
    EXPECT_EQ(attribute_type(encode_exr(random_picture(3, 3, {"error"})), "chromaticities"), "");
}

TEST(Exr, a_time_is_written_where_one_is_given_and_is_universal) {
    Picture picture = random_picture(3, 3, {"R", "G", "B"});
    picture.metadata["capDate"] = "2026:11:26 17:04:05";
    const Metadata back = clean_exr("test", encode_exr(picture)).metadata;
    EXPECT_EQ(back.at("capDate"), "2026:11:26 17:04:05");
    EXPECT_EQ(back.at("utcOffset"), "0");
}

TEST(Exr, half_saturates_and_counts_and_leaves_depth_alone) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 4, picture.height = 1;
    picture.channels = {{"R", {1e6f, -1e9f, 0.333333333f, 65504.0f}},
                        {"depth.Z", {1e6f, 123456.789f, 0.333333333f, 1.0f}},
                        {"G", {std::numeric_limits<float>::infinity(), 1, 2, 65519.0f}}};
    EXPECT_EQ(write_exr(folder / "a.exr", picture, true), 4u);
    const Picture back = read_picture(folder / "a.exr");
    EXPECT_EQ(back.find("R")->values[0], 65504.0f);
    EXPECT_EQ(back.find("R")->values[1], -65504.0f);
    EXPECT_NEAR(back.find("R")->values[2], 0.3333f, 2e-4f);
    EXPECT_NE(back.find("R")->values[2], 0.333333333f);
    EXPECT_EQ(back.find("G")->values, (std::vector<float>{65504.0f, 1, 2, 65504.0f}));
    EXPECT_EQ(back.find("depth.Z")->values, picture.channels[1].values);
}

TEST(Exr, equal_pictures_give_equal_bytes) {
    const Picture picture = random_picture(33, 20, {"R", "G", "B"});
    const auto bytes = encode_exr(picture);
    EXPECT_TRUE(bytes == encode_exr(picture));
    EXPECT_EQ(clean_exr("test", bytes).metadata["capDate"], "") << "the time of writing is in the file";
}

TEST(Exr, every_truncation_is_refused) {
    const TemporaryFolder folder;
    const auto bytes = encode_exr(random_picture(9, 40, {"R", "G", "B"}));
    const std::string text(bytes.begin(), bytes.end());
    for (std::size_t length = 4; length < text.size() - 1; length += 1 + length / 12) {
        write_file(folder / "cut.exr", std::string_view(text).substr(0, length));
        sentence_of(Exit::scene, [&] { read_picture(folder / "cut.exr"); });
    }
}

TEST(Exr, damaged_bytes_end_in_a_picture_or_a_sentence) {
    const TemporaryFolder folder;
    const auto bytes = encode_exr(random_picture(9, 40, {"R", "G", "B"}));
    std::mt19937 random(3);
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        std::string text(bytes.begin(), bytes.end());
        const std::size_t range = i % 2 ? 400 : text.size();  // half of them in the header
        text[4 + random() % (range - 4)] = char(random());
        std::ofstream(folder / "bad.exr", std::ios::binary) << text;
        try {
            read_picture(folder / "bad.exr");
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 50);
}

TEST(Exr, an_announced_bomb_is_refused_by_its_header) {
    auto bytes = encode_exr(random_picture(4, 4, {"R"}));
    const std::string text(bytes.begin(), bytes.end()), key("dataWindow\0box2i\0", 17);
    const std::size_t at = text.find(key) + key.size() + 4;
    const std::int32_t wide = 40000;
    std::memcpy(bytes.data() + at + 8, &wide, 4);
    std::memcpy(bytes.data() + at + 12, &wide, 4);
    EXPECT_NE(sentence_of(Exit::scene, [&] { clean_exr("bomb", bytes); }).find("40001 x 40001"),
              std::string::npos);
}

TEST(Encoded, png_of_every_layout_comes_back_exactly) {
    const TemporaryFolder folder;
    for (const unsigned channels : {1u, 3u, 4u})
        for (const unsigned bits : {8u, 16u}) {
            const EncodedPicture picture = ramp(channels, bits);
            write_encoded(folder / "a.png", picture);
            const Image image = decode_image("a.png", read_file(folder / "a.png"));
            EXPECT_EQ(image.bits, bits);
            const std::size_t size = bits / 8;
            for (std::size_t p = 0; p < 16 * 8; ++p)
                for (std::size_t c = 0; c < channels; ++c)
                    ASSERT_EQ(std::memcmp(&image.texels[(p * 4 + c) * size],
                                          &picture.bytes[(p * channels + c) * size], size),
                              0)
                        << channels << " " << bits << " " << p;
        }
}

TEST(Encoded, png_holds_its_metadata_and_says_srgb) {
    EncodedPicture picture = ramp(3, 8);
    picture.metadata = {{"triad:spp", "64"}};
    const auto bytes = encode_picture(".png", picture);
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_NE(text.find(std::string("triad:spp\0"
                                    "64",
                                    12)),
              std::string::npos);
    EXPECT_NE(text.find("sRGB"), std::string::npos);
    EXPECT_EQ(encode_picture(".PNG", picture), bytes);
}

TEST(Encoded, jpeg_is_close_and_on_black) {
    EncodedPicture picture{16, 16, 4, 16, {}, {}};
    for (int i = 0; i < 256; ++i)
        for (const std::uint16_t v : {52428, 26214, 13107, 32768}) {
            picture.bytes.push_back(std::uint8_t(v & 255));
            picture.bytes.push_back(std::uint8_t(v >> 8));
        }
    const Image image = decode_image("a.jpg", encode_picture(".jpg", picture));
    // sRGB .8 at half coverage: linear .6038 / 2 = .3019, encoded .5870.
    EXPECT_NEAR(image.texels[0], 255 * 0.5870, 4);
    EXPECT_EQ(image.texels[3], 255);
}

TEST(Encoded, unknown_extensions_list_what_is_possible) {
    EXPECT_NE(sentence_of(Exit::usage, [] { write_encoded("a.bmp", ramp(3, 8)); }).find(".png"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists("a.bmp"));
}

TEST(Encoded, a_png_is_read_as_encoded_floats) {
    const TemporaryFolder folder;
    EncodedPicture picture{1, 1, 3, 8, {255, 51, 0}, {}};
    write_encoded(folder / "a.png", picture);
    const Picture back = read_picture(folder / "a.png");
    ASSERT_EQ(back.channels.size(), 3u);
    EXPECT_EQ(back.find("R")->values[0], 1.0f);
    EXPECT_FLOAT_EQ(back.find("G")->values[0], 0.2f);
    EXPECT_EQ(back.find("B")->values[0], 0.0f);
}

TEST(Output, a_full_disk_is_a_sentence_that_names_the_path) {
    if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP();
    EXPECT_NE(sentence_of(Exit::scene, [] { write_exr("/dev/full", random_picture(8, 8, {"R"})); })
                  .find("/dev/full"),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(Output, a_failed_write_leaves_the_older_file_and_no_rest) {
    const TemporaryFolder folder;
    write_encoded(folder / "a.png", ramp(3, 8));
    const auto before = read_file(folder / "a.png");
    EncodedPicture wrong = ramp(3, 8);
    wrong.bytes.pop_back();
    EXPECT_THROW(write_encoded(folder / "a.png", wrong), std::logic_error);
    EXPECT_THROW(
        write_aside(folder / "a.png", [](const std::filesystem::path&) { throw Error(Exit::scene, "full"); }),
        Error);
    EXPECT_EQ(read_file(folder / "a.png"), before);
    std::size_t entries = 0;
    for ([[maybe_unused]] const auto& entry :
         std::filesystem::directory_iterator((folder / "a.png").parent_path()))
        ++entries;
    EXPECT_EQ(entries, 1u);
}

TEST(Output, a_missing_folder_is_a_sentence) {
    EXPECT_NE(sentence_of(Exit::scene, [] { write_exr("no/such/folder/a.exr", random_picture(8, 8, {"R"})); })
                  .find("no/such/folder"),
              std::string::npos);
}

TEST(Output, hdr_drops_what_it_cannot_hold) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 2, picture.height = 1;
    picture.channels = {{"R", {-1.0f, NAN}}, {"G", {4.0f, 1.0f}}, {"B", {3e38f, 1.0f}}};
    write_hdr(folder / "a.hdr", picture);
    const Picture back = read_picture(folder / "a.hdr");
    for (const Channel& channel : back.channels)
        for (const float v : channel.values)
            EXPECT_TRUE(std::isfinite(v) && v >= 0.0f) << channel.name << " " << v;
    EXPECT_NEAR(back.find("G")->values[1], 1.0f, 0.01f);
    EXPECT_GT(back.find("B")->values[0], 1e38f);
}
