#include "panel/panel.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "base/text.h"
#include "panel/aperture.h"

namespace triad {
namespace {

constexpr unsigned cell_cap = 8, emitter_cap = 256, corner_cap = 256;

/// CIE XYZ of luminance Y.
dvec3 xyz_of(const dvec2& chromaticity, double y) {
    return {y * chromaticity.x / chromaticity.y, y,
            y * (1 - chromaticity.x - chromaticity.y) / chromaticity.y};
}

void add_change(Panel& panel, unsigned quarter_turns, bool mirror) {
    // A mirror before the turns: mirror(turn(p)) = turn back(mirror(p)).
    if (mirror) panel.flipped = !panel.flipped, panel.quarter_turns = (4 - panel.quarter_turns) % 4;
    panel.quarter_turns = (panel.quarter_turns + quarter_turns) % 4;
}

[[noreturn]] void fail(const Panel& panel, const std::string& what) {
    throw Error(Exit::scene, "The panel " + panel.name + ": " + what);
}

void check_emitter(const Panel& panel, std::size_t index) {
    const Emitter& e = panel.emitters[index];
    const auto bad = [&](const std::string& what) {
        fail(panel,
             format("emitters[%zu]%s: ", index, e.name.empty() ? "" : (" (" + e.name + ")").c_str()) + what);
    };
    const auto finite = [](const dvec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); };
    if (!finite(e.chromaticity) || e.chromaticity.x < 0 || e.chromaticity.y < 0.001 ||
        e.chromaticity.x + e.chromaticity.y > 1)
        bad("the primary is no CIE xy: 0 <= x, .001 <= y, x + y <= 1.");
    if (!std::isfinite(e.luminance) || e.luminance <= 0) bad("the luminance must be above 0.");
    if (!finite(e.centre) || e.centre.x < -1 || e.centre.y < -1 || e.centre.x > panel.cell_x + 1 ||
        e.centre.y > panel.cell_y + 1)
        bad("the centre lies more than a pixel outside of the cell.");
    if (e.aperture.corners.size() > corner_cap ||
        (!e.aperture.corners.empty() && e.aperture.corners.size() < 3))
        bad(format("the polygon has %zu corners; 3 to %u are allowed.", e.aperture.corners.size(),
                   corner_cap));
    double reach = e.aperture.radius;
    for (const dvec2& corner : e.aperture.corners)
        reach = finite(corner) ? std::max({reach, std::abs(corner.x), std::abs(corner.y)}) : INFINITY;
    if (!(reach <= 2 * cell_cap)) bad("the aperture is larger than any cell.");
    if (!(e.aperture.radius >= 0) || !(aperture_area(e.aperture) > 1e-6)) bad("the aperture has no area.");
    if (e.pixel_x >= panel.cell_x || e.pixel_y >= panel.cell_y)
        bad(format("pixel [%u, %u] is outside of the cell of %u x %u pixels.", e.pixel_x, e.pixel_y,
                   panel.cell_x, panel.cell_y));
}

}  // namespace

Panel mirrored(const Panel& panel) {
    Panel result = panel;
    for (Emitter& e : result.emitters) {
        e.centre.x = panel.cell_x - e.centre.x;
        e.pixel_x = panel.cell_x - 1 - e.pixel_x;
        for (dvec2& corner : e.aperture.corners) corner.x = -corner.x;
    }
    result.advice.shift.x = -panel.advice.shift.x;
    add_change(result, 0, true);
    return result;
}

Panel turned(const Panel& panel, unsigned quarter_turns) {
    Panel result = panel;
    for (unsigned i = 0; i < quarter_turns % 4; ++i) {
        const unsigned height = result.cell_y;
        for (Emitter& e : result.emitters) {
            e.centre = {height - e.centre.y, e.centre.x};
            const unsigned x = e.pixel_x;
            e.pixel_x = height - 1 - e.pixel_y, e.pixel_y = x;
            for (dvec2& corner : e.aperture.corners) corner = {-corner.y, corner.x};
        }
        result.advice.shift = {-result.advice.shift.y, result.advice.shift.x};
        std::swap(result.cell_x, result.cell_y);
    }
    add_change(result, quarter_turns, false);
    return result;
}

