#pragma once
/// Taps for a panel: the drives whose light, as the eye sees it, is nearest to the picture's
/// (docs/subpixel.md).
#include <optional>
#include <string_view>

#include "panel/eye.h"
#include "panel/panel.h"
#include "panel/taps.h"

namespace triad {

/// How taps are designed.
struct TapDesign {
    unsigned bins_x = 3, bins_y = 3;  ///< of the film, per pixel; 1 to 16
    bool cross_colour = false;        ///< nine filters instead of three: each output sees R, G and B
    /// px: bins count whose centre is at most this, and the spacing of the outputs of its colour (1 where
    /// every pixel has one), from the emitter along x and along y; 0.5 less does for drives that are merely
    /// cut to [0, 1]
    double reach = 1.5;
    bool separable = false;  ///< three filters as products of their sums over columns and rows
    EyeShares eyes = {};
    double pull = 3e-4;  ///< lambda: towards the box where the eyes see hardly anything; it keeps noise low
};

/// The taps that minimise the expected perceived error, each with its exact sum of 1. The full pixel's box
/// where the panel's advice asks for that, and for channels that feed no emitter in their pixel. Throws
/// Error(usage) for ppd outside of [5, 1000] or bins that are too many.
TapTable design_taps(const Panel& panel, double ppd, const TapDesign& design = {});

/// The same, from the user's cache where they were designed before (cache_folder()).
TapTable kept_taps(const Panel& panel, double ppd, const TapDesign& design = {});

/// Taps as the cache keeps them; nothing where the text is damaged, or is of another panel or design.
std::optional<TapTable> taps_of_json(std::string_view text, const Panel& panel, const TapDesign& design);

/// Throws Error(usage) for ppd outside of [5, 1000] or bins outside of 1 to 16.
void check_design(double ppd, unsigned bins_x, unsigned bins_y);

/// The box of one pixel around the light of each output: the best taps that are nowhere negative, nearly.
TapTable displaced_box_taps(const Panel& panel, unsigned bins_x = 3, unsigned bins_y = 3);

/// The box of the pixel, moved by `shift` px.
TapTable full_pixel_taps(unsigned bins_x, unsigned bins_y, const dvec2& shift = dvec2(0));

/// The optimal filters as Platt published them ("Optimal Filtering for Patterned Displays", IEEE Signal
/// Processing Letters 7(7), 2000): along the stripes' direction alone, on one sample per subpixel, by the
/// error that S-CIELAB sees; nine filters of 15 taps, or only the three of their own colour. Without what
/// design_taps adds (apertures, the pictures' spectrum, a pull to the box), but with sums of 1. Throws
/// Error(usage) for a panel that is not one of three even stripes.
TapTable platt_taps(const Panel& panel, double ppd, bool nine);

/// The published design: the eye of S-CIELAB alone, and taps within 1.5 px where every pixel has all colours.
/// Best where drives are merely cut to [0, 1], and where rays are drawn from the taps.
inline constexpr TapDesign published_design = {.reach = 0.5, .eyes = {1, 0, 0}, .pull = 1e-3};

/// What the bounded refinement needs. Only 0 where the advice is the full pixel.
RefineStencil design_refine(const Panel& panel, double ppd, const EyeShares& eyes = {});

}  // namespace triad
