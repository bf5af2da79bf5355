#pragma once
/// The methods of reconstruction as data: where rays start in a bin, when tones are mapped, which taps.
#include <optional>
#include <string>
#include <vector>

#include "display/resolve.h"
#include "pack/settings.h"
#include "panel/design.h"
#include "panel/pixel_filter.h"

namespace triad {

/// A display that output is made for, seen from somewhere.
struct PanelView {
    Panel panel;
    double ppd = 45;  ///< pixels per degree
};

struct ReconstructionChoice {
    /// One of reconstruction_names(), with :N where the method takes one. Empty: `triad` with a panel,
    /// `filter` with a filter, else the box over the bins.
    std::string method;
    std::optional<PixelFilter> filter;
    std::optional<uvec2> bins;  ///< per pixel; none: what the method has
    std::optional<PanelView> panel;
    unsigned refine_steps = 5;
};

/// One method, ready to render and to resolve.
struct Reconstruction {
    std::string method;  ///< empty: nothing was chosen
    std::string filter;  ///< in words, for metadata; empty: the box over the bins
    unsigned bins_x = 1, bins_y = 1;
    RayStart ray_start = RayStart::jitter;
    TapTable ray_filter;  ///< for RayStart::filter
    ToneOrder order = ToneOrder::per_bin;
    std::optional<TapTable> taps;  ///< none: the box over the bins
    std::optional<RefineStencil> refine;
    unsigned refine_steps = 5;
    std::optional<PanelView> panel;  ///< that the drives are for; no other display shows them right

    /// Whether the result is light that a display shows, and no radiance.
    bool display_linear() const {
        return panel.has_value() || (!method.empty() && order != ToneOrder::per_pixel);
    }
};

/// A method and a sentence about it.
struct MethodWords {
    std::string name, words;
    bool needs_panel = false;
};
/// All of them, for help and for comparisons: centre, ssaa:N, pane:N, pane-encoded:N, filter, subpixel3,
/// displaced, platt, platt:3, random3, random3:shared, triad.
const std::vector<MethodWords>& reconstruction_methods();

/// The one that a text like "pane:4" names. Throws Error(usage).
const MethodWords& method_named(const std::string& method);

/// Throws Error(usage) for a method that there is none of, that lacks its panel or its filter, or whose bins
/// are others.
Reconstruction reconstruction_of(const ReconstructionChoice& choice);

/// The part of a film's or an image's way to pixels that the method decides.
void apply(const Reconstruction& method, DisplaySettings& settings);
void apply(const Reconstruction& method, RenderSettings& settings);

/// Samples per pixel, rounded up so that every bin has as many.
std::uint64_t whole_bins(std::uint64_t samples, unsigned bins);

}  // namespace triad
