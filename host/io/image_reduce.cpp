#include "io/image_reduce.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/colour.h"

namespace triad {
namespace {

/// What the values of a channel mean, as light.
std::vector<float> meanings(unsigned bits, bool is_colour) {
    const std::size_t n = std::size_t(1) << bits;
    std::vector<float> table(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double value = double(i) / double(n - 1);
        table[i] = float(is_colour ? srgb_decode(value) : value);
    }
    return table;
}

unsigned value_at(const Image& image, std::size_t i) {
    if (image.bits == 8) return image.texels[i];
    std::uint16_t value;
    std::memcpy(&value, &image.texels[2 * i], sizeof value);
    return value;
}

void put(Image& image, std::size_t i, double value, bool is_colour) {
    const double encoded = is_colour ? srgb_encode(value) : value;
    const unsigned most = (1u << image.bits) - 1;
    const auto number = std::uint16_t(std::clamp(std::floor(encoded * most + 0.5), 0.0, double(most)));
    if (image.bits == 8)
        image.texels[i] = std::uint8_t(number);
    else
        std::memcpy(&image.texels[2 * i], &number, sizeof number);
}

/// Calls add(source, share) for all that texel `i` of `to` covers of `from`: whole ones and parts at the
/// ends.
template <class Add>
void for_covered(unsigned i, unsigned from, unsigned to, const Add& add) {
    const double step = double(from) / to, begin = i * step, end = std::min((i + 1) * step, double(from));
    for (auto k = unsigned(begin); k < from && k < end; ++k)
        if (const double part = std::min(end, k + 1.0) - std::max(begin, double(k)); part > 0)
            add(k, part / (end - begin));
}

}  // namespace

uvec2 reduced_size(unsigned width, unsigned height, unsigned longer) {
    const unsigned side = std::max(width, height);
    if (side <= longer) return {width, height};
    const auto scaled = [&](unsigned n) {
        return std::max(1u, unsigned((std::uint64_t(n) * longer + side / 2) / side));
    };
    return {scaled(width), scaled(height)};
}

Image reduced(const Image& image, unsigned longer, bool is_colour) {
    const uvec2 size = reduced_size(image.width, image.height, longer);
    Image small{image.name, size.x, size.y, image.bits, {}};
    small.texels.resize(std::size_t(size.x) * size.y * 4 * image.bits / 8);
    const std::vector<float> light = meanings(image.bits, is_colour), plain = meanings(image.bits, false);
    std::vector<double> row(std::size_t(size.x) * 4);
    for (unsigned y = 0; y < size.y; ++y) {
        std::fill(row.begin(), row.end(), 0.0);
        for_covered(y, image.height, size.y, [&](unsigned from_y, double share_y) {
            const std::size_t start = std::size_t(from_y) * image.width * 4;
            for (unsigned x = 0; x < size.x; ++x)
                for_covered(x, image.width, size.x, [&](unsigned from_x, double share_x) {
                    for (std::size_t c = 0; c < 4; ++c)
                        row[4 * x + c] +=
                            share_x * share_y *
                            double((c < 3 ? light : plain)[value_at(image, start + 4 * from_x + c)]);
                });
        });
        for (std::size_t i = 0; i < row.size(); ++i)
            put(small, std::size_t(y) * size.x * 4 + i, row[i], is_colour && i % 4 < 3);
    }
    return small;
}

}  // namespace triad
