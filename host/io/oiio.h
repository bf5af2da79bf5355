#pragma once
/// OpenImageIO from and to memory, with its failures as Error(scene) sentences. Formats are named, never
/// guessed: its other readers are not for untrusted bytes.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triad::oiio {

/// A format reader over bytes that must outlive it.
class Input {
  public:
    /// `format`: OpenImageIO's name of it. Alpha stays as stored. Throws Error(scene) with `name`.
    Input(const std::string& name, const char* format, std::span<const std::uint8_t> bytes);
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    const OIIO::ImageSpec& spec() const { return spec_; }

    /// Reads all channels of `type`, top to bottom, a band of rows at a time, so that a file that ends early
    /// has cost little memory. `take(first row, rows, interleaved values)`.
    void read_bands(OIIO::TypeDesc type,
                    const std::function<void(unsigned, unsigned, const std::uint8_t*)>& take);

    /// What the decoder passed over while it read, in its words; empty: nothing. Once.
    std::string complaint();

  private:
    [[noreturn]] void fail(const std::string& what);

    std::string name_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
};

/// Encodes interleaved values of `type` as a file of this format. Throws Error(scene).
std::vector<std::uint8_t> encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                 const void* values);

}  // namespace triad::oiio
