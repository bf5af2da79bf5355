#include <algorithm>

#include "panel/panel.h"

namespace triad {
namespace {

/// sRGB's primaries (IEC 61966-2-1) and their shares of white, which is D65.
constexpr dvec2 primaries[] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
constexpr double luminances[] = {0.212639, 0.715169, 0.072192};
const char* const colour_names[] = {"R", "G", "B", "W"};

Aperture rectangle(double width, double height) {
    const double x = width / 2, y = height / 2;
    return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
}

Aperture diamond(double radius) { return {{{0, -radius}, {radius, 0}, {0, radius}, {-radius, 0}}}; }

Emitter emitter(Feed feed, dvec2 centre, Aperture aperture, unsigned x = 0, unsigned y = 0,
                double share = 1) {
    const unsigned c = unsigned(feed);
    return {colour_names[c], primaries[c], share * luminances[c], centre, std::move(aperture), x, y, feed};
}

Panel stripes(const char* name, const char* description, double width, double height) {
    Panel panel{.name = name, .description = description};
    for (unsigned c = 0; c < 3; ++c)
        panel.emitters.push_back(emitter(Feed(c), {(2 * c + 1) / 6.0, 0.5}, rectangle(width, height)));
    return panel;
}

/// Another built-in panel that is this one turned; it counts as described that way.
Panel renamed(Panel panel, const char* name, const char* description) {
    panel.name = name, panel.description = description;
    panel.quarter_turns = 0, panel.flipped = false;
    return panel;
}

/// Green on top, red and blue below (subpixel layouts of QD-OLED monitors of 2022 to 2024; sizes by eye).
Panel qd_oled() {
    Panel panel{.name = "qd-oled", .description = "QD-OLED triangle: green above red and blue"};
    panel.emitters = {emitter(Feed::red, {0.25, 0.75}, rectangle(0.40, 0.40)),
                      emitter(Feed::green, {0.50, 0.25}, rectangle(0.70, 0.34)),
                      emitter(Feed::blue, {0.75, 0.75}, rectangle(0.40, 0.40))};
    return panel;
}

/// A green diamond in every pixel, a red or a blue one in every second, as on a chessboard.
Panel pentile() {
    Panel panel{.name = "pentile", .description = "PenTile RGBG diamonds", .cell_x = 2, .cell_y = 2};
    for (unsigned y = 0; y < 2; ++y)
        for (unsigned x = 0; x < 2; ++x) {
            panel.emitters.push_back(
                emitter(Feed::green, {x + 0.25, y + 0.25}, diamond(0.25), x, y, 1.0 / 4));
            panel.emitters.push_back(
                emitter(x == y ? Feed::red : Feed::blue, {x + 0.75, y + 0.75}, diamond(0.38), x, y, 1.0 / 2));
        }
    return panel;
}

/// The white emitter shows the least of R, G and B, so that no drive value moves it alone.
Panel woled() {
    Panel panel{.name = "woled", .description = "WOLED: red, white, blue and green stripes"};
    panel.advice = {
        true,
        {-0.125, 0},
        "The white emitter has no drive of its own: taps for the coloured ones would harm. The full "
        "pixel, centred on white, is best."};
    const Feed order[] = {Feed::red, Feed::white, Feed::blue, Feed::green};
    for (unsigned i = 0; i < 4; ++i) {
        const unsigned c = unsigned(order[i]);
        panel.emitters.push_back({colour_names[c],
                                  primaries[c],
                                  c == 3 ? 1.0 : luminances[c],
                                  {(2 * i + 1) / 8.0, 0.5},
                                  rectangle(0.25, 1),
                                  0,
                                  0,
                                  order[i]});
    }
    return panel;
}

Panel off() {
    Panel panel{.name = "off", .description = "no known emitters: whole pixels"};
    panel.advice = {true, {0, 0}, "Pictures for any display: every channel is the mean of its pixel."};
    for (unsigned c = 0; c < 3; ++c) panel.emitters.push_back(emitter(Feed(c), {0.5, 0.5}, rectangle(1, 1)));
    return panel;
}

std::vector<Panel> make() {
    const Panel rgb = stripes("rgb", "RGB stripes from left to right: most LCD", 1.0 / 3, 1);
    return {
        rgb,
        renamed(mirrored(rgb), "bgr", "BGR stripes from left to right: an RGB display upside down"),
        renamed(turned(rgb, 1), "vrgb", "RGB stripes from top to bottom: an RGB display turned clockwise"),
        renamed(turned(rgb, 3), "vbgr",
                "BGR stripes from top to bottom: an RGB display turned anticlockwise"),
        stripes("rgb-black-matrix", "RGB stripes with a black matrix: 60 % of the area is lit", 0.25, 0.8),
        qd_oled(),
        pentile(),
        woled(),
        off()};
}

}  // namespace

const std::vector<Panel>& builtin_panels() {
    static const std::vector<Panel> panels = make();
    return panels;
}

std::optional<Panel> builtin_panel(const std::string& name) {
    const auto at = std::min(name.find('@'), name.size());
    const auto& all = builtin_panels();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Panel& p) {
        return p.name == std::string_view(name).substr(0, at);
    });
    if (found == all.end()) return {};
    Panel panel = *found;
    for (std::string_view rest = std::string_view(name).substr(at); !rest.empty();) {
        const auto end = std::min(rest.find('@', 1), rest.size());
        const std::string_view change = rest.substr(1, end - 1);
        if (change == "90" || change == "180" || change == "270")
            panel = turned(panel, change == "90" ? 1 : change == "180" ? 2 : 3);
        else if (change == "flip")
            panel = mirrored(panel);
        else
            return {};
        rest.remove_prefix(end);
    }
    panel.name = name;
    return panel;
}

}  // namespace triad
