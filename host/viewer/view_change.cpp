#include "viewer/view_change.h"

#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

constexpr std::size_t longest_name = 1000;

[[noreturn]] void refuse(const std::string& name, const std::string& expected) {
    throw Error(Exit::usage, "\"" + name + "\": expected " + expected + ".");
}

/// JSON has no NaN and no infinity, and its parser refuses numbers beyond a double.
double number(const std::string& name, const nlohmann::json& value, double lo, double hi) {
    const std::string expected = format("a number from %g to %g", lo, hi);
    if (!value.is_number()) refuse(name, expected);
    const double x = value.get<double>();
    if (!(x >= lo && x <= hi)) refuse(name, expected);
    return x;
}

dvec2 pair(const std::string& name, const nlohmann::json& value, double most) {
    if (!value.is_array() || value.size() != 2) refuse(name, "two numbers");
    return {number(name, value[0], -most, most), number(name, value[1], -most, most)};
}

std::string word(const std::string& name, const nlohmann::json& value) {
    if (!value.is_string()) refuse(name, "a text");
    std::string text = value.get<std::string>();
    if (text.size() > longest_name) refuse(name, "a text of at most 1000 bytes");
    return text;
}

bool flag(const std::string& name, const nlohmann::json& value) {
    if (!value.is_boolean()) refuse(name, "true or false");
    return value.get<bool>();
}

int whole(const std::string& name, const nlohmann::json& value, int lo, int hi) {
    const double x = number(name, value, lo, hi);
    if (x != std::floor(x)) refuse(name, "a whole number");
    return int(x);
}

std::array<unsigned, 4> rectangle(const std::string& name, const nlohmann::json& value) {
    if (!value.is_array() || value.size() != 4) refuse(name, "four numbers: x, y, width, height");
    std::array<unsigned, 4> region{};
    for (std::size_t i = 0; i < 4; ++i) region[i] = unsigned(whole(name, value[i], 0, 65536));
    return region;
}

using Assign = std::function<void(ViewChange&, const std::string&, const nlohmann::json&)>;

const std::map<std::string, Assign>& members() {
    static const std::map<std::string, Assign> all = {
        {"orbit",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.orbit = pair(n, v, 100); }},
        {"pan",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.pan = pair(n, v, 100); }},
        {"zoom", [](ViewChange& c, const std::string& n,
                    const nlohmann::json& v) { c.zoom = number(n, v, 1e-3, 1e3); }},
        {"camera", [](ViewChange& c, const std::string& n,
                      const nlohmann::json& v) { c.camera = whole(n, v, -1, 1 << 20); }},
        {"scale", [](ViewChange& c, const std::string& n,
                     const nlohmann::json& v) { c.scale = number(n, v, 0.01, 1); }},
        {"variant",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.variant = word(n, v); }},
        {"panel", [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.panel = word(n, v); }},
        {"subpixels",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.subpixels = flag(n, v); }},
        {"region",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.region = rectangle(n, v); }},
        {"paused",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.paused = flag(n, v); }},
        {"exposure", [](ViewChange& c, const std::string& n,
                        const nlohmann::json& v) { c.exposure = number(n, v, -64, 64); }},
        {"tonemap",
         [](ViewChange& c, const std::string& n, const nlohmann::json& v) { c.tone_map = word(n, v); }},
    };
    return all;
}

}  // namespace

Urgency urgency_of(const ViewChange& c) {
    if (c.orbit || c.pan || c.zoom || c.camera || c.scale || c.variant) return Urgency::picture;
    if (c.region || c.paused || c.panel || c.subpixels) return Urgency::pause;
    return c.exposure || c.tone_map ? Urgency::display : Urgency::none;
}

ViewChange parse_change(std::string_view json) {
    const nlohmann::json object = nlohmann::json::parse(json, nullptr, false);
    if (!object.is_object()) throw Error(Exit::usage, "A change is a JSON object.");
    ViewChange change;
    for (const auto& [name, value] : object.items()) {
        const auto found = members().find(name);
        if (found == members().end()) {
            std::string names;
            for (const auto& [known, assign] : members()) names += (names.empty() ? "" : ", ") + known;
            throw Error(Exit::usage,
                        "There is no \"" + name.substr(0, 100) + "\" to change; there are " + names + ".");
        }
        found->second(change, name, value);
    }
    return change;
}

}  // namespace triad
