#include "display/resolve.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "base/colour.h"
#include "base/parallel_for.h"

namespace triad {
namespace {

constexpr std::size_t pixels_per_chunk = 4096;

/// Rounded to the nearest of `top` + 1 steps; NaN is 0.
unsigned quantise(double value, unsigned top) {
    return value > 0.0 ? unsigned(std::min(value, 1.0) * top + 0.5) : 0u;
}

}  // namespace

std::vector<float> resolve_linear(const Film& film) {
    std::vector<float> rgba(film.pixels() * 4);
    parallel_for(film.pixels(), pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::array<double, 4> mean = pixel_mean(film, p);
            std::copy(mean.begin(), mean.end(), rgba.begin() + std::ptrdiff_t(p * 4));
        }
    });
    return rgba;
}

void put_on_background(std::vector<float>& rgba, const vec3& colour) {
    for (std::size_t i = 0; i + 4 <= rgba.size(); i += 4) {
        for (int c = 0; c < 3; ++c) rgba[i + c] += (1.0f - rgba[i + 3]) * colour[c];
        rgba[i + 3] = 1.0f;
    }
}

std::vector<std::uint8_t> encode_srgb(const std::vector<float>& rgba, unsigned channels, unsigned bits) {
    if ((channels != 3 && channels != 4) || (bits != 8 && bits != 16))
        throw std::logic_error("encode_srgb makes 3 or 4 channels of 8 or 16 bits");
    const unsigned top = bits == 8 ? 255 : 65535;
    const std::size_t pixels = rgba.size() / 4, bytes = bits / 8;
    std::vector<std::uint8_t> encoded(pixels * channels * bytes);
    parallel_for(pixels, pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            for (unsigned c = 0; c < channels; ++c) {
                const double alpha = rgba[p * 4 + 3], v = rgba[p * 4 + c];
                const bool divide = channels == 4 && c < 3 && alpha > 0.0 && alpha < 1.0;
                const std::uint16_t code =
                    std::uint16_t(quantise(c == 3 ? alpha : srgb_encode(divide ? v / alpha : v), top));
                if (bytes == 1) {
                    encoded[p * channels + c] = std::uint8_t(code);
                } else {
                    std::memcpy(&encoded[(p * channels + c) * 2], &code, 2);
                }
            }
    });
    return encoded;
}

}  // namespace triad
