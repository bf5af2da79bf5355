#pragma once
/// What resolve_display (render/resolve.h) does: bins -> exposure, tone map -> taps -> refinement -> drives,
/// some rows at a time.
#include <functional>

#include "display/resolve.h"
#include "display/tap_plan.h"
#include "kernels/types.h"

namespace triad {

/// Where the bins come from.
struct BinSource {
    unsigned width, height, columns, rows, bins_x, bins_y;
    bool encoded;
    float unit;             ///< of a film's sums
    bool rows_of_pixels;    ///< its buffers hold rows of pixels, else of bins
    std::size_t row_bytes;  ///< of these
    const char* kernel;     ///< of subpixel/bins.cl
    /// Uploads rows [first, first + count).
    std::function<Arguments(Device&, std::size_t first, std::size_t count)> upload;
    /// Of a film whose bins may be noisy: uploads what its halves say of these rows, for weigh_noise.
    std::function<Arguments(Device&, std::size_t first, std::size_t count)> halves = {};
};

class DisplayPipeline {
  public:
    /// Throws Error(usage) for taps or a refinement that do not fit the bins.
    DisplayPipeline(Device& device, const BinSource& source, const DisplaySettings& settings);

    /// Display-linear RGBA per pixel.
    std::vector<float> run();

  private:
    /// Rows of the picture, half-open.
    struct Rows {
        std::size_t begin = 0, end = 0;
        std::size_t count() const { return end - begin; }
    };

    Device& device_;
    const BinSource& source_;
    const DisplaySettings& settings_;
    const TapPlan plan_;
    const DisplayShape shape_;
    std::size_t most_ = std::size_t(2) << 30;
    unsigned refine_steps_ = 0;
    std::size_t cells_ = 0, pad_ = 0, pad_cells_ = 0;
    PlaneShape bins_, drives_;
    Buffer slab_, planes_, means_, sums_;  ///< of the bins; kept while they are large enough

    unsigned runs() const;
    std::uint32_t row_groups(std::size_t rows, const PlaneSums& sums) const;
    Options options(unsigned taps) const;
    std::size_t rows_that_fit(std::size_t bytes, std::size_t row_bytes, std::size_t margins) const;
    void reserve(Buffer& buffer, std::size_t bytes);
    void drive_rows(const Rows& wanted, const Rows& made, float* display);
    std::uint32_t first_of(std::size_t row, const Rows& made) const;
    dev::DisplaySlab slab_of(const Rows& rows, std::size_t source_row) const;
    void write_slab(const dev::DisplaySlab& slab);
    Rows source_rows(const Rows& rows) const;
    std::ptrdiff_t rows_around() const;
    void map_rows(const Rows& rows);
    void tap_rows(const Rows& rows, const Rows& made, const Buffer& drives);
    Buffer refine(const Buffer& asked, const Rows& made, std::size_t bytes);
    void gather(const Buffer& drives, const Rows& wanted, const Rows& made, float* display);
};

}  // namespace triad
