#pragma once
/// Tap tables as the kernels of kernels/subpixel/drives.cl take them: weighted sums of shifted rows of planes
/// (the layout of planes is that of DisplaySlab, kernels/types.h).
#include <cstdint>
#include <vector>

#include "panel/taps.h"

namespace triad {

/// Sums for every output plane, for every phase of rows: [phase][plane][tap].
struct PlaneSums {
    unsigned taps = 0, planes = 0, phases = 1;
    std::vector<std::int32_t> offsets;  ///< in floats, from the output's own place
    std::vector<float> weights;
};

/// Rows and planes of a buffer.
struct PlaneShape {
    std::size_t stride = 0, plane = 0;  ///< floats of a row; of a plane
};

/// A tap table, with a box for alpha where that is wanted, and how far it reaches.
class TapPlan {
  public:
    /// Throws Error(usage) for a table that is not whole: outputs or weights missing, or more than 2^16 taps.
    TapPlan(const TapTable& table, bool alpha);

    unsigned bins_x() const { return table_.bins_x; }
    unsigned bins_y() const { return table_.bins_y; }
    unsigned cell_x() const { return table_.cell_x; }
    unsigned channels() const { return channels_; }
    unsigned columns() const { return table_.cell_x * table_.bins_x; }  ///< of bins, in a cell
    unsigned left() const { return left_; }                             ///< cells before the output's own
    unsigned right() const { return right_; }
    unsigned up() const { return up_; }  ///< rows of pixels above the output's own
    unsigned down() const { return down_; }
    /// Two passes, along columns and then along rows; else one.
    bool separable() const { return separable_; }

    /// Along columns: for every column of bins, from planes of bins to planes [channel][pixel of the
    /// cell][column].
    PlaneSums down_sums(const PlaneShape& bins) const;
    /// Along rows: from these to drives [channel][pixel of the cell].
    PlaneSums across_sums(const PlaneShape& sums) const;
    /// Both at once.
    PlaneSums sums(const PlaneShape& bins) const;

  private:
    TapTable table_;  ///< outputs: [cell row][cell column][channel], channels_ of them
    unsigned channels_;
    unsigned left_ = 0, right_ = 0, up_ = 0, down_ = 0;
    bool separable_ = true;

    /// Calls visit(channel, plane, first column of bins, taps, add) for every output; add(offset, weight)
    /// gives it a tap.
    template <class Visit>
    PlaneSums collect(Visit&& visit) const;
    /// Offset of column `at`, counted from the output's own cell, among the columns of the first_plane-th
    /// channel.
    std::int64_t column_at(std::int64_t first_plane, int at, const PlaneShape& shape) const;

    const Taps& of(unsigned phase, unsigned x, unsigned channel) const {
        return table_.outputs[(phase * table_.cell_x + x) * channels_ + channel];
    }
};

/// A refinement's stencil over planes of drives [channel][pixel of the cell].
PlaneSums refine_sums(const RefineStencil& stencil, const PlaneShape& drives);

/// The box over the bins of a pixel.
TapTable box_taps(unsigned bins_x, unsigned bins_y);

}  // namespace triad
