#include <cmath>

#include "base/parallel_for.h"
#include "render/pack.h"

namespace triad {

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
    e.rows = cdf_shape(h);
    e.columns = cdf_shape(w);
    for (std::size_t y = 0; y <= h; ++y)
        packed.env_cosines.push_back(
            static_cast<float>(std::cos(pi * static_cast<double>(y) / static_cast<double>(h))));

    // A cell's weight is the integral of the bilinear interpolant over it (1, 6, 1 in each direction), so
    // that every direction with light can be drawn, times its solid angle.
    std::vector<double> luminance(w * h), across(w * h), row_weight(h);
    dvec3 mean(0.0);
    packed.env_columns.resize(h * e.columns.size);
    packed.env_texels.resize(h * w * 4);
    parallel_for(h, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (std::size_t x = 0; x < w; ++x) {
                const float* t = map.rgb.data() + (y * w + x) * 3;
                luminance[y * w + x] = 0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2];
            }
            for (std::size_t x = 0; x < w; ++x)
                across[y * w + x] = (luminance[y * w + (x + w - 1) % w] + 6.0 * luminance[y * w + x] +
                                     luminance[y * w + (x + 1) % w]) /
                                    8.0;
        }
    });
    auto solid_angle = [&](std::size_t y) {
        const double a = pi * static_cast<double>(y) / static_cast<double>(h),
                     b = pi * static_cast<double>(y + 1) / static_cast<double>(h);
        return 2.0 * pi / static_cast<double>(w) * 2.0 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
    };
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
            const std::vector<std::uint32_t> cdf = integer_cdf(weights);
            write_cdf_tree(e.columns, cdf, packed.env_columns.data() + y * e.columns.size);
            for (std::size_t x = 0; x < w; ++x) {
                float* texel = packed.env_texels.data() + (y * w + x) * 4;
                std::copy_n(map.rgb.data() + (y * w + x) * 3, 3, texel);
                texel[3] = static_cast<float>((cdf[x + 1] - cdf[x]) / 4294967296.0 / (solid_angle(y)));
            }
        }
    });
    const std::vector<std::uint32_t> rows = integer_cdf(row_weight);
    packed.env_rows.resize(e.rows.size);
    write_cdf_tree(e.rows, rows, packed.env_rows.data());
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x)
            packed.env_texels[(y * w + x) * 4 + 3] *=
                static_cast<float>((rows[y + 1] - rows[y]) / 4294967296.0);
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            const float* t = map.rgb.data() + (y * w + x) * 3;
            mean += dvec3(t[0], t[1], t[2]) * solid_angle(y);
        }
    mean *= settings.environment_strength / (4.0 * pi);
    for (int c = 0; c < 3; ++c) e.colour[c] = static_cast<float>(mean[c]);
}

}  // namespace triad
