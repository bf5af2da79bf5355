/// Taps that were designed before, in the user's cache: one file for each panel, density and design.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "panel/design.h"

namespace fs = std::filesystem;

namespace triad {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Taps, first_x, first_y, width, height, weights, across, down, cross)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TapTable, bins_x, bins_y, cell_x, cell_y, outputs)

namespace {

/// To be raised when the designer answers otherwise: what is kept is out of date then, which
/// KeptTaps.are_what_the_designer_says finds out.
constexpr const char* schema = "triad.taps/3";

fs::path path_of(const Panel& panel, double ppd, const TapDesign& design) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return {};
    Hash key;
    key.add(schema).add(panel_id(panel)).add_value(ppd).add_value(design.bins_x).add_value(design.bins_y);
    key.add_value(design.cross_colour).add_value(design.reach).add_value(design.separable);
    key.add_value(design.eyes.scielab).add_value(design.eyes.sharp).add_value(design.eyes.flip);
    key.add_value(design.pull);
    return cache / "taps" / (key.hex() + ".json");
}

bool is_sound(const TapTable& t, const Panel& panel, const TapDesign& design) {
    const auto none_or = [](const std::vector<float>& values, std::size_t size) {
        return (values.empty() || values.size() == size) &&
               std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
    };
    return t.bins_x == design.bins_x && t.bins_y == design.bins_y && t.cell_x == panel.cell_x &&
           t.cell_y == panel.cell_y && t.outputs.size() == std::size_t(3) * t.cell_x * t.cell_y &&
           std::all_of(t.outputs.begin(), t.outputs.end(), [&](const Taps& taps) {
               const std::size_t size = std::size_t(taps.width) * taps.height;
               return !taps.weights.empty() && none_or(taps.weights, size) && none_or(taps.cross, 3 * size) &&
                      none_or(taps.across, taps.width) && none_or(taps.down, taps.height) &&
                      taps.across.empty() == taps.down.empty();
           });
}

}  // namespace

std::optional<TapTable> taps_of_json(std::string_view text, const Panel& panel, const TapDesign& design) {
    try {
        const auto table = nlohmann::json::parse(text).get<TapTable>();
        if (is_sound(table, panel, design)) return table;
    } catch (const nlohmann::json::exception&) {
    }
    return {};
}

TapTable kept_taps(const Panel& panel, double ppd, const TapDesign& design) {
    if (panel.advice.full_pixel) return design_taps(panel, ppd, design);
    const fs::path path = path_of(panel, ppd, design);
    if (std::ifstream file(path); !path.empty() && file) {
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        if (const auto kept = taps_of_json(text, panel, design)) return *kept;  // else designed again
    }
    const TapTable table = design_taps(panel, ppd, design);
    if (path.empty()) return table;
    try {
        fs::create_directories(path.parent_path());
        write_file(path, nlohmann::json(table).dump());
    } catch (const std::exception& error) {
        detail(std::string("The taps are not kept: ") + error.what());
    }
    return table;
}

}  // namespace triad
