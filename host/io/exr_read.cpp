#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/parallel_for.h"
#include "io/linear_decode.h"

namespace triad {
namespace {

/// From so many values on several threads are worth their start.
constexpr std::size_t many_values = std::size_t(1) << 20;

/// The file in memory.
class GivenBytes : public Imf::IStream {
  public:
    explicit GivenBytes(std::span<const std::uint8_t> bytes) : IStream(name), bytes_(bytes) {}
    static constexpr const char* name = "these bytes";

    bool read(char to[], int size) override {
        if (size < 0 || std::size_t(size) > bytes_.size() - at_) throw std::runtime_error("it ends early");
        std::memcpy(to, bytes_.data() + at_, std::size_t(size));
        at_ += std::size_t(size);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw std::runtime_error("it ends early");
        at_ = std::size_t(position);
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

void decode(const CleanExr& exr, const TakeRows& take) {
    const std::size_t channels = exr.channels.size(), row = exr.width * channels;
    GivenBytes memory(exr.bytes);
    Imf::InputFile file(memory, exr_threads(row * exr.height));
    const Imath::Box2i window = file.header().dataWindow();
    const Imath::V2i size = window.size() + Imath::V2i(1, 1);
    if (size.x != int(exr.width) || size.y != int(exr.height))  // what is written to is measured by `exr`
        throw std::runtime_error("its header can be read in two ways");
    // No strip of a compression has more rows than 256; a strip that is cut is not unpacked twice.
    constexpr std::size_t values_at_once = std::size_t(1) << 22;
    const unsigned band =
        unsigned(std::min<std::size_t>(exr.height, std::clamp<std::size_t>(values_at_once / row, 1, 256)));
    std::vector<float> values(row * band);
    for (unsigned y = 0; y < exr.height; y += band) {
        const unsigned rows = std::min(band, exr.height - y);
        const int first = window.min.y + int(y), last = first + int(rows) - 1;
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels; ++c)
            buffer.insert(exr.channels[c],
                          Imf::Slice::Make(Imf::FLOAT, values.data() + c,
                                           Imath::Box2i({window.min.x, first}, {window.max.x, last}),
                                           channels * sizeof(float), row * sizeof(float)));
        file.setFrameBuffer(buffer);
        file.readPixels(first, last);
        take(rows, values.data());
    }
}

/// A message as half a sentence: its first line, without what leads to it and without a full stop.
std::string half_a_sentence(std::string text) {
    const std::string file = std::string("\"") + GivenBytes::name + "\". ";
    if (const std::size_t at = text.find(file); at != std::string::npos) text.erase(0, at + file.size());
    text = text.substr(0, text.find('\n'));
    while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
    return text;
}

}  // namespace

int exr_threads(std::size_t values) {
    if (values < many_values) return 0;
    try {
        for (int threads = Imf::globalThreadCount(); threads < int(host_threads()); ++threads)
            Imf::setGlobalThreadCount(threads + 1);
    } catch (const std::system_error&) {  // a shell's limit: fewer do all the same
    }
    return Imf::globalThreadCount();
}

void decode_exr(const std::string& name, const CleanExr& exr, const TakeRows& take) {
    try {
        decode(exr, take);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        if (std::strstr(e.what(), "bad_alloc")) throw std::bad_alloc();  // of one of OpenEXR's threads
        throw Error(Exit::scene, "Image " + name + " cannot be read: " + half_a_sentence(e.what()) + ".");
    }
}

}  // namespace triad
