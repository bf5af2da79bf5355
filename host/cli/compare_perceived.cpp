#include "cli/compare_perceived.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/colour.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "cli/error_map.h"
#include "cli/option_kinds.h"
#include "panel/perceived.h"
#include "session/panel_file.h"

namespace triad {
namespace {

struct Shown {
    std::string path;
    Picture file;
    RgbImage light;
};

Shown open(const std::string& path) {
    Shown shown{path, read_picture(path), {}};
    shown.light = display_of(shown.file);
    if (shown.light.rgb.empty())
        throw Error(Exit::comparison, "A perceived error needs R, G and B; " + path + " lacks some.");
    return shown;
}

/// A picture that was made for one panel is right on no other.
void check_made_for(const Shown& shown, const Panel& panel) {
    const Metadata& data = shown.file.metadata;
    const auto made_for = data.find("triad:panel"), id = data.find("triad:panel_id");
    if (made_for == data.end() ||
        (id == data.end() ? made_for->second == panel.name : id->second == panel_id(panel)))
        return;
    throw Error(Exit::usage, shown.path + " was made for the panel " + made_for->second +
                                 ", whose emitters are others than those of " + panel.name +
                                 ", and is measured on it alone: give it, or its file, to --panel.");
}

/// A render in scene values shows something else than one that a tone map made fit for a display.
void check_shown_alike(const Shown& a, const Shown& b) {
    const auto in_scene_values = [](const Shown& s) {
        return !s.file.encoded && s.file.metadata.contains("triad:spp") &&
               !s.file.metadata.contains("triad:values");
    };
    if (in_scene_values(a) == in_scene_values(b)) return;
    const Shown& scene = in_scene_values(a) ? a : b;
    warn(scene.path + " has scene values and " + (&scene == &a ? b : a).path +
         " has been through a tone map, so that most of their difference may be that. `triad resolve " +
         scene.path + " --reconstruct pane:1 -o FILE.exr` makes a file of what a display shows.");
}

void cut(RgbImage& image, const std::string& path) {
    std::size_t above = 0;
    for (float& v : image.rgb) {
        above += v > 1;
        v = v > 0 ? std::min(v, 1.0f) : 0.0f;
    }
    if (above)
        warn(path +
             format(": %zu values are above 1, which no display shows; they count as 1. A picture in scene "
                    "values needs a tone map first.",
                    above));
}

std::vector<float> lengths(const RgbImage& map) {
    std::vector<float> all(map.rgb.size() / 3);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = float(std::sqrt(double(map.rgb[3 * i]) * map.rgb[3 * i] +
                                 double(map.rgb[3 * i + 1]) * map.rgb[3 * i + 1] +
                                 double(map.rgb[3 * i + 2]) * map.rgb[3 * i + 2]));
    return all;
}

void write_map(const std::string& path, const PerceivedError& error, const Metadata& metadata) {
    std::vector<Channel> parts;
    const char* const names[] = {"lightness", "red_green", "blue_yellow"};
    for (std::size_t c = 0; c < 3; ++c) {
        parts.push_back({names[c], std::vector<float>(error.map.rgb.size() / 3)});
        for (std::size_t i = 0; i < parts[c].values.size(); ++i)
            parts[c].values[i] = error.map.rgb[3 * i + c];
    }
    write_error_map(path, error.map.width, error.map.height, lengths(error.map), parts, metadata);
}

}  // namespace

RgbImage display_of(const Picture& picture) {
    const Channel* channels[] = {picture.find("R"), picture.find("G"), picture.find("B")};
    RgbImage image;
    if (std::count(channels, channels + 3, nullptr) > 0) return image;
    image = {picture.width, picture.height, std::vector<float>(channels[0]->values.size() * 3)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        const float v = channels[i % 3]->values[i / 3];
        image.rgb[i] = picture.encoded ? float(srgb_decode(v)) : v;
    }
    return image;
}

void declare_perceived(CLI::App& command, PerceivedOptions& o) {
    const char* const group = "Perceived error";
    command.add_option("--panel", o.panel, "The display: a name of triad panel, or a panel.json")
        ->type_name("NAME|FILE.json")
        ->group(group);
    command.add_option("--ppd", o.ppd, "Pixels per degree (default: the panel's, else 45)")
        ->check(number_within(1, 1000))
        ->type_name("X")
        ->group(group);
    add_word_list(command, "--eye", "Models of an eye (default: all; the first decides)",
                  {"scielab", "sharp", "flip"}, o.eyes)
        ->group(group);
    command.add_option("--max-perceived", o.limit, "Exit 7 above this")
        ->check(number_within(0, 1e30))
        ->type_name("X")
        ->group(group);
}

Json compare_perceived(const std::string& a, const std::string& b, const PerceivedOptions& o, bool print,
                       std::string& failures) {
    if (o.panel.empty())
        throw Error(Exit::usage,
                    "--metric perceived: name the display with --panel (triad panel lists them).");
    const Panel panel = panel_named(o.panel);
    const double ppd = o.ppd.value_or(panel.ppd.value_or(usual_ppd));
    Shown reference = open(a), picture = open(b);
    if (reference.light.width < picture.light.width) std::swap(reference, picture);
    const unsigned samples = samples_per_pixel(picture.light, reference.light);
    check_made_for(picture, panel);
    if (reference.file.metadata.contains("triad:panel"))
        throw Error(Exit::usage, reference.path +
                                     " was made for a panel; a reference must show what is, not what lights "
                                     "emitters.");
    check_shown_alike(reference, picture);
    cut(reference.light, reference.path);

    Json row = {{"picture", picture.path},
                {"reference", reference.path},
                {"panel", panel.name},
                {"ppd", ppd},
                {"samples_per_pixel", samples}};
    const std::vector<std::string> eyes =
        o.eyes.empty() ? std::vector<std::string>{"scielab", "sharp", "flip"} : o.eyes;
    for (const std::string& name : eyes) {
        const PerceivedMetric metric(panel, reference.light, samples, {.ppd = ppd, .eye = *eye_named(name)});
        const PerceivedError error = metric.of(picture.light);
        if (print)
            std::printf("perceived %-7s E %.4g (lightness %.4g, colour %.4g)  dE mean %.4g, p95 %.4g\n",
                        name.c_str(), error.error, error.lightness, error.colour, error.de_mean,
                        error.de_p95);
        row["perceived"].push_back({{"eye", name},
                                    {"error", error.error},
                                    {"lightness", error.lightness},
                                    {"colour", error.colour},
                                    {"de_mean", error.de_mean},
                                    {"de_p95", error.de_p95}});
        if (name != eyes.front()) continue;
        if (o.limit && !(error.error <= *o.limit))
            failures +=
                format("The perceived error is %.6g, at most %.6g was allowed. ", error.error, *o.limit);
        for (const std::string& path : o.maps)
            write_map(path, error,
                      {{"triad:panel", panel.name}, {"triad:ppd", format("%g", ppd)}, {"triad:eye", name}});
    }
    return row;
}

}  // namespace triad
