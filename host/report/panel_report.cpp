#include "report/panel_report.h"

#include <algorithm>

#include "base/text.h"
#include "panel/aperture.h"
#include "panel/simulate.h"

namespace triad {
namespace {

const char* const channels[] = {"R", "G", "B", "W"};

std::string advice_words(const Panel& panel) {
    if (!panel.advice.full_pixel) return "subpixel";
    const dvec2 shift = panel.advice.shift;
    return shift == dvec2(0) ? "full pixel" : format("full pixel, moved by %g, %g px", shift.x, shift.y);
}

std::string weights_text(const std::vector<float>& weights, unsigned width) {
    std::string text;
    for (std::size_t i = 0; i < weights.size(); ++i)
        text += format(" %+.5f", double(weights[i])) + ((i + 1) % width ? "" : "\n");
    return text;
}

}  // namespace

std::string panel_line(const Panel& panel) {
    return format("%-17s %ux%u px, %2zu emitters  %-32s %s", panel.name.c_str(), panel.cell_x, panel.cell_y,
                  panel.emitters.size(), advice_words(panel).c_str(), panel.description.c_str());
}

std::string panel_text(const Panel& panel) {
    std::string text =
        panel.name + ": " + panel.description + "\n" + format("cell %u x %u px", panel.cell_x, panel.cell_y) +
        (panel.ppd ? format(", seen at %.4g pixels per degree", *panel.ppd) : std::string()) + "\n";
    for (const Emitter& e : panel.emitters)
        text += format(
            "  %-6s fed by %s of pixel (%u, %u)  centre (%.4f, %.4f) px  area %.4f px2  xy (%.4f, %.4f)  "
            "luminance %.4f\n",
            e.name.c_str(), channels[unsigned(e.feed)], e.pixel_x, e.pixel_y, e.centre.x, e.centre.y,
            aperture_area(e.aperture), e.chromaticity.x, e.chromaticity.y, e.luminance);
    return text + "advice: " + advice_words(panel) +
           (panel.advice.why.empty() ? "" : ". " + panel.advice.why) + "\n";
}

Json panel_row(const Panel& panel) {
    const auto pair = [](const dvec2& v) { return Json::array({v.x, v.y}); };
    Json emitters = Json::array();
    for (const Emitter& e : panel.emitters)
        emitters.push_back({{"name", e.name},
                            {"channel", channels[unsigned(e.feed)]},
                            {"pixel", {e.pixel_x, e.pixel_y}},
                            {"centre", pair(e.centre)},
                            {"area", aperture_area(e.aperture)},
                            {"primary", pair(e.chromaticity)},
                            {"luminance", e.luminance}});
    Json row = {{"name", panel.name},
                {"description", panel.description},
                {"cell", {panel.cell_x, panel.cell_y}},
                {"emitters", std::move(emitters)},
                {"advice", panel.advice.full_pixel ? "full-pixel" : "subpixel"}};
    if (panel.advice.full_pixel) row["shift"] = pair(panel.advice.shift);
    if (!panel.advice.why.empty()) row["why"] = panel.advice.why;
    if (panel.ppd) row["ppd"] = *panel.ppd;
    return row;
}

std::string taps_text(const TapTable& table) {
    std::string text = format("%u x %u bins per pixel\n", table.bins_x, table.bins_y);
    for (std::size_t i = 0; i < table.outputs.size(); ++i) {
        const Taps& taps = table.outputs[i];
        text += format("%s of pixel (%zu, %zu), first bin (%d, %d):\n", channels[i % 3], i / 3 % table.cell_x,
                       i / 3 / table.cell_x, taps.first_x, taps.first_y);
        if (!taps.across.empty())
            text += "  across" + weights_text(taps.across, taps.width) + "  down  " +
                    weights_text(taps.down, taps.height);
        else
            text += weights_text(taps.weights, taps.width);
        for (std::size_t j = 0; j < 3 && !taps.cross.empty(); ++j) {
            const auto begin = taps.cross.begin() + std::ptrdiff_t(j * taps.weights.size());
            if (j != i % 3)
                text += std::string("  and of ") + channels[j] + ":\n" +
                        weights_text({begin, begin + std::ptrdiff_t(taps.weights.size())}, taps.width);
        }
    }
    return text;
}

Json taps_json(const TapTable& table) {
    Json outputs = Json::array();
    for (std::size_t i = 0; i < table.outputs.size(); ++i) {
        const Taps& taps = table.outputs[i];
        Json output = {{"pixel", {i / 3 % table.cell_x, i / 3 / table.cell_x}},
                       {"channel", channels[i % 3]},
                       {"first", {taps.first_x, taps.first_y}},
                       {"size", {taps.width, taps.height}},
                       {"weights", taps.weights}};
        if (!taps.across.empty()) output["across"] = taps.across, output["down"] = taps.down;
        if (!taps.cross.empty()) output["cross"] = taps.cross;
        outputs.push_back(std::move(output));
    }
    return {
        {"bins", {table.bins_x, table.bins_y}}, {"cell", {table.cell_x, table.cell_y}}, {"outputs", outputs}};
}

namespace {

/// Some cells all lit by one colour.
RgbImage lit(const Panel& panel, unsigned cells, const vec3& colour, unsigned zoom) {
    RgbImage drives{cells * panel.cell_x, cells * panel.cell_y, {}};
    for (unsigned i = 0; i < drives.width * drives.height; ++i)
        for (int c = 0; c < 3; ++c) drives.rgb.push_back(colour[c]);
    return simulate_panel(panel, drives, zoom);
}

RgbImage scaled(RgbImage image, float most) {
    for (float& v : image.rgb) v = std::clamp(v / most, 0.0f, 1.0f);
    return image;
}

}  // namespace

RgbImage magnified(const Panel& panel, const RgbImage& drives, unsigned zoom) {
    const RgbImage white = lit(panel, 1, vec3(1), zoom);
    return scaled(simulate_panel(panel, drives, zoom), *std::max_element(white.rgb.begin(), white.rgb.end()));
}

RgbImage magnified(const Panel& panel, unsigned zoom) {
    // A white emitter takes the others' light: these are lit without it, one after the other.
    RgbImage image = lit(panel, 2, {1, 0, 0}, zoom);
    std::vector<vec3> colours = {{0, 1, 0}, {0, 0, 1}};
    for (const Emitter& e : panel.emitters)
        if (e.feed == Feed::white) colours = {{0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    for (const vec3& colour : colours) {
        const RgbImage more = lit(panel, 2, colour, zoom);
        for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] += more.rgb[i];
    }
    const float brightest = *std::max_element(image.rgb.begin(), image.rgb.end());
    return scaled(std::move(image), brightest);
}

}  // namespace triad
