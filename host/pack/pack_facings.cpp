#include <algorithm>
#include <cmath>

#include "base/parallel_for.h"
#include "pack/pack.h"

namespace triad {
namespace {

/// Directions of a patch that stand for it, across and down.
constexpr std::size_t points = 8;
constexpr std::size_t across = PATCHES * points;

/// Cosines count from so far below the horizon of a facing: its cell's normals differ by as much.
constexpr float slack = 0.1f;
/// Of a patch's share what it has without a cosine: gloss and varnish see light otherwise than diffusely.
constexpr float even = 0.02f;

/// The world direction that environment_sample() (kernels/shading/environment.h) draws by numbers in [0, 1).
vec3 direction(const PackedSurfaces& surfaces, double u, double v) {
    const dev::Environment& e = surfaces.environment;
    const std::uint32_t* rows = surfaces.env_rows.data() + e.rows.first[e.rows.levels - 1];
    const double number = v * 4294967296.0;
    const std::size_t row = std::min<std::size_t>(
        std::size_t(std::upper_bound(rows, rows + e.height + 1, std::uint32_t(number)) - rows - 1),
        e.height - 1);
    const double in_row = (number - rows[row]) / std::max(1.0, double(rows[row + 1]) - rows[row]);
    const double y = std::lerp(surfaces.env_cosines[row], surfaces.env_cosines[row + 1], in_row);

    const std::uint32_t last = e.columns.levels - 1;
    const std::uint16_t* columns =
        surfaces.env_columns.data() + e.columns.first[last] + row * e.columns.stride[last];
    const double share = u * 65536.0;
    const std::size_t column =
        std::size_t(std::lower_bound(columns, columns + e.width - 1, std::uint16_t(share)) - columns);
    const double first = column == 0 ? 0.0 : columns[column - 1] + 1.0;
    const double in_column = (share - first) / (columns[column] + 1.0 - first);
    const double turn = 2.0 * pi * ((double(column) + in_column) / e.width - 0.5);
    const double s = std::sqrt(std::max(0.0, 1.0 - y * y)), x = s * std::cos(turn), z = s * std::sin(turn);
    return vec3(dvec3(e.rotate_cos * x - e.rotate_sin * z, y, e.rotate_cos * z + e.rotate_sin * x));
}

/// The middle of cell (i, j) of the octahedron.
vec3 normal_of(std::size_t i, std::size_t j) {
    const auto middle = [](std::size_t cell) { return float(2 * cell + 1) / FACINGS - 1.0f; };
    float x = middle(i), z = middle(j);
    const float y = 1.0f - std::abs(x) - std::abs(z);
    if (y < 0.0f) {
        const float a = 1.0f - std::abs(z), b = 1.0f - std::abs(x);
        x = std::copysign(a, x), z = std::copysign(b, z);
    }
    return normalize(vec3(x, y, z));
}

/// The last share of every entry, by column_shares().
void write_shares(const std::vector<double>& weights, std::uint16_t* out) {
    const std::vector<std::uint32_t> bounds = column_shares(weights);
    for (std::size_t i = 0; i < weights.size(); ++i) out[i] = std::uint16_t(bounds[i + 1] - 1);
}

}  // namespace

std::vector<std::uint16_t> facing_shares(const PackedSurfaces& surfaces) {
    std::vector<vec3> directions(across * across);
    for (std::size_t i = 0; i < directions.size(); ++i)
        directions[i] =
            direction(surfaces, (double(i % across) + 0.5) / across, (double(i / across) + 0.5) / across);
    std::vector<std::uint16_t> all(FACINGS * FACINGS * FACING_SHARES);
    parallel_for(FACINGS * FACINGS, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t facing = begin; facing < end; ++facing) {
            const vec3 n = normal_of(facing / FACINGS, facing % FACINGS);
            std::vector<double> patches(PATCHES * PATCHES);
            for (std::size_t y = 0; y < across; ++y)
                for (std::size_t x = 0; x < across; ++x)
                    patches[y / points * PATCHES + x / points] +=
                        std::max(0.0f, dot(n, directions[y * across + x]) + slack) + even;
            std::vector<double> rows(PATCHES);
            std::uint16_t* out = all.data() + facing * FACING_SHARES;
            for (std::size_t row = 0; row < PATCHES; ++row) {
                const std::vector<double> weights(patches.begin() + long(row * PATCHES),
                                                  patches.begin() + long((row + 1) * PATCHES));
                for (const double weight : weights) rows[row] += weight;
                write_shares(weights, out + PATCHES + row * PATCHES);
            }
            write_shares(rows, out);
        }
    });
    return all;
}

}  // namespace triad
