#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel_for.h"
#include "pack/pack.h"

namespace triad {
namespace {

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

/// Texels with their densities, in the smaller format that is exact.
void pack_texels(const EnvironmentMap& map, const std::vector<float>& densities, PackedSurfaces& surfaces) {
    const std::size_t texels = densities.size();
    surfaces.environment.format = ENVIRONMENT_RGBE;
    surfaces.env_texels.resize(texels * 2);
    for (std::size_t i = 0; i < texels; ++i) {
        surfaces.env_texels[i * 2 + 1] = std::bit_cast<std::uint32_t>(densities[i]);
        if (!encode_rgbe(map.rgb.data() + i * 3, surfaces.env_texels[i * 2])) {
            surfaces.environment.format = ENVIRONMENT_FLOAT;
            break;
        }
    }
    if (surfaces.environment.format == ENVIRONMENT_RGBE) return;
    surfaces.env_texels.resize(texels * 4);
    for (std::size_t i = 0; i < texels; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            surfaces.env_texels[i * 4 + c] = std::bit_cast<std::uint32_t>(map.rgb[i * 3 + c]);
        surfaces.env_texels[i * 4 + 3] = std::bit_cast<std::uint32_t>(densities[i]);
    }
}

}  // namespace

void pack_environment(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces) {
    dev::Environment& e = surfaces.environment;
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
    e.rows = cdf_shape(h);
    e.columns = columns_shape(w, h);
    for (std::size_t y = 0; y <= h; ++y)
        surfaces.env_cosines.push_back(
            static_cast<float>(std::cos(pi * static_cast<double>(y) / static_cast<double>(h))));
    auto solid_angle = [&](std::size_t y) {
        const double a = pi * static_cast<double>(y) / static_cast<double>(h),
                     b = pi * static_cast<double>(y + 1) / static_cast<double>(h);
        return 2.0 * pi / static_cast<double>(w) * 2.0 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
    };

    // A texel's weight is the integral of the bilinear interpolant over it (1, 6, 1 in each direction), so
    // that every direction with light can be drawn, times its solid angle.
    std::vector<double> across(w * h), row_weight(h);
    std::vector<float> densities(w * h);
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
    surfaces.env_columns.assign(e.columns.size, 0xffff);
    parallel_for(h, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<double> weights(w);
        for (std::size_t y = begin; y < end; ++y) {
            const std::size_t above = y == 0 ? 0 : y - 1, below = y + 1 == h ? y : y + 1;
            double sum = 0;
            for (std::size_t x = 0; x < w; ++x) {
                weights[x] = (across[above * w + x] + 6.0 * across[y * w + x] + across[below * w + x]) / 8.0;
                sum += weights[x];
            }
            row_weight[y] = sum * solid_angle(y);
            const std::vector<std::uint32_t> shares = column_shares(weights);
            write_columns(e.columns, y, shares, surfaces.env_columns.data());
            for (std::size_t x = 0; x < w; ++x)
                densities[y * w + x] =
                    static_cast<float>((shares[x + 1] - shares[x]) / 65536.0 / solid_angle(y));
        }
    });
    const std::vector<std::uint32_t> rows = integer_cdf(row_weight);
    surfaces.env_rows.resize(e.rows.size);
    write_cdf_tree(e.rows, rows, surfaces.env_rows.data());
    for (std::size_t i = 0; i < w * h; ++i)
        densities[i] *= static_cast<float>((rows[i / w + 1] - rows[i / w]) / 4294967296.0);
    pack_texels(map, densities, surfaces);
    const std::vector<std::uint16_t> facings = facing_shares(surfaces);
    surfaces.env_columns.insert(surfaces.env_columns.end(), facings.begin(), facings.end());

    dvec3 mean(0.0);
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            const float* t = map.rgb.data() + (y * w + x) * 3;
            mean += dvec3(t[0], t[1], t[2]) * solid_angle(y);
        }
    mean *= settings.environment_strength / (4.0 * pi);
    for (int c = 0; c < 3; ++c) e.colour[c] = static_cast<float>(mean[c]);
}

}  // namespace triad
