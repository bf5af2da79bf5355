#pragma once
/// What turns bins into drives: tap tables, and the stencil of the bounded refinement. Plain data that the
/// designer (panel/design.h) and the pixel filters (panel/pixel_filter.h) make and the resolve kernels read.
#include <cstdint>
#include <vector>

namespace triad {

/// One output channel of one pixel as a weighted sum of bins around it.
struct Taps {
    int first_x = 0, first_y = 0;  ///< bin of weight [0][0], from the top-left bin of the pixel
    unsigned width = 1, height = 1;
    /// [row][column] for the output's own input channel. Sums to 1.
    std::vector<float> weights;
    /// When weights is their outer product: [column] and [row], each with sum 1. Else both are empty.
    std::vector<float> across, down;
    /// What the other input channels add: [input R, G, B][row][column], the own one all 0, each with sum 0.
    /// Empty: own colour only.
    std::vector<float> cross;
};

/// Taps of every output of a cell of pixels, which tiles the picture from its top left corner.
struct TapTable {
    unsigned bins_x = 1, bins_y = 1;  ///< bins per pixel
    unsigned cell_x = 1, cell_y = 1;  ///< pixels per cell
    std::vector<Taps> outputs;        ///< [cell row][cell column][R, G, B]

    const Taps& of(unsigned x, unsigned y, unsigned channel) const {
        return outputs[((y % cell_y) * cell_x + x % cell_x) * 3 + channel];
    }
};

/// What the bounded refinement needs of the quadratic form A of the perceived error in the drives: the low
/// pass A (A + rho I)^-1, cut to a finite stencil (docs/subpixel.md). Rows and columns of channels that feed
/// no emitter are 0.
struct RefineStencil {
    unsigned cell_x = 1, cell_y = 1;  ///< pixels per cell
    unsigned radius = 0;              ///< pixels
    /// [cell row][cell column][output channel][dy + radius][dx + radius][input channel]; the input is the
    /// pixel dx to the right of the output's and dy below
    std::vector<float> weights;
};

}  // namespace triad
