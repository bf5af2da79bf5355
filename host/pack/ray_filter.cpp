#include "pack/ray_filter.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace triad {
namespace {

/// The filters of the channels that share a table, on one grid of taps.
struct Grid {
    int first_x = 0, first_y = 0;
    unsigned width = 0, height = 0;
    std::vector<std::array<double, 3>> filters;  ///< [row][column][R, G, B]: integral over the tap
};

/// `channels` of pixel i of the cell; all three have the filter of the first where there is one only.
Grid grid_of(const TapTable& table, std::size_t i, unsigned first_channel, unsigned channels) {
    Grid grid;
    int end_x = 0, end_y = 0;
    for (unsigned c = 0; c < channels; ++c) {
        const Taps& taps = table.outputs[i * 3 + first_channel + c];
        grid.first_x = c ? std::min(grid.first_x, taps.first_x) : taps.first_x;
        grid.first_y = c ? std::min(grid.first_y, taps.first_y) : taps.first_y;
        end_x = c ? std::max(end_x, taps.first_x + int(taps.width)) : taps.first_x + int(taps.width);
        end_y = c ? std::max(end_y, taps.first_y + int(taps.height)) : taps.first_y + int(taps.height);
    }
    grid.width = unsigned(end_x - grid.first_x), grid.height = unsigned(end_y - grid.first_y);
    grid.filters.resize(std::size_t(grid.width) * grid.height);
    for (unsigned c = 0; c < 3; ++c) {
        const Taps& taps = table.outputs[i * 3 + (channels == 3 ? c : first_channel)];
        for (unsigned v = 0; v < taps.height; ++v)
            for (unsigned u = 0; u < taps.width; ++u)
                grid.filters[std::size_t(taps.first_y - grid.first_y + int(v)) * grid.width +
                             std::size_t(taps.first_x - grid.first_x + int(u))][c] =
                    taps.weights[v * taps.width + u];
    }
    return grid;
}

std::vector<Grid> grids_of(const RenderSettings& s) {
    const unsigned bins = s.bins_x * s.bins_y;
    const std::size_t cells = std::size_t(s.ray_filter.cell_x) * s.ray_filter.cell_y;
    if ((bins != 1 && bins != 3) || s.ray_filter.outputs.size() != cells * 3)
        throw Error(Exit::usage,
                    "Rays that start by a pixel filter need 1x1 bins (one path for all channels) or "
                    "3x1 (one for each).");
    std::vector<Grid> grids;
    for (std::size_t i = 0; i < cells; ++i)
        for (unsigned bin = 0; bin < bins; ++bin)
            grids.push_back(grid_of(s.ray_filter, i, bin, bins == 1 ? 3 : 1));
    return grids;
}

/// Upper bounds in [0, 1] of intervals of these lengths; the last that has any length ends at 1.
void append_bounds(std::vector<float>& out, const double* lengths, std::size_t count, std::size_t room) {
    double total = 0, sum = 0;
    for (std::size_t i = 0; i < count; ++i) total += lengths[i];
    std::size_t last = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (lengths[i] > 0) last = i;
    for (std::size_t i = 0; i < room; ++i) {
        if (i < count) sum += lengths[i];
        out.push_back(i >= last ? 1.0f : float(sum / total));
    }
}

dev::RayFilterShape shape_of(const RenderSettings& s, const std::vector<Grid>& grids) {
    dev::RayFilterShape shape{};
    shape.cell[0] = s.ray_filter.cell_x, shape.cell[1] = s.ray_filter.cell_y;
    shape.taps[0] = s.ray_filter.bins_x, shape.taps[1] = s.ray_filter.bins_y;
    for (const Grid& grid : grids) {
        shape.width = std::max(shape.width, grid.width);
        shape.height = std::max(shape.height, grid.height);
    }
    shape.table = 2 + shape.height + 4 * shape.height * shape.width;
    return shape;
}

}  // namespace

dev::RayFilterShape ray_filter_shape(const RenderSettings& settings) {
    return shape_of(settings, grids_of(settings));
}

std::vector<float> ray_filter_tables(const RenderSettings& settings) {
    if (settings.ray_start != RayStart::filter) return {};
    const std::vector<Grid> grids = grids_of(settings);
    const dev::RayFilterShape shape = shape_of(settings, grids);
    std::vector<float> tables;
    for (const Grid& grid : grids) {
        // Density: the mean of |F| over the channels that share it, each normalised.
        std::vector<double> density(grid.filters.size()), rows(grid.height);
        std::array<double, 3> norms{};
        for (const auto& f : grid.filters)
            for (std::size_t c = 0; c < 3; ++c) norms[c] += std::abs(f[c]);
        for (const double norm : norms)
            if (!(norm > 0)) throw Error(Exit::usage, "The filter that rays start by is 0 everywhere.");
        for (std::size_t i = 0; i < density.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) density[i] += std::abs(grid.filters[i][c]) / norms[c] / 3.0;
            rows[i / grid.width] += density[i];
        }
        tables.push_back(float(grid.first_x));
        tables.push_back(float(grid.first_y));
        append_bounds(tables, rows.data(), grid.height, shape.height);
        for (unsigned v = 0; v < shape.height; ++v)
            append_bounds(tables, v < grid.height ? &density[std::size_t(v) * grid.width] : nullptr,
                          v < grid.height ? grid.width : 0, shape.width);
        for (unsigned v = 0; v < shape.height; ++v)
            for (unsigned u = 0; u < shape.width; ++u) {
                const bool inside = v < grid.height && u < grid.width;
                const std::size_t i = std::size_t(v) * grid.width + u;
                for (std::size_t c = 0; c < 3; ++c)
                    tables.push_back(inside && density[i] > 0 ? float(grid.filters[i][c] / density[i])
                                                              : 0.0f);
            }
    }
    return tables;
}

}  // namespace triad
