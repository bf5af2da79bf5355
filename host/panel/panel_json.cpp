#include "panel/panel_json.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

using Json = nlohmann::ordered_json;

constexpr int depth_cap = 16;
const char* const channels[] = {"R", "G", "B", "W"};

/// A value and the way to it, for sentences.
class Member {
  public:
    Member(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

    [[noreturn]] void fail(const std::string& what) const { throw Error(Exit::scene, path_ + " " + what); }

    /// The member of this name, which must be there.
    Member operator[](const char* name) const {
        if (!has(name)) fail(std::string("lacks \"") + name + "\".");
        return {json_[name], path_ + "." + name};
    }
    bool has(const char* name) const { return json_.contains(name); }

    /// An object that has no other members than these: a slip of the pen is no silent default.
    void only(std::initializer_list<const char*> names) const {
        if (!json_.is_object()) fail("is no object.");
        for (const auto& [name, value] : json_.items())
            if (std::none_of(names.begin(), names.end(),
                             [&name = name](const char* known) { return name == known; }))
                fail("has an unknown member \"" + name + "\".");
    }
    double number() const {
        if (!json_.is_number()) fail("is no number.");
        return json_.get<double>();
    }
    dvec2 pair() const {
        const auto both = items(2, 2);
        return {both[0].number(), both[1].number()};
    }
    /// Two whole numbers, 0 or more.
    uvec2 whole_pair() const {
        const dvec2 v = pair();
        if (v != glm::floor(v) || v.x < 0 || v.y < 0 || v.x > 1e6 || v.y > 1e6)
            fail("must be two whole numbers.");
        return uvec2(v);
    }
    std::string text() const {
        if (!json_.is_string()) fail("is no text.");
        return json_.get<std::string>();
    }
    std::vector<Member> items(std::size_t least, std::size_t most) const {
        if (!json_.is_array() || json_.size() < least || json_.size() > most)
            fail(least == most ? format("must be a list of %zu.", most)
                               : format("must be a list of %zu to %zu.", least, most));
        std::vector<Member> all;
        for (std::size_t i = 0; i < json_.size(); ++i)
            all.push_back({json_[i], path_ + "[" + std::to_string(i) + "]"});
        return all;
    }
    /// Index of the text among the names.
    unsigned one_of(std::initializer_list<const char*> names) const {
        const std::string value = text();
        std::string list;
        for (auto name = names.begin(); name != names.end(); ++name) {
            if (value == *name) return unsigned(name - names.begin());
            list += (list.empty() ? "" : ", ") + std::string(*name);
        }
        fail("is \"" + value + "\"; it must be one of " + list + ".");
    }

  private:
    const Json& json_;
    std::string path_;
};

Aperture aperture_of(const Member& m) {
    m.only({"rectangle", "polygon", "disc"});
    if (int(m.has("rectangle")) + int(m.has("polygon")) + int(m.has("disc")) != 1)
        m.fail(
            "must have one of \"rectangle\": [width, height], \"polygon\": [[x, y], ...], \"disc\": radius.");
    if (m.has("disc")) return {{}, m["disc"].number()};
    Aperture aperture;
    if (m.has("polygon")) {
        for (const Member& corner : m["polygon"].items(3, 256)) aperture.corners.push_back(corner.pair());
        return aperture;
    }
    const dvec2 half = m["rectangle"].pair() / 2.0;
    if (!(half.x > 0 && half.y > 0)) m["rectangle"].fail("must be above 0 both ways.");
    aperture.corners = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    return aperture;
}

Emitter emitter_of(const Member& m) {
    m.only({"name", "primary", "luminance", "centre", "aperture", "pixel", "channel"});
    Emitter e;
    e.feed = Feed(m["channel"].one_of({"R", "G", "B", "W"}));
    e.name = m.has("name") ? m["name"].text() : channels[unsigned(e.feed)];
    e.chromaticity = m["primary"].pair();
    e.luminance = m["luminance"].number();
    e.centre = m["centre"].pair();
    e.aperture = aperture_of(m["aperture"]);
    if (m.has("pixel")) {
        const uvec2 pixel = m["pixel"].whole_pair();
        e.pixel_x = pixel.x, e.pixel_y = pixel.y;
    }
    return e;
}

constexpr double least_ppd = 5, most_ppd = 1000;  ///< that taps are designed for

/// Degrees from the members ppd, or distance and pitch.
std::optional<double> ppd_of(const Member& m) {
    if (m.has("distance") != m.has("pitch"))
        m.fail("must have \"distance\" and \"pitch\" together, in the same unit.");
    if (m.has("ppd") && m.has("pitch")) m.fail("must have either \"ppd\" or \"distance\" and \"pitch\".");
    if (m.has("ppd")) {
        const double ppd = m["ppd"].number();
        if (!(ppd >= least_ppd && ppd <= most_ppd)) m["ppd"].fail("must be 5 to 1000.");
        return ppd;
    }
    if (!m.has("pitch")) return {};
    const double distance = m["distance"].number(), pitch = m["pitch"].number();
    if (!(distance > 0 && pitch > 0)) m.fail("must have a \"distance\" and a \"pitch\" above 0.");
    const double ppd = pixels_per_degree(distance, pitch);
    if (!(ppd >= least_ppd && ppd <= most_ppd))
        m.fail("has a \"distance\" and a \"pitch\" of " + std::to_string(ppd) +
               " pixels per degree; 5 to 1000 are possible.");
    return ppd;
}

PanelAdvice advice_of(const Member& m) {
    PanelAdvice advice;
    advice.full_pixel = m.has("advice") && m["advice"].one_of({"subpixel", "full-pixel"}) == 1;
    if (advice.full_pixel) advice.why = "The panel's file asks for the full pixel.";
    if (m.has("shift")) {
        advice.shift = m["shift"].pair();
        if (!advice.full_pixel) m["shift"].fail("moves the full pixel; it needs \"advice\": \"full-pixel\".");
        if (!(std::abs(advice.shift.x) <= 1 && std::abs(advice.shift.y) <= 1))
            m["shift"].fail("must be at most one pixel.");
    }
    return advice;
}

Panel panel_of(const Member& m) {
    m.only({"name", "description", "cell", "emitters", "rotation", "flip", "ppd", "distance", "pitch",
            "advice", "shift"});
    Panel panel;
    panel.name = m["name"].text();
    if (panel.name.empty() || panel.name.size() > 100) m["name"].fail("must have 1 to 100 letters.");
    if (m.has("description")) panel.description = m["description"].text();
    if (m.has("cell")) {
        const uvec2 cell = m["cell"].whole_pair();
        panel.cell_x = cell.x, panel.cell_y = cell.y;
    }
    for (const Member& emitter : m["emitters"].items(1, 256)) panel.emitters.push_back(emitter_of(emitter));
    panel.ppd = ppd_of(m);
    panel.advice = advice_of(m);
    check_panel(panel);
    const unsigned flip = m.has("flip") ? m["flip"].one_of({"none", "horizontal", "vertical", "both"}) : 0;
    if (flip & 1) panel = mirrored(panel);
    if (flip & 2) panel = turned(mirrored(panel), 2);  // top to bottom
    if (m.has("rotation")) {
        const double degrees = m["rotation"].number();
        if (degrees != 0 && degrees != 90 && degrees != 180 && degrees != 270)
            m["rotation"].fail("must be 0, 90, 180 or 270 degrees, clockwise.");
        panel = turned(panel, unsigned(degrees / 90));
    }
    return panel;
}

}  // namespace

