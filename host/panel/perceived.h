#pragma once
/// How far what a display shows is from the picture it should show, as the eye sees both.
#include <memory>
#include <optional>

#include "base/rgb_image.h"
#include "panel/eye.h"
#include "panel/panel.h"

namespace triad {

struct PerceivedChoice {
    double ppd = 45;  ///< pixels per degree
    Eye eye = Eye::scielab;
    /// px on each side that no number counts; none: perceived_border(). The map has them all.
    std::optional<unsigned> border = {};
    bool repeats = false;  ///< beyond its border the picture begins anew, instead of going on as in a mirror
};

/// Px along each side of a picture where taps, refinement or eye see what lies beyond it: 4 px, and as far as
/// the eyes' sharp Gaussians reach. (Their wide ones see beyond from everywhere; there the display shows the
/// reference, mirrored, with a box around each emitter, which is right on average.)
unsigned perceived_border(double ppd);
/// The least width and height of a picture that is compared: 8 px within these borders.
unsigned least_perceived_size(double ppd);

/// In units of about one CIELAB unit at mid grey.
struct PerceivedError {
    double error = 0;                ///< sqrt(lightness^2 + colour^2)
    double lightness = 0;            ///< root mean square
    double colour = 0;               ///< root mean square of both colour axes together: fringes
    double de_mean = 0, de_p95 = 0;  ///< CIELAB's colour difference after the eye's blur
    RgbImage map;  ///< per sample: shown less wanted along lightness, red-green, blue-yellow
};

/// A picture to be shown, as the eye sees it; what displays show is measured against it.
class PerceivedMetric {
  public:
    /// `reference`: display-linear, `samples` x `samples` per pixel of the display, at least 3. Throws
    /// Error(comparison) for another size, one that is not a whole number of pixels, or one with less than 8
    /// px within its borders, where the choice names none.
    PerceivedMetric(const Panel& panel, const RgbImage& reference, unsigned samples,
                    const PerceivedChoice& choice = {});
    PerceivedMetric(PerceivedMetric&&) noexcept;
    ~PerceivedMetric();

    /// `drives`: as shown, display-linear; cut to [0, 1]. Throws Error(comparison) for another size.
    PerceivedError of(const RgbImage& drives) const;

    struct State;  ///< of the implementation

  private:
    std::unique_ptr<const State> state_;
};

/// What the eye sees of `difference` (W x H, display-linear, one value per pixel), added to the drives of a
/// panel: the root mean square in the units of PerceivedError::error. Patterns within a pixel do not count,
/// so that this is for what is slower than pixels: the noise that pixels have.
double perceived_difference(const Panel& panel, const RgbImage& difference,
                            const PerceivedChoice& choice = {});

/// The same, squared, pixel by pixel.
std::vector<float> perceived_difference_map(const Panel& panel, const RgbImage& difference,
                                            const PerceivedChoice& choice = {});

/// Samples per pixel of a reference to a picture of drives: a whole number, the same along both axes. Throws
/// Error(comparison) otherwise.
unsigned samples_per_pixel(const RgbImage& drives, const RgbImage& reference);

}  // namespace triad
