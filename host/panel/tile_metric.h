#pragma once
/// Perceived errors of many pictures against one reference, by several eyes at once.
#include <array>
#include <complex>

#include "panel/eye.h"
#include "panel/fourier.h"
#include "panel/subpixel_score.h"

namespace triad {

inline constexpr std::array all_eyes = {Eye::scielab, Eye::sharp, Eye::flip};

/// The squared errors of tile_errors(PerceivedMetric::of(), perceived_border()), fifteen times faster (96 x
/// 64 px, CPU time): what a panel shows is put together from the transforms of its drives and of its
/// emitters, eyes share it, and the map of the error has only as many samples as an eye can tell apart, so
/// that errors differ by less than .5 %.
class TileMetric {
  public:
    /// `reference`: display-linear, `samples` x `samples` per pixel. Throws Error(usage) where the cells of
    /// the panel do not fill the picture, or where it is smaller than least_perceived_size().
    TileMetric(const Panel& panel, double ppd, const RgbImage& reference, unsigned samples);

    /// Of drives as shown, display-linear, for each of all_eyes.
    std::array<TileErrors, all_eyes.size()> of(const RgbImage& drives) const;

    unsigned map_samples() const { return map_samples_; }  ///< of the error, per pixel along each axis

  private:
    using Complex = std::complex<double>;
    using Axes = std::array<Complex, 3>;  ///< lightness, red-green, blue-yellow
    using Spectrum = std::vector<Axes>;
    /// Emitters that one drive feeds: a channel of a pixel of the cell, or the least of the three.
    struct Drive {
        unsigned x, y, channel;
    };

    std::vector<double> levels(const RgbImage& framed, const Drive& drive) const;
    std::array<std::vector<Complex>, 3> transform(const RgbImage& picture) const;
    Spectrum seen(const std::array<std::vector<Complex>, 3>& rgb, Eye eye) const;

    Panel panel_;
    double ppd_;
    unsigned width_, height_, samples_, map_samples_;  ///< px; per pixel
    unsigned frame_x_, frame_y_;                       ///< px
    bool has_white_ = false;
    Fourier lattice_, map_;  ///< of drives, a value for each cell; of the error
    std::vector<Drive> drives_;
    std::array<std::vector<Spectrum>, all_eyes.size()> light_;  ///< of one cell, by drive
    std::array<Spectrum, all_eyes.size()> wanted_;
    RgbImage around_;  ///< drives of the frame
};

}  // namespace triad
