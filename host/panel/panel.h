#pragma once
/// Displays as data: where the emitters of a pixel lie, what light they give, and which drive value feeds
/// each.
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"

namespace triad {

/// The part of the drives that feeds an emitter.
enum class Feed : unsigned { red, green, blue, white };  ///< white: the least of the three, which they lose

/// The lit area: a polygon or a disc, around the emitter's centre.
struct Aperture {
    std::vector<dvec2> corners;  ///< in order, at least three; px, x to the right, y down. Empty: a disc
    double radius = 0;           ///< of the disc, px
};

struct Emitter {
    std::string name;
    dvec2 chromaticity{0};  ///< CIE 1931 x and y
    double luminance = 0;   ///< at full drive, as a share of the cell's; any unit
    dvec2 centre{0};        ///< px from the top left corner of the cell
    Aperture aperture;
    unsigned pixel_x = 0, pixel_y = 0;  ///< of the cell: the pixel whose drive feeds it
    Feed feed = Feed::red;
};

/// What to do on a panel: its optimal taps, or the full pixel because reconstruction for its emitters would
/// harm.
struct PanelAdvice {
    bool full_pixel = false;
    dvec2 shift{0};   ///< of the full pixel's box, px
    std::string why;  ///< a sentence
};

/// Pixels per degree where nobody says: 27 inches, 2560 x 1440 pixels, from .6 m.
inline constexpr double usual_ppd = 45;

/// The cell tiles the screen from its top left corner.
struct Panel {
    std::string name;
    std::string description;          ///< a sentence
    unsigned cell_x = 1, cell_y = 1;  ///< pixels
    std::vector<Emitter> emitters;    ///< as they lie on the screen: turned and mirrored already
    unsigned quarter_turns = 0;       ///< clockwise, that were made of the panel as described
    bool flipped = false;             ///< left to right, before the turns
    std::optional<double> ppd;        ///< pixels per degree that the panel is usually seen at
    PanelAdvice advice;
};

/// rgb, bgr, vrgb, vbgr, rgb-black-matrix, qd-oled, pentile, woled, off.
const std::vector<Panel>& builtin_panels();

/// A built-in panel by its name, followed by any of "@90", "@180", "@270" (turned clockwise) and "@flip"
/// (mirrored left to right), made in that order: "qd-oled@180". Nothing when there is no such panel.
std::optional<Panel> builtin_panel(const std::string& name);

/// Names what the panel does with its drives, whatever it is called: cell, feeds, light and places of the
/// emitters as they lie on the screen, to a millionth of a pixel. Eight digits.
std::string panel_id(const Panel& panel);

/// The screen turned clockwise, a quarter at a time.
Panel turned(const Panel& panel, unsigned quarter_turns);
/// The screen mirrored left to right.
Panel mirrored(const Panel& panel);

/// Throws Error(scene) that names the member at fault: cells, emitters, areas and lights that make no panel,
/// or a channel that feeds no emitter at all.
void check_panel(const Panel& panel);

/// CIE XYZ of an emitter at full drive as what it adds to the mean of the cell, white having Y = 1.
std::vector<dvec3> emitter_light(const Panel& panel);
/// CIE XYZ of R, G and B, and their sum, the panel's white.
struct PanelLight {
    dvec3 channel[3];
    dvec3 white;
};
PanelLight panel_light(const Panel& panel);

/// Drive values of one cell: the output (cell row, cell column, channel) of TapTable. Emitters with the same
/// drive are one output.
struct Output {
    unsigned x = 0, y = 0, channel = 0;  ///< pixel of the cell, and 0 to 2 for R, G, B
    std::vector<unsigned> emitters;      ///< that it feeds; empty: none
    dvec2 centre{0};  ///< of their light, px from the cell's corner; of the pixel when none
};
/// [cell row][cell column][R, G, B], as in TapTable. White emitters belong to no output.
std::vector<Output> panel_outputs(const Panel& panel);

/// Pixels per degree of a screen `distance` away whose pixels are `pitch` apart, both in the same unit:
/// pixels in one degree of the visual field around the line of sight.
double pixels_per_degree(double distance, double pitch);

}  // namespace triad
