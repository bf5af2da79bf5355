#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "pack/pack.h"

namespace triad {

std::vector<std::uint32_t> integer_cdf(std::span<const double> weights) {
    constexpr double whole = 4294967295.0;
    std::vector<std::uint32_t> cdf(weights.size() + 1, 0);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double positive =
        double(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
    double sum = 0, before = 0;
    for (std::size_t i = 0; i < weights.size() && total > 0; ++i) {
        sum += weights[i];
        before += weights[i] > 0;
        cdf[i + 1] = static_cast<std::uint32_t>(before + std::floor(sum / total * (whole - positive) + 0.5));
    }
    cdf.back() = 0xffffffffu;
    return cdf;
}

dev::CdfShape cdf_shape(std::size_t n) {
    dev::CdfShape shape{};
    std::vector<std::size_t> sizes;  // from the leaves up; the leaves have the final bound too
    for (std::size_t level = n; sizes.empty() || level > 1; level = (level + 7) / 8)
        sizes.push_back((level + (sizes.empty() ? 1 : 0) + 7) / 8 * 8);
    if (sizes.size() > CDF_LEVELS)
        throw Error(Exit::memory,
                    "The scene has more lights (" + std::to_string(n) + ") than can be picked from.");
    std::size_t at = 0;
    for (auto size = sizes.rbegin(); size != sizes.rend(); at += *size++)
        shape.first[shape.levels++] = static_cast<std::uint32_t>(at);
    shape.size = static_cast<std::uint32_t>(at);
    return shape;
}

void write_cdf_tree(const dev::CdfShape& shape, std::span<const std::uint32_t> bounds, std::uint32_t* out) {
    std::fill(out, out + shape.size, 0xffffffffu);
    std::size_t step = 1;
    for (std::uint32_t level = shape.levels; level-- > 0; step *= 8)
        for (std::size_t i = 0; i * step < bounds.size() && (i * step + 1 < bounds.size() || step == 1); ++i)
            out[shape.first[level] + i] = bounds[i * step];
}

dev::ColumnsShape columns_shape(std::size_t w, std::size_t h) {
    dev::ColumnsShape shape{};
    std::vector<std::size_t> sizes;  // from the columns up
    do {
        const std::size_t n = sizes.empty() ? w : sizes.back() / COLUMNS_FANOUT;
        sizes.push_back((n + COLUMNS_FANOUT - 1) / COLUMNS_FANOUT * COLUMNS_FANOUT);
    } while (sizes.back() > COLUMNS_FANOUT);
    if (sizes.size() > COLUMNS_LEVELS)
        throw Error(Exit::scene,
                    "The environment map is " + std::to_string(w) + " pixels wide; at most 32768 are read.");
    for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
        shape.first[shape.levels] = shape.size;
        shape.stride[shape.levels++] = static_cast<std::uint32_t>(*size);
        shape.size += static_cast<std::uint32_t>(*size * h);
    }
    return shape;
}

std::vector<std::uint32_t> column_shares(std::span<const double> weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double rest = 65536.0 - double(weights.size());
    std::vector<std::uint32_t> bounds(weights.size() + 1);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        const double share = total > 0 ? std::min(sum / total, 1.0) : double(i + 1) / double(weights.size());
        bounds[i + 1] = static_cast<std::uint32_t>(double(i + 1) + std::floor(share * rest + 0.5));
    }
    bounds.back() = 65536;
    return bounds;
}

void write_columns(const dev::ColumnsShape& shape, std::size_t row, std::span<const std::uint32_t> bounds,
                   std::uint16_t* out) {
    std::size_t step = 1;
    const std::size_t columns = bounds.size() - 1;
    for (std::uint32_t level = shape.levels; level-- > 0; step *= COLUMNS_FANOUT) {
        std::uint16_t* entries = out + shape.first[level] + row * shape.stride[level];
        for (std::size_t i = 0; i * step < columns; ++i)
            entries[i] = static_cast<std::uint16_t>(bounds[std::min((i + 1) * step, columns)] - 1);
    }
}

}  // namespace triad
