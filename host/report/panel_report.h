#pragma once
/// Panels, taps and stencils as text, as JSON rows and as pictures.
#include "base/rgb_image.h"
#include "panel/panel.h"
#include "panel/taps.h"
#include "report/report.h"

namespace triad {

/// One line: name, cell, emitters, advice.
std::string panel_line(const Panel& panel);
/// The emitters, one a line, and the advice.
std::string panel_text(const Panel& panel);
/// name, description, cell, emitters, advice.
Json panel_row(const Panel& panel);

/// Each output's weights, row by row; products of two rows as these.
std::string taps_text(const TapTable& table);
Json taps_json(const TapTable& table);

/// What a magnifier shows: the panel's emitters, `zoom` samples per pixel, lit by the drives
/// (display-linear); the brightest emitter of a white picture is 1.
RgbImage magnified(const Panel& panel, const RgbImage& drives, unsigned zoom);
/// Two by two cells with every emitter lit, a white one too, alike.
RgbImage magnified(const Panel& panel, unsigned zoom);

}  // namespace triad
