// EXR files of other programs: every way to store a picture, and what hides in a header.
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "io/io.h"
#include "sentence_of.h"
#include "temporary_folder.h"

using namespace triad;

namespace {

constexpr int width = 64, height = 320;  // longer than the longest strip of a compression

/// A value that halves hold, another for every pixel and channel.
float value(int x, int y, int channel) { return float((x + 16 * channel) % 64) + float(y % 16) / 16.0f; }

/// What a file holds at `origin`, R, G and B as `type`.
class Stored {
  public:
    Stored(Imf::PixelType type, Imath::V2i origin, Imf::Compression compression, Imf::LineOrder order)
        : window_(origin, origin + Imath::V2i(width - 1, height - 1)),
          header_(window_, window_, 1.0f, {0, 0}, 1.0f, order, compression) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (int i = 0; i < width * height; ++i) {
                const float v = value(i % width, i / width, int(c));
                floats_[c].push_back(v), halves_[c].push_back(half(v)), whole_[c].push_back(unsigned(v));
            }
            const void* const values = type == Imf::FLOAT  ? static_cast<const void*>(floats_[c].data())
                                       : type == Imf::HALF ? static_cast<const void*>(halves_[c].data())
                                                           : whole_[c].data();
            const std::size_t size = type == Imf::HALF ? 2 : 4;
            header_.channels().insert(names[c], Imf::Channel(type));
            buffer_.insert(names[c],
                           Imf::Slice::Make(type, values, header_.dataWindow(), size, size * width));
        }
    }

    void write(const std::filesystem::path& path) const {
        Imf::OutputFile file(path.c_str(), header_);
        file.setFrameBuffer(buffer_);
        file.writePixels(height);
    }
    void write_tiles(const std::filesystem::path& path, Imf::LevelMode mode) {
        header_.setTileDescription({16, 32, mode});
        Imf::TiledOutputFile file(path.c_str(), header_);
        file.setFrameBuffer(buffer_);  // of every level what fits of the picture: only the first is read
        for (int ly = 0; ly < file.numYLevels(); ++ly)
            for (int lx = 0; lx < file.numXLevels(); ++lx)
                if (file.isValidLevel(lx, ly))
                    file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
    }

    static constexpr const char* names[] = {"R", "G", "B"};

  private:
    Imath::Box2i window_;
    Imf::Header header_;
    Imf::FrameBuffer buffer_;
    std::vector<float> floats_[3];
    std::vector<half> halves_[3];
    std::vector<unsigned> whole_[3];
};

/// As a picture and as an environment.
void expect_values(const std::filesystem::path& path, bool is_whole = false) {
    const Picture picture = read_picture(path);
    const EnvironmentMap map = load_environment(path);
    ASSERT_EQ(picture.width, unsigned(width));
    ASSERT_EQ(picture.height, unsigned(height));
    ASSERT_EQ(map.rgb.size(), std::size_t(width * height * 3));
    for (int i = 0; i < width * height; ++i)
        for (int c = 0; c < 3; ++c) {
            const float v = value(i % width, i / width, c), stored = is_whole ? std::floor(v) : v;
            ASSERT_EQ(picture.find(Stored::names[c])->values[std::size_t(i)], stored) << path << " " << i;
            ASSERT_EQ(map.rgb[std::size_t(i * 3 + c)], stored) << path << " " << i;
        }
}

/// An attribute's bytes: name, type, size, value.
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    const auto size = std::uint32_t(value.size());
    std::string bytes = name + '\0' + type + '\0' + std::string(4, '\0') + value;
    std::memcpy(bytes.data() + name.size() + type.size() + 2, &size, 4);
    return bytes;
}

}  // namespace

TEST(ExrOfOthers, every_exact_compression_comes_back_exactly) {
    const TemporaryFolder folder;
    for (const Imf::PixelType type : {Imf::FLOAT, Imf::HALF, Imf::UINT})
        for (const Imf::Compression compression :
             {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
              Imf::PIZ_COMPRESSION})
            for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
                Stored(type, {0, 0}, compression, order).write(folder / "a.exr");
                expect_values(folder / "a.exr", type == Imf::UINT);
            }
}

