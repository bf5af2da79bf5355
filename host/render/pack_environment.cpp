#include <bit>
#include <cmath>

#include "base/parallel_for.h"
#include "render/pack.h"

namespace triad {
namespace {

/// Directions are drawn from a grid this many times coarser than the map: small enough to stay in a CPU's
/// second cache, which is worth more than the last bit of sharpness (docs/performance.md, "Environment
/// maps").
constexpr std::size_t coarser = 4;

/// The texel as 8-bit mantissas with one exponent (ENVIRONMENT_RGBE), when that is exact; .hdr files hold
/// nothing else.
bool encode_rgbe(const float* rgb, std::uint32_t& out) {
    const float top = std::max({rgb[0], rgb[1], rgb[2]});
    out = 0;
    if (top == 0.0f) return true;
    int exponent;
    std::frexp(top, &exponent);  // top in [2^(exponent - 1), 2^exponent): its mantissa in [128, 256)
    const int biased = exponent - 8 + 127;
    if (biased < 1 || biased > 254) return false;
    for (int c = 0; c < 3; ++c) {
        const float mantissa = std::ldexp(rgb[c], 8 - exponent);
        if (mantissa != std::floor(mantissa) || mantissa > 255.0f) return false;
        out |= static_cast<std::uint32_t>(mantissa) << (8 * c);
    }
    out |= static_cast<std::uint32_t>(biased) << 24;
    return true;
}

void pack_texels(const EnvironmentMap& map, PackedScene& packed) {
    const std::size_t texels = std::size_t(map.width) * map.height;
    packed.environment.format = ENVIRONMENT_RGBE;
    packed.env_texels.resize(texels);
    for (std::size_t i = 0; i < texels; ++i)
        if (!encode_rgbe(map.rgb.data() + i * 3, packed.env_texels[i])) {
            packed.environment.format = ENVIRONMENT_FLOAT;
            break;
        }
    if (packed.environment.format == ENVIRONMENT_RGBE) return;
    packed.env_texels.assign(texels * 4, 0);
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            packed.env_texels[i * 4 + c] = std::bit_cast<std::uint32_t>(map.rgb[i * 3 + c]);
}

}  // namespace

void pack_environment(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    dev::Environment& e = packed.environment;
    e.light = TRIAD_NONE;
    e.strength = static_cast<float>(settings.environment_strength);
    e.rotate_cos = static_cast<float>(std::cos(settings.environment_rotation));
    e.rotate_sin = static_cast<float>(std::sin(settings.environment_rotation));
    if (!scene.environment) {
        for (int c = 0; c < 3; ++c)
            e.colour[c] = static_cast<float>(scene.sky[c] * settings.environment_strength);
        return;
    }
    const EnvironmentMap& map = *scene.environment;
    const std::size_t w = map.width, h = map.height;
    e.width = map.width;
    e.height = map.height;
    pack_texels(map, packed);

    const std::size_t step = w % coarser == 0 && h % coarser == 0 && w > 8 * coarser ? coarser : 1;
    const std::size_t columns = w / step, rows = h / step;
    e.cells[0] = static_cast<std::uint32_t>(columns);
    e.cells[1] = static_cast<std::uint32_t>(rows);
    e.rows = cdf_shape(rows);
    e.columns = cdf_shape(columns);
    for (std::size_t y = 0; y <= rows; ++y)
        packed.env_cosines.push_back(
            static_cast<float>(std::cos(pi * static_cast<double>(y) / static_cast<double>(rows))));

    /// Solid angle of one of `across` parts of the band between the map's heights a and b, in parts of
    /// `down`.
    auto solid_angle = [](double a, double b, std::size_t down, std::size_t across) {
        const double t0 = pi * a / static_cast<double>(down), t1 = pi * b / static_cast<double>(down);
        return 2.0 * pi / static_cast<double>(across) * 2.0 * std::sin(0.5 * (t0 + t1)) *
               std::sin(0.5 * (t1 - t0));
    };
    auto texel_angle = [&](std::size_t y) { return solid_angle(double(y), double(y) + 1.0, h, w); };

    // A texel's weight is the integral of the bilinear interpolant over it (1, 6, 1 in each direction), so
    // that every direction with light can be drawn, times its solid angle.
    std::vector<double> across(w * h), row_weight(rows);
    parallel_for(h, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> luminance(w);
        for (std::size_t y = begin; y < end; ++y) {
            for (std::size_t x = 0; x < w; ++x) {
                const float* t = map.rgb.data() + (y * w + x) * 3;
                luminance[x] = 0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2];
            }
            for (std::size_t x = 0; x < w; ++x)
                across[y * w + x] =
                    (luminance[(x + w - 1) % w] + 6.0 * luminance[x] + luminance[(x + 1) % w]) / 8.0;
        }
    });
    packed.env_columns.resize(rows * e.columns.size);
    packed.env_densities.resize(rows * columns);
    parallel_for(rows, 4, [&](std::size_t begin, std::size_t end) {
        std::vector<double> weights(columns);
        for (std::size_t row = begin; row < end; ++row) {
            std::fill(weights.begin(), weights.end(), 0.0);
            for (std::size_t y = row * step; y < (row + 1) * step; ++y) {
                const std::size_t above = y == 0 ? 0 : y - 1, below = y + 1 == h ? y : y + 1;
                for (std::size_t x = 0; x < w; ++x)
                    weights[x / step] +=
                        texel_angle(y) *
                        (across[above * w + x] + 6.0 * across[y * w + x] + across[below * w + x]) / 8.0;
            }
            for (double weight : weights) row_weight[row] += weight;
            const std::vector<std::uint32_t> cdf = integer_cdf(weights);
            write_cdf_tree(e.columns, cdf, packed.env_columns.data() + row * e.columns.size);
            const double cell = solid_angle(double(row), double(row) + 1.0, rows, columns);
            for (std::size_t x = 0; x < columns; ++x)
                packed.env_densities[row * columns + x] =
                    static_cast<float>((cdf[x + 1] - cdf[x]) / 4294967296.0 / cell);
        }
    });
    const std::vector<std::uint32_t> row_cdf = integer_cdf(row_weight);
    packed.env_rows.resize(e.rows.size);
    write_cdf_tree(e.rows, row_cdf, packed.env_rows.data());
    for (std::size_t i = 0; i < rows * columns; ++i)
        packed.env_densities[i] *=
            static_cast<float>((row_cdf[i / columns + 1] - row_cdf[i / columns]) / 4294967296.0);

    dvec3 mean(0.0);
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            const float* t = map.rgb.data() + (y * w + x) * 3;
            mean += dvec3(t[0], t[1], t[2]) * texel_angle(y);
        }
    mean *= settings.environment_strength / (4.0 * pi);
    for (int c = 0; c < 3; ++c) e.colour[c] = static_cast<float>(mean[c]);
}

}  // namespace triad
