/// The library triad-images: io/image_formats.h by OpenImageIO, with its failures as sentences.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "base/error.h"
#include "io/image_formats.h"

namespace triad::image_formats {
namespace {

OIIO::TypeDesc type_of(Sample sample) {
    switch (sample) {
        case Sample::u8:
            return OIIO::TypeDesc::UINT8;
        case Sample::u16:
            return OIIO::TypeDesc::UINT16;
        case Sample::f32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

/// OpenImageIO's message as one sentence: its first line, without a full stop.
std::string first_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
    return text.empty() ? "no reason given" : text;
}

/// Does `work`; what OpenImageIO throws of its own goes to `fail` as its words.
void attempt(const auto& fail, const auto& work) {
    try {
        work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        fail(e.what());
    }
}

class Input : public Reader {
  public:
    Input(const std::string& name, const char* format, std::span<const std::uint8_t> bytes);

    const Layout& layout() const override { return layout_; }
    void read_bands(Sample as,
                    const std::function<void(unsigned, unsigned, const std::uint8_t*)>& take) override;
    std::string complaint() override;

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(Exit::scene, "Image " + name_ + " cannot be read: " + first_line(what) + ".");
    }

    std::string name_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
    Layout layout_;
};

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
    if (spec_.channelnames.size() != std::size_t(spec_.nchannels)) fail("its channels are not all named");
    layout_ = {unsigned(spec_.width), unsigned(spec_.height), spec_.channelnames,
               spec_.format == OIIO::TypeDesc::UINT16};
}

std::string Input::complaint() {
    // libjpeg goes on after what it calls warnings: OpenImageIO keeps the last of them and reports success.
    std::string text = input_->geterror();
    if (text.empty()) return text;
    text = first_line(text);
    if (const std::size_t name = text.find(" (\""); name != std::string::npos) text.resize(name);
    return text;
}

void Input::read_bands(Sample as, const std::function<void(unsigned, unsigned, const std::uint8_t*)>& take) {
    const OIIO::TypeDesc type = type_of(as);
    const std::size_t row = std::size_t(spec_.width) * spec_.nchannels * type.size();
    constexpr int band = 64;
    // read_scanlines() of OpenImageIO 2.4 takes memory for 256 rows, however few it reads.
    constexpr std::size_t widest_of_many = std::size_t(1) << 18;
    std::vector<std::uint8_t> values(row * std::min(band, spec_.height));
    for (int y = 0; y < spec_.height; y += band) {
        const int rows = std::min(band, spec_.height - y), first = spec_.y + y;
        attempt([&](const char* what) { fail(what); },
                [&] {
                    bool read = true;
                    if (row <= widest_of_many)
                        read = input_->read_scanlines(0, 0, first, first + rows, 0, 0, spec_.nchannels, type,
                                                      values.data());
                    else
                        for (int i = 0; read && i < rows; ++i)
                            read = input_->read_scanline(first + i, 0, type,
                                                         values.data() + std::size_t(i) * row);
                    if (!read) fail(input_->geterror());
                });
        take(unsigned(y), unsigned(rows), values.data());
    }
}

OIIO::ImageSpec spec_of(const Outline& outline, Sample given) {
    OIIO::ImageSpec spec(int(outline.width), int(outline.height), int(outline.channels), type_of(given));
    for (const auto& [name, value] : outline.attributes)
        if (const int* number = std::get_if<int>(&value))
            spec.attribute(name, *number);
        else
            spec.attribute(name, std::get<std::string>(value));
    return spec;
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
    attempt(fail, [&] {
        output->set_ioproxy(&memory);
        const bool done = output->open(std::string("memory.") + format, spec) &&
                          output->write_image(type, values) && output->close();
        if (!done) fail(output->geterror());
    });
    return bytes;
}

class OpenImageIo : public Formats {
    std::unique_ptr<Reader> read(const std::string& name, const char* format,
                                 std::span<const std::uint8_t> bytes) const override {
        return std::make_unique<Input>(name, format, bytes);
    }
    std::vector<std::uint8_t> encode(const char* format, const Outline& outline, Sample given,
                                     const void* values) const override {
        return image_formats::encode(format, spec_of(outline, given), type_of(given), values);
    }
};

}  // namespace
}  // namespace triad::image_formats

/// The one name that the library shows. Null: it is of another version than who asks.
extern "C" [[gnu::visibility("default")]] const triad::image_formats::Formats* triad_image_formats(
    const char* version) {
    static const triad::image_formats::OpenImageIo formats;
    return std::strcmp(version, TRIAD_VERSION) == 0 ? &formats : nullptr;
}
