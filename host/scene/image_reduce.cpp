#include "scene/image_reduce.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/colour.h"
#include "base/parallel_for.h"

namespace triad {
namespace {

/// What the values of a channel mean, as light.
const std::vector<float>& meanings(unsigned bits, bool is_colour) {
    const auto table_of = [](std::size_t values, bool of_colour) {
        std::vector<float> table(values);
        for (std::size_t i = 0; i < values; ++i) {
            const double value = double(i) / double(values - 1);
            table[i] = float(of_colour ? srgb_decode(value) : value);
        }
        return table;
    };
    static const std::vector<float> tables[2][2] = {{table_of(1 << 8, false), table_of(1 << 8, true)},
                                                    {table_of(1 << 16, false), table_of(1 << 16, true)}};
    return tables[bits == 16][is_colour];
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

/// Of what a texel covers: one of the larger image's, whole, or a part at the ends.
struct Part {
    unsigned source;
    double share;
};

/// What each of `to` texels in a row covers of `from`.
std::vector<std::vector<Part>> covered(unsigned from, unsigned to) {
    std::vector<std::vector<Part>> all(to);
    const double step = double(from) / to;
    for (unsigned i = 0; i < to; ++i) {
        const double begin = i * step, end = std::min((i + 1) * step, double(from));
        for (auto k = unsigned(begin); k < from && k < end; ++k)
            if (const double part = std::min(end, k + 1.0) - std::max(begin, double(k)); part > 0)
                all[i].push_back({k, part / (end - begin)});
    }
    return all;
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
    const std::vector<float>&light = meanings(image.bits, is_colour), &plain = meanings(image.bits, false);
    const auto rows = covered(image.height, size.y), columns = covered(image.width, size.x);
    parallel_for(size.y, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> row(std::size_t(size.x) * 4);
        for (std::size_t y = begin; y < end; ++y) {
            std::fill(row.begin(), row.end(), 0.0);
            for (const Part& from_row : rows[y]) {
                const std::size_t start = std::size_t(from_row.source) * image.width * 4;
                for (unsigned x = 0; x < size.x; ++x)
                    for (const Part& from : columns[x])
                        for (std::size_t c = 0; c < 4; ++c)
                            row[4 * x + c] +=
                                from.share * from_row.share *
                                double((c < 3 ? light : plain)[value_at(image, start + 4 * from.source + c)]);
            }
            for (std::size_t i = 0; i < row.size(); ++i)
                put(small, y * size.x * 4 + i, row[i], is_colour && i % 4 < 3);
        }
    });
    return small;
}

Image with_bits(const Image& image, unsigned bits) {
    Image other{image.name, image.width, image.height, bits, {}};
    const std::size_t values = std::size_t(image.width) * image.height * 4;
    other.texels.resize(values * bits / 8);
    for (std::size_t i = 0; i < values; ++i)
        put(other, i, double(value_at(image, i)) / double((1u << image.bits) - 1), false);
    return other;
}

}  // namespace triad
