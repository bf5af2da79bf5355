#include "io/oiio.h"

#include <algorithm>
#include <new>

#include "base/error.h"

namespace triad::oiio {
namespace {

/// OpenImageIO's message as one sentence: its first line, without a full stop.
std::string first_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
    return text.empty() ? "no reason given" : text;
}

}  // namespace

void Input::fail(const std::string& what) {
    throw Error(Exit::scene, "Image " + name_ + " cannot be read: " + first_line(what) + ".");
}

Input::Input(const std::string& name, const char* format, std::span<const std::uint8_t> bytes)
    : name_(name),
      memory_(const_cast<std::uint8_t*>(bytes.data()), bytes.size()),
      input_(OIIO::ImageInput::create(format)) {
    if (!input_) fail(std::string("this OpenImageIO has no ") + format + " reader");
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    input_->set_ioproxy(&memory_);
    try {
        if (!input_->open(name_, spec_, config)) fail(input_->geterror());
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        fail(e.what());
    }
    if (spec_.width <= 0 || spec_.height <= 0 || spec_.depth > 1 || spec_.nchannels <= 0)
        fail("it has no flat picture");
}

std::string Input::complaint() {
    // libjpeg goes on after what it calls warnings: OpenImageIO keeps the last of them and reports success.
    std::string text = input_->geterror();
    if (text.empty()) return text;
    text = first_line(text);
    if (const std::size_t name = text.find(" (\""); name != std::string::npos) text.resize(name);
    return text;
}

void Input::read_bands(OIIO::TypeDesc type,
                       const std::function<void(unsigned, unsigned, const std::uint8_t*)>& take) {
    const std::size_t row = std::size_t(spec_.width) * spec_.nchannels * type.size();
    const bool tiled = spec_.tile_width > 0;
    const int band = tiled ? spec_.tile_height : 64;
    // read_scanlines() of OpenImageIO 2.4 takes memory for 256 rows, however few it reads.
    constexpr std::size_t widest_of_many = std::size_t(1) << 18;
    std::vector<std::uint8_t> values(row * std::min(band, spec_.height));
    for (int y = 0; y < spec_.height; y += band) {
        const int rows = std::min(band, spec_.height - y), first = spec_.y + y;
        try {
            bool read = true;
            if (tiled)
                read = input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, first, first + rows, 0, 1, 0,
                                          spec_.nchannels, type, values.data());
            else if (row <= widest_of_many)
                read = input_->read_scanlines(0, 0, first, first + rows, 0, 0, spec_.nchannels, type,
                                              values.data());
            else
                for (int i = 0; read && i < rows; ++i)
                    read = input_->read_scanline(first + i, 0, type, values.data() + std::size_t(i) * row);
            if (!read) fail(input_->geterror());
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            fail(e.what());
        }
        take(unsigned(y), unsigned(rows), values.data());
    }
}

std::vector<std::uint8_t> encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                 const void* values) {
    const auto fail = [&](const std::string& what) {
        throw Error(Exit::scene,
                    std::string("Cannot encode the picture as ") + format + ": " + first_line(what) + ".");
    };
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output) fail("this OpenImageIO has no such writer");
    try {
        output->set_ioproxy(&memory);
        const bool done = output->open(std::string("memory.") + format, spec) &&
                          output->write_image(type, values) && output->close();
        if (!done) fail(output->geterror());
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        fail(e.what());
    }
    return bytes;
}

}  // namespace triad::oiio