TEST(ExrOfOthers, tiles_come_back_exactly_at_their_first_level) {
    const TemporaryFolder folder;
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        Stored(Imf::FLOAT, {0, 0}, Imf::ZIP_COMPRESSION, Imf::INCREASING_Y)
            .write_tiles(folder / "a.exr", mode);
        expect_values(folder / "a.exr");
    }
}

TEST(ExrOfOthers, lossy_compression_comes_back_closely) {
    const TemporaryFolder folder;
    for (const Imf::Compression compression :
         {Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION,
          Imf::DWAB_COMPRESSION}) {
        Stored(Imf::HALF, {0, 0}, compression, Imf::INCREASING_Y).write(folder / "a.exr");
        const EnvironmentMap map = load_environment(folder / "a.exr");
        for (int i = 0; i < width * height; ++i)
            ASSERT_NEAR(map.rgb[std::size_t(i * 3 + 1)], value(i % width, i / width, 1), 4.0f)
                << compression << " " << i;
    }
}

TEST(ExrOfOthers, a_map_may_lie_anywhere) {
    const TemporaryFolder folder;
    for (const Imath::V2i& origin : {Imath::V2i(-100, -7), Imath::V2i(33, 5)}) {
        Stored(Imf::FLOAT, origin, Imf::PIZ_COMPRESSION, Imf::INCREASING_Y).write(folder / "a.exr");
        expect_values(folder / "a.exr");
    }
}

TEST(ExrOfOthers, large_files_are_read_by_threads_to_the_same_bits) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = 1200, picture.height = 400;
    for (const char* name : Stored::names) {
        picture.channels.push_back({name, {}});
        for (int i = 0; i < 1200 * 400; ++i)
            picture.channels.back().values.push_back(value(i % 977, i / 1200, *name));
    }
    write_exr(folder / "a.exr", picture);
    const Picture back = read_picture(folder / "a.exr");
    for (const Channel& channel : picture.channels)
        EXPECT_EQ(back.find(channel.name)->values, channel.values);
}

// OpenEXR reads lists and tiles to their own ends, whatever their sizes say: what is beyond them would be
// attributes that nobody has looked at, such as a second, wider data window.
TEST(ExrOfOthers, attributes_hidden_in_others_are_refused) {
    const TemporaryFolder folder;
    Picture picture;
    picture.width = picture.height = 64;
    picture.channels = {{"R", std::vector<float>(64 * 64, 1.0f)}};
    const auto bytes = encode_exr(picture);
    const std::string text(bytes.begin(), bytes.end());
    const std::int32_t wide[] = {0, 0, 4095, 63};
    const std::string window =
        attribute("dataWindow", "box2i", std::string(reinterpret_cast<const char*>(wide), sizeof wide));
    const auto read = [&](const std::string& file) {
        write_file(folder / "a.exr", file);
        return sentence_of(Exit::scene, [&] { read_picture(folder / "a.exr"); });
    };
    const std::string list("R\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0\0", 19),
        channels = attribute("channels", "chlist", list);
    const std::size_t at = text.find(channels);
    ASSERT_NE(at, text.npos);
    std::string hidden = text;
    hidden.replace(at, channels.size(), attribute("channels", "chlist", list + window));
    EXPECT_NE(read(hidden).find("longer than it says"), std::string::npos);
    std::string tiles = text;
    tiles.insert(at, attribute("tiles", "tiledesc", std::string(9, '\1') + window));
    EXPECT_NE(read(tiles).find("tiles"), std::string::npos);
    std::string twice = text;
    twice.replace(at, channels.size(), attribute("channels", "chlist", list.substr(0, 18) + list));
    EXPECT_NE(read(twice).find("two EXR channels of one name"), std::string::npos);
}
