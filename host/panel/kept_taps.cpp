/// Taps that were designed before, in the user's cache: one file for each panel, density and design.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/whole_number.h"
#include "panel/design.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

using nlohmann::json;

json to_json(const Taps& t) {
    return {{"first_x", t.first_x}, {"first_y", t.first_y}, {"width", t.width}, {"height", t.height},
            {"weights", t.weights}, {"across", t.across},   {"down", t.down},   {"cross", t.cross}};
}

Taps taps_of(const json& t) {
    const auto values = [&](const char* key) { return t.at(key).get<std::vector<float>>(); };
    return {whole_number<int>(t.at("first_x")),
            whole_number<int>(t.at("first_y")),
            whole_number<unsigned>(t.at("width")),
            whole_number<unsigned>(t.at("height")),
            values("weights"),
            values("across"),
            values("down"),
            values("cross")};
}

json to_json(const TapTable& table) {
    json outputs = json::array();
    for (const Taps& taps : table.outputs) outputs.push_back(to_json(taps));
    return {{"bins_x", table.bins_x},
            {"bins_y", table.bins_y},
            {"cell_x", table.cell_x},
            {"cell_y", table.cell_y},
            {"outputs", outputs}};
}

TapTable table_of(const json& t) {
    const auto number = [&](const char* key) { return whole_number<unsigned>(t.at(key)); };
    TapTable table{number("bins_x"), number("bins_y"), number("cell_x"), number("cell_y"), {}};
    for (const json& taps : t.at("outputs")) table.outputs.push_back(taps_of(taps));
    return table;
}

/// To be raised when the designer answers otherwise: what is kept is out of date then, which
/// KeptTaps.are_what_the_designer_says finds out.
constexpr const char* schema = "triad.taps/3";

/// Bins: no design reaches nearly as far.
constexpr int farthest = 1024;

fs::path path_of(const Panel& panel, double ppd, const TapDesign& design) {
    const fs::path cache = cache_folder();
    if (cache.empty()) return {};
    Hash key;
    key.add(schema).add_value(panel.cell_x).add_value(panel.cell_y);
    // exactly: panels of one panel_id may differ by rounding, and so do their taps
    for (const Emitter& e : panel.emitters) {
        key.add_value(e.feed).add_value(e.pixel_x).add_value(e.pixel_y).add_value(e.luminance);
        for (const dvec2& v : {e.chromaticity, e.centre, dvec2(e.aperture.radius)})
            key.add_value(v.x).add_value(v.y);
        key.add_value(e.aperture.corners.size());
        for (const dvec2& v : e.aperture.corners) key.add_value(v.x).add_value(v.y);
    }
    key.add_value(ppd).add_value(design.bins_x).add_value(design.bins_y);
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
    const auto near = [](int first, unsigned count) {
        return std::abs(std::int64_t(first)) <= farthest && count <= unsigned(farthest);
    };
    return t.bins_x == design.bins_x && t.bins_y == design.bins_y && t.cell_x == panel.cell_x &&
           t.cell_y == panel.cell_y && t.outputs.size() == std::size_t(3) * t.cell_x * t.cell_y &&
           std::all_of(t.outputs.begin(), t.outputs.end(), [&](const Taps& taps) {
               const std::size_t size = std::size_t(taps.width) * taps.height;
               return near(taps.first_x, taps.width) && near(taps.first_y, taps.height) &&
                      !taps.weights.empty() && none_or(taps.weights, size) && none_or(taps.cross, 3 * size) &&
                      none_or(taps.across, taps.width) && none_or(taps.down, taps.height) &&
                      taps.across.empty() == taps.down.empty();
           });
}

}  // namespace

std::optional<TapTable> taps_of_json(std::string_view text, const Panel& panel, const TapDesign& design) {
    try {
        const auto table = table_of(json::parse(text));
        if (is_sound(table, panel, design)) return table;
    } catch (const json::exception&) {
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
        write_file(path, to_json(table).dump());
    } catch (const std::exception& error) {
        detail(std::string("The taps are not kept: ") + error.what());
    }
    return table;
}

}  // namespace triad
