/// Pictures to PNG by libpng itself, which is there at once: OpenImageIO's libraries take longer to start
/// than a small picture takes to render.
#include "io/png_write.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "base/error.h"

namespace triad {
namespace {

/// What libpng's callbacks are given. They must not throw through it.
struct Output {
    std::vector<std::uint8_t> bytes;
    bool has_memory = true;
    char reason[200] = "no reason given";
};

void fail(png_structp png, png_const_charp reason) {
    std::snprintf(static_cast<Output*>(png_get_error_ptr(png))->reason, sizeof Output::reason, "%s", reason);
    png_longjmp(png, 1);
}

png_voidp allocate(png_structp png, png_alloc_size_t size) {
    void* memory = std::malloc(size);
    if (!memory) static_cast<Output*>(png_get_mem_ptr(png))->has_memory = false;
    return memory;
}

void release(png_structp, png_voidp memory) { std::free(memory); }

void append(png_structp png, png_bytep data, std::size_t size) {
    auto& output = *static_cast<Output*>(png_get_io_ptr(png));
    try {
        output.bytes.insert(output.bytes.end(), data, data + size);
    } catch (const std::bad_alloc&) {
        output.has_memory = false;
    }
    if (!output.has_memory) png_error(png, "out of memory");
}

/// Nothing of C++ lives here that a jump would leave behind. False: `output` says why.
bool write(const EncodedPicture& picture, std::vector<png_text>& texts, png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png))) return false;
    const int type = picture.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : picture.channels == 3 ? PNG_COLOR_TYPE_RGB
                                             : PNG_COLOR_TYPE_RGBA;
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png, info, picture.width, picture.height, int(picture.bits), type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_NO_FILTERS);  // which noise makes longer
    png_set_text(png, info, texts.data(), int(texts.size()));
    png_write_info(png, info);
    if (picture.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    const std::size_t row = picture.bytes.size() / picture.height;
    for (unsigned y = 0; y < picture.height; ++y) png_write_row(png, picture.bytes.data() + row * y);
    png_write_end(png, info);
    return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const EncodedPicture& picture) {
    Output output;
    std::vector<png_text> texts;
    for (const auto& [name, value] : picture.metadata) {
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(name.c_str());  // libpng copies both
        text.text = const_cast<char*>(value.c_str());
        text.text_length = value.size();
        texts.push_back(text);
    }
    png_structp png = png_create_write_struct_2(
        PNG_LIBPNG_VER_STRING, &output, fail, [](png_structp, png_const_charp) {}, &output, allocate,
        release);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (info) png_set_write_fn(png, &output, append, nullptr);
    const bool done = info && write(picture, texts, png, info);
    png_destroy_write_struct(&png, &info);
    if (!output.has_memory) throw std::bad_alloc();
    if (!done)
        throw Error(Exit::scene, std::string("Cannot encode the picture as png: ") + output.reason + ".");
    return std::move(output.bytes);
}

}  // namespace triad