void check_panel(const Panel& panel) {
    if (std::min(panel.cell_x, panel.cell_y) < 1 || std::max(panel.cell_x, panel.cell_y) > cell_cap)
        fail(panel, format("the cell is %u x %u pixels; 1 to %u are allowed.", panel.cell_x, panel.cell_y,
                           cell_cap));
    if (panel.emitters.empty() || panel.emitters.size() > emitter_cap)
        fail(panel, format("%zu emitters; 1 to %u are allowed.", panel.emitters.size(), emitter_cap));
    for (std::size_t i = 0; i < panel.emitters.size(); ++i) check_emitter(panel, i);
    for (unsigned c = 0; c < 3; ++c) {
        const auto fed = [&](const Emitter& e) { return unsigned(e.feed) == c; };
        if (std::none_of(panel.emitters.begin(), panel.emitters.end(), fed))
            fail(panel, std::string("no emitter is fed by ") + "RGB"[c] + ".");
    }
    const auto white = [](const Emitter& e) { return e.feed == Feed::white; };
    if (!panel.advice.full_pixel && std::any_of(panel.emitters.begin(), panel.emitters.end(), white))
        fail(panel, "an emitter fed by white has no drive of its own; the advice must be full-pixel.");
    if (panel.ppd && !(*panel.ppd >= 1 && *panel.ppd <= 1000))
        fail(panel, "ppd must be from 1 to 1000 pixels per degree.");
}

std::vector<dvec3> emitter_light(const Panel& panel) {
    double sum = 0;
    for (const Emitter& e : panel.emitters)
        if (e.feed != Feed::white) sum += e.luminance;
    double white = 0;  // what the white emitters replace is what R, G and B would have given
    for (const Emitter& e : panel.emitters)
        if (e.feed == Feed::white) white += e.luminance;
    std::vector<dvec3> light;
    for (const Emitter& e : panel.emitters)
        light.push_back(xyz_of(e.chromaticity, e.luminance / (e.feed == Feed::white ? white : sum)));
    return light;
}

PanelLight panel_light(const Panel& panel) {
    PanelLight light{};
    const std::vector<dvec3> all = emitter_light(panel);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (panel.emitters[i].feed != Feed::white) light.channel[unsigned(panel.emitters[i].feed)] += all[i];
    light.white = light.channel[0] + light.channel[1] + light.channel[2];
    return light;
}

std::vector<Output> panel_outputs(const Panel& panel) {
    std::vector<Output> outputs;
    for (unsigned y = 0; y < panel.cell_y; ++y)
        for (unsigned x = 0; x < panel.cell_x; ++x)
            for (unsigned c = 0; c < 3; ++c) {
                Output output{x, y, c, {}, {x + 0.5, y + 0.5}};
                dvec2 sum{0};
                double light = 0;
                for (unsigned i = 0; i < panel.emitters.size(); ++i) {
                    const Emitter& e = panel.emitters[i];
                    if (e.pixel_x != x || e.pixel_y != y || unsigned(e.feed) != c) continue;
                    output.emitters.push_back(i);
                    sum += e.luminance * (e.centre + aperture_centroid(e.aperture)), light += e.luminance;
                }
                if (light > 0) output.centre = sum / light;
                outputs.push_back(std::move(output));
            }
    return outputs;
}

double pixels_per_degree(double distance, double pitch) { return distance / pitch * pi / 180; }

std::string panel_id(const Panel& panel) {
    const auto rounded = [](double v) { return std::llround(1e6 * v); };
    std::vector<std::vector<long long>> all;
    for (const Emitter& e : panel.emitters) {
        std::vector<std::vector<long long>> corners;
        for (const dvec2& c : e.aperture.corners) corners.push_back({rounded(c.x), rounded(c.y)});
        std::sort(corners.begin(), corners.end());
        all.push_back({long(e.feed), e.pixel_x, e.pixel_y, rounded(e.chromaticity.x),
                       rounded(e.chromaticity.y), rounded(e.luminance), rounded(e.centre.x),
                       rounded(e.centre.y), rounded(e.aperture.radius)});
        for (const auto& corner : corners) all.back().insert(all.back().end(), corner.begin(), corner.end());
    }
    std::sort(all.begin(), all.end());
    Hash hash;
    hash.add_value(panel.cell_x).add_value(panel.cell_y);
    for (const auto& emitter : all)
        for (const long long v : emitter) hash.add_value(v);
    return hash.hex().substr(0, 8);
}

}  // namespace triad
