#pragma once
/// What the page asks for.
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/math.h"

namespace triad {

/// Members that are there are to change; the others stay.
struct ViewChange {
    std::optional<dvec2> orbit;                     ///< radians: azimuth, elevation
    std::optional<dvec2> pan;                       ///< heights of the picture, to the right and upwards
    std::optional<double> zoom;                     ///< factor of the distance
    std::optional<int> camera;                      ///< of the scene, by index; -1: as the render began
    std::optional<double> scale;                    ///< of the picture's width and height, up to 1
    std::optional<std::string> variant;             ///< empty: the file's own materials
    std::optional<std::string> panel;               ///< empty: none
    std::optional<bool> subpixels;                  ///< reconstruct for the panel's emitters
    std::optional<std::array<unsigned, 4>> region;  ///< x, y, width, height in pixels; width 0: the whole
    std::optional<bool> paused;
    std::optional<double> exposure;  ///< EV
    std::optional<std::string> tone_map;
};

/// How soon a change stops what is rendered.
enum class Urgency {
    none,
    display,  ///< not at all: the same samples are shown otherwise
    pause,    ///< it stops, and may go on later
    picture   ///< its samples are of another picture
};
Urgency urgency_of(const ViewChange& change);

/// From a JSON object with members of these names (tone_map is "tonemap"). Throws Error(usage) with a
/// sentence for a text that is no such object, a member that there is none of, and values that are no finite
/// numbers or beyond their limits. Whether a name is one of the scene's is not known here.
ViewChange parse_change(std::string_view json);

}  // namespace triad
