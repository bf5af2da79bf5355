// Environment maps in: Radiance .hdr and EXR.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "io/io.h"
#include "sentence_of.h"
#include "temporary_folder.h"
#include "test_assets.h"

using namespace triad;
using Bytes = std::vector<std::uint8_t>;

namespace {

/// A .hdr of these bytes after its header.
void write_raw_hdr(const std::filesystem::path& path, unsigned width, unsigned height, const Bytes& bytes) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                               std::to_string(width) + "\n";
    std::ofstream(path, std::ios::binary) << header << std::string(bytes.begin(), bytes.end());
}

/// Why a map of these bytes is refused.
std::string refusal_of_hdr(unsigned width, unsigned height, const Bytes& bytes) {
    const TemporaryFolder folder;
    write_raw_hdr(folder / "a.hdr", width, height, bytes);
    return sentence_of(Exit::scene, [&] { load_environment(folder / "a.hdr"); });
}

}  // namespace

TEST(Environment, flat_hdr) {
    const TemporaryFolder folder;
    write_raw_hdr(folder / "a.hdr", 2, 1, {128, 64, 32, 129, 0, 0, 0, 0});
    const EnvironmentMap map = load_environment(folder / "a.hdr");
    EXPECT_EQ(map.width, 2u);
    EXPECT_EQ(map.height, 1u);
    EXPECT_EQ(map.rgb, (std::vector<float>{1, 0.5f, 0.25f, 0, 0, 0}));
}

TEST(Environment, every_exponent_of_an_hdr_is_a_power_of_two) {
    const TemporaryFolder folder;
    Bytes bytes;
    for (unsigned e = 0; e < 256; ++e) bytes.insert(bytes.end(), {1, 200, 255, std::uint8_t(e)});
    write_raw_hdr(folder / "a.hdr", 256, 1, bytes);
    const EnvironmentMap map = load_environment(folder / "a.hdr");
    EXPECT_EQ(map.rgb[0], 0.0f);
    for (unsigned e = 1; e < 256; ++e) {
        const double unit = std::pow(2.0, int(e) - 136);
        ASSERT_EQ(map.rgb[e * 3], float(unit)) << e;
        ASSERT_EQ(map.rgb[e * 3 + 1], float(200 * unit)) << e;
        ASSERT_EQ(map.rgb[e * 3 + 2], float(255 * unit)) << e;
    }
}

TEST(Environment, old_runs_of_an_hdr_repeat_the_last_texel) {
    const TemporaryFolder folder;
    // 1, 1, 1, n: n times more; the next one counts in 256. 1 + 3 + (4 + 1 * 256) + 1 texels.
    write_raw_hdr(folder / "a.hdr", 265, 1,
                  {128, 64, 32, 129, 1, 1, 1, 3, 2, 4, 8, 136, 1, 1, 1, 3, 1, 1, 1, 1, 7, 7, 7, 136});
    const EnvironmentMap map = load_environment(folder / "a.hdr");
    for (unsigned x = 0; x < 265; ++x) EXPECT_EQ(map.rgb[x * 3], x < 4 ? 1.0f : x < 264 ? 2.0f : 7.0f) << x;
}

TEST(Environment, new_runs_of_an_hdr_go_by_component) {
    const TemporaryFolder folder;
    const Bytes row{2,       2,  0, 9,                             //
                    128 + 9, 10,                                   // R
                    4,       1,  2, 3, 4, 128 + 5, 5,              // G
                    128 + 1, 6,  8, 8, 7, 6,       5, 4, 3, 2, 1,  // B
                    128 + 9, 136};
    Bytes rows(row);
    rows.insert(rows.end(), row.begin(), row.end());
    write_raw_hdr(folder / "a.hdr", 9, 2, rows);
    const EnvironmentMap map = load_environment(folder / "a.hdr");
    const float green[] = {1, 2, 3, 4, 5, 5, 5, 5, 5}, blue[] = {6, 8, 7, 6, 5, 4, 3, 2, 1};
    for (unsigned i = 0; i < 18; ++i) {
        EXPECT_EQ(map.rgb[i * 3], 10.0f) << i;
        EXPECT_EQ(map.rgb[i * 3 + 1], green[i % 9]) << i;
        EXPECT_EQ(map.rgb[i * 3 + 2], blue[i % 9]) << i;
    }
}

