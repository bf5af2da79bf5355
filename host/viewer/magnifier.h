#pragma once
/// What a magnifier shows of a picture: pixels, or the emitters of the panel that it is shown on.
#include "viewer/exchange.h"

namespace triad {

/// `across` pixels around (x, y) of the whole picture, which the frame covers, `zoom` times magnified; at the
/// borders the picture ends. The brightest emitter of a white picture is white.
ViewFrame magnified(const ViewFrame& frame, unsigned x, unsigned y, unsigned across, unsigned zoom);

}  // namespace triad
