/// Pictures to EXR by OpenEXR itself, which is there at once, as libpng is for PNG (png_write.cpp).
#include <Imath/ImathMatrix.h>
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "io/io.h"
#include "io/linear_decode.h"

namespace triad {
namespace {

/// Depths, positions, counts and weights lose their meaning in half precision.
bool must_be_float(const std::string& channel) {
    for (const char* layer : {"depth.", "position.", "samplecount.", "error.", "triad_weight"})
        if (channel.starts_with(layer)) return true;
    return channel == "Z";
}

/// Of Triad's names those whose values are numbers. All are double, which holds every count that there is.
const std::set<std::string> numbers{
    "triad:spp",         "triad:spp_min",   "triad:spp_max",   "triad:samples",        "triad:rays",
    "triad:not_finite",  "triad:saturated", "triad:truncated", "triad:cut_energy",     "triad:relmse",
    "triad:trend",       "triad:seed",      "triad:seconds",   "triad:compute_units",  "triad:ppd",
    "triad:max_texture", "triad:exposure",  "triad:pose_time", "triad:perceived_noise"};

/// pbrt-v4's names keep pbrt-v4's types (util/image.cpp), OpenEXR's have its own; other texts are strings.
void add_attribute(Imf::Header& header, const std::string& name, const std::string& value) {
    const char* text = value.c_str();
    if (numbers.contains(name))
        header.insert(name, Imf::DoubleAttribute(std::strtod(text, nullptr)));
    else if (name == "renderTimeSeconds" || name == "MSE")
        header.insert(name, Imf::FloatAttribute(std::strtof(text, nullptr)));
    else if (name == "samplesPerPixel")
        header.insert(name, Imf::IntAttribute(int(std::strtol(text, nullptr, 10))));
    else if (name == "worldToCamera" || name == "worldToNDC") {
        Imath::M44f matrix;
        for (auto& row : matrix.x)
            for (float& v : row) {
                char* end;
                v = std::strtof(text, &end);
                text = end;
            }
        header.insert(name, Imf::M44fAttribute(matrix));
    } else
        header.insert(name, Imf::StringAttribute(value));
    if (name == "capDate") Imf::addUtcOffset(header, 0.0f);
}

/// What R, G and B are: the primaries of Rec. 709 and sRGB with their white, D65. Drives of a panel are
/// colours of its own emitters.
const Imf::Chromaticities rec709{{.64f, .33f}, {.3f, .6f}, {.15f, .06f}, {.3127f, .329f}};

/// Throws std::logic_error when a channel has not one value per pixel.
void require_pixels(const Picture& picture) {
    const std::size_t pixels = std::size_t(picture.width) * picture.height;
    if (pixels == 0 || picture.channels.empty())
        throw Error(Exit::scene, "There is no picture to write: it has no pixels or no channels.");
    for (const Channel& channel : picture.channels)
        if (channel.values.size() != pixels)
            throw std::logic_error("channel " + channel.name + " does not have one value per pixel");
}

Imf::Header header_of(const Picture& picture) {
    const unsigned full_width = picture.full_width ? picture.full_width : picture.width,
                   full_height = picture.full_height ? picture.full_height : picture.height;
    const auto window = [](unsigned x, unsigned y, unsigned width, unsigned height) {
        return Imath::Box2i({int(x), int(y)}, {int(x + width) - 1, int(y + height) - 1});
    };
    Imf::Header header(window(0, 0, full_width, full_height),
                       window(picture.x, picture.y, picture.width, picture.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : picture.metadata) add_attribute(header, name, value);
    if (picture.find("R") && !picture.metadata.contains("triad:panel"))
        Imf::addChromaticities(header, rec709);
    return header;
}

/// The file in memory.
class MemoryFile : public Imf::OStream {
  public:
    MemoryFile() : OStream("memory") {}
    void write(const char data[], int size) override {
        const std::size_t end = at_ + std::size_t(size);
        if (bytes.size() < end) bytes.resize(end);
        std::memcpy(bytes.data() + at_, data, std::size_t(size));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = std::size_t(position); }

    std::vector<std::uint8_t> bytes;

  private:
    std::size_t at_ = 0;
};

/// Values beyond the range become its ends, and are counted.
std::vector<half> halves(const std::vector<float>& values, std::size_t& saturated) {
    std::vector<half> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        float v = values[i];
        if (std::abs(v) > HALF_MAX) v = std::copysign(HALF_MAX, v), ++saturated;
        result[i] = half(v);
    }
    return result;
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Picture& picture, bool half_precision, std::size_t* saturated) {
    require_pixels(picture);
    std::size_t count = 0;
    MemoryFile file;
    try {
        Imf::Header header = header_of(picture);
        Imf::FrameBuffer buffer;
        std::vector<std::vector<half>> narrow;
        narrow.reserve(picture.channels.size());
        const auto add = [&](const std::string& name, Imf::PixelType type, const auto* values) {
            header.channels().insert(name, Imf::Channel(type));
            buffer.insert(name, Imf::Slice::Make(type, values, header.dataWindow(), sizeof *values,
                                                 sizeof *values * picture.width));
        };
        for (const Channel& channel : picture.channels)
            if (half_precision && !must_be_float(channel.name))
                add(channel.name, Imf::HALF, narrow.emplace_back(halves(channel.values, count)).data());
            else
                add(channel.name, Imf::FLOAT, channel.values.data());
        Imf::OutputFile output(file, header,
                               exr_threads(picture.channels.size() * picture.channels.front().values.size()));
        output.setFrameBuffer(buffer);
        output.writePixels(int(picture.height));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw Error(Exit::scene, std::string("Cannot encode the picture as EXR: ") + e.what() + ".");
    }
    if (saturated) *saturated = count;
    return std::move(file.bytes);
}

}  // namespace triad
