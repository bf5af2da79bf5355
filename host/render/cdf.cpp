#include <algorithm>

#include "base/error.h"
#include "render/pack.h"

namespace triad {

std::vector<std::uint32_t> integer_cdf(std::span<const double> weights) {
    double total = 0;
    for (double w : weights) total += w;
    std::vector<std::uint32_t> cdf(weights.size() + 1, 0);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        cdf[i + 1] =
            total > 0 ? static_cast<std::uint32_t>(std::min(sum / total, 1.0) * 4294967295.0 + 0.5) : 0u;
    }
    // Rounding must not give an interval to trailing entries of weight zero.
    std::size_t last = weights.size();
    while (last > 1 && total > 0 && weights[last - 1] == 0.0) --last;
    for (std::size_t i = last; i <= weights.size(); ++i) cdf[i] = 0xffffffffu;
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

}  // namespace triad