TEST(Environment, damaged_runs_of_an_hdr_are_refused_with_their_row) {
    const auto expect = [](const std::string& said, const char* part) {
        EXPECT_NE(said.find(part), std::string::npos) << said;
    };
    expect(refusal_of_hdr(9, 1, {2, 2, 0, 8, 128 + 8, 1, 128 + 8, 1}), "row 1 is of another width");
    expect(refusal_of_hdr(9, 1, {2, 2, 0, 9, 128 + 10, 1}), "row 1 has a run that does not fit");
    expect(refusal_of_hdr(9, 1, {2, 2, 0, 9, 0, 1}), "row 1 has a run that does not fit");
    expect(refusal_of_hdr(9, 1, {2, 2, 0, 9, 128 + 9, 1, 128 + 9}), "row 1 is missing, or ends early");
    expect(refusal_of_hdr(2, 1, {1, 1, 1, 2}), "row 1 has a run that does not fit");
    expect(refusal_of_hdr(4, 1, {5, 5, 5, 5, 1, 1, 1, 4}), "row 1 has a run that does not fit");
    expect(refusal_of_hdr(2, 2, {5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5}), "row 2 is missing, or ends early");
}

TEST(Environment, run_length_hdr_written_here_comes_back) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 64, picture.height = 32;
    for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, std::vector<float>(64 * 32)});
    for (std::size_t p = 0; p < 64 * 32; ++p)
        for (std::size_t c = 0; c < 3; ++c)
            picture.channels[c].values[p] = p % 64 < 40 ? 2.0f : float(p % 7 + 1) * float(c + 1);
    write_hdr(folder / "a.hdr", picture);
    EXPECT_LT(std::filesystem::file_size(folder / "a.hdr"), 64u * 32 * 4);  // it is compressed
    const EnvironmentMap map = load_environment(folder / "a.hdr");
    for (std::size_t p = 0; p < 64 * 32; ++p)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(map.rgb[p * 3 + c], picture.channels[c].values[p],
                        picture.channels[0].values[p] * 3 / 128.0)
                << p;
}

TEST(Environment, exr_negative_and_not_finite_texels_become_black) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 4, picture.height = 1;
    picture.channels = {{"R", {-1.0f, 1.0f, NAN, 4.0f}},
                        {"G", {2.0f, INFINITY, 1.0f, 5.0f}},
                        {"B", {3.0f, 1.0f, 1.0f, 6.0f}}};
    write_exr(folder / "a.exr", picture);
    const EnvironmentMap map = load_environment(folder / "a.exr");
    EXPECT_EQ(map.rgb, (std::vector<float>{0, 2, 3, 1, 0, 1, 0, 1, 1, 4, 5, 6}));
}

TEST(Environment, exr_with_a_single_y_is_grey_and_other_channels_are_refused) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 2, picture.height = 1;
    picture.channels = {{"Y", {1.0f, 2.0f}}};
    write_exr(folder / "y.exr", picture);
    EXPECT_EQ(load_environment(folder / "y.exr").rgb, (std::vector<float>{1, 1, 1, 2, 2, 2}));
    picture.channels[0].name = "depth.Z";
    write_exr(folder / "z.exr", picture);
    try {
        load_environment(folder / "z.exr");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("depth.Z"), std::string::npos) << error.what();
    }
}

TEST(Environment, bombs_are_refused_by_their_header) {
    const TemporaryFolder folder;
    write_raw_hdr(folder / "bomb.hdr", 40000, 40000, Bytes(64, 2));
    EXPECT_THROW(load_environment(folder / "bomb.hdr"), Error);
    write_raw_hdr(folder / "short.hdr", 1000, 1000, Bytes(64, 2));
    EXPECT_THROW(load_environment(folder / "short.hdr"), Error);
}

TEST(Environment, an_hdr_of_xyz_is_refused) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd";
    EXPECT_NE(sentence_of(Exit::scene, [&] { load_environment(folder / "a.hdr"); }).find("XYZ"),
              std::string::npos);
}

TEST(Environment, a_missing_file_is_named) {
    try {
        load_environment("no/such/sky.hdr");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::scene);
        EXPECT_NE(std::string(error.what()).find("no/such/sky.hdr"), std::string::npos);
    }
}

TEST(Environment, assets_have_the_size_that_their_names_say) {
    const auto folder = test_assets() / "env";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets";
    EXPECT_EQ(load_environment(folder / "venice_sunset_1k.hdr").width, 1024u);
    EXPECT_EQ(load_environment(folder / "venice_sunset_256.hdr").width, 256u);
}