Panel panel_of_json(std::string_view text, const std::string& where) {
    Json json;
    try {
        json = Json::parse(text, [&](int depth, Json::parse_event_t, Json&) {
            if (depth > depth_cap)
                throw Error(Exit::scene, where + " nests deeper than any panel; is it a panel.json?");
            return true;
        });
    } catch (const nlohmann::json::exception& error) {
        throw Error(Exit::scene, where + " is not valid JSON: " + words_of_json(error) + ".");
    }
    try {
        return panel_of({json, "panel"});
    } catch (const Error& error) {
        throw Error(error.exit(), where + ": " + error.what());
    }
}

std::string json_of_panel(const Panel& panel) {
    const auto pair = [](const dvec2& v) { return Json::array({v.x, v.y}); };
    Json json = {
        {"name", panel.name}, {"description", panel.description}, {"cell", {panel.cell_x, panel.cell_y}}};
    for (const Emitter& e : panel.emitters) {
        Json aperture;
        if (e.aperture.corners.empty()) aperture["disc"] = e.aperture.radius;
        for (const dvec2& corner : e.aperture.corners) aperture["polygon"].push_back(pair(corner));
        json["emitters"].push_back({{"name", e.name},
                                    {"channel", channels[unsigned(e.feed)]},
                                    {"pixel", {e.pixel_x, e.pixel_y}},
                                    {"primary", pair(e.chromaticity)},
                                    {"luminance", e.luminance},
                                    {"centre", pair(e.centre)},
                                    {"aperture", aperture}});
    }
    if (panel.ppd) json["ppd"] = *panel.ppd;
    json["advice"] = panel.advice.full_pixel ? "full-pixel" : "subpixel";
    if (panel.advice.full_pixel) json["shift"] = pair(panel.advice.shift);
    return json.dump(2) + "\n";
}

}  // namespace triad
