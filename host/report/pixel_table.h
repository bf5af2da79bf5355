#pragma once
/// triad render --pixel: everything about one pixel, as a table and as JSON.
#include "render/pixel_report.h"
#include "report/report.h"
#include "scene/scene.h"

namespace triad {

/// The JSON row; `x` and `y` are those of the full picture, `names` PackedScene::light_sources.
Json to_json(const PixelReport& report, const Scene& scene, const std::vector<std::string>& names, unsigned x,
             unsigned y);

/// The table, as several lines.
std::string table_text(const PixelReport& report, const Scene& scene, const std::vector<std::string>& names,
                       unsigned x, unsigned y);

}  // namespace triad
