#pragma once
/// What reads PNG, JPEG and WebP and writes JPEG and HDR, from and to memory: OpenImageIO, behind a border
/// without its types. It lies in a library of its own, triad-images (host/images), that is loaded when it is
/// first needed: the 230 libraries that it brings take longer to start than a small picture takes to render.
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace triad::image_formats {

/// A channel's type in a file or in memory. Integers are 0 to 1 as float.
enum class Sample { u8, u16, f32 };

/// What a file says of its picture.
struct Layout {
    unsigned width = 0, height = 0;
    std::vector<std::string> channels;  ///< names
    bool wide = false;                  ///< integers of 16 bits
};

/// Reads one file. Throws Error(scene) with its name.
class Reader {
  public:
    virtual ~Reader() = default;
    virtual const Layout& layout() const = 0;

    /// All channels as `as`, top to bottom, a band of rows at a time, so that a file that ends early has cost
    /// little memory. `take(first row, rows, interleaved values)`.
    virtual void read_bands(Sample as,
                            const std::function<void(unsigned, unsigned, const std::uint8_t*)>& take) = 0;

    /// What the decoder passed over while it read, in its words; empty: nothing. Once.
    virtual std::string complaint() = 0;
};

/// A picture to write.
struct Outline {
    unsigned width = 0, height = 0;
    unsigned channels = 0;
    std::vector<std::pair<std::string, std::variant<int, std::string>>> attributes;
};

/// Formats go by OpenImageIO's names of them and are never guessed: its other readers are not for untrusted
/// bytes.
class Formats {
  public:
    virtual ~Formats() = default;
    /// `bytes` must outlive the reader. Alpha stays as stored. Throws Error(scene) with `name`.
    virtual std::unique_ptr<Reader> read(const std::string& name, const char* format,
                                         std::span<const std::uint8_t> bytes) const = 0;
    /// Encodes interleaved values, all of type `given`. Throws Error(scene).
    virtual std::vector<std::uint8_t> encode(const char* format, const Outline& outline, Sample given,
                                             const void* values) const = 0;
};

/// Loads the library when first called, from any thread. Throws Error(scene) where it cannot be loaded,
/// Error(memory) where the shell's limits are why.
const Formats& loaded();

}  // namespace triad::image_formats
