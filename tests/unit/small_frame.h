#pragma once
#include "viewer/exchange.h"

namespace triad {

/// White, 4 x 2.
inline ViewFrame small_frame() {
    ViewFrame frame;
    frame.full_width = frame.width = frame.columns = 4, frame.full_height = frame.height = frame.rows = 2;
    frame.rgba.assign(32, 255);
    return frame;
}

}  // namespace triad
