// triad panel: displays, their taps, and what they look like through a magnifier.
#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "base/check_outputs.h"
#include "base/files.h"
#include "cli/command_line.h"
#include "cli/compare_perceived.h"
#include "cli/option_kinds.h"
#include "panel/design.h"
#include "panel/panel_json.h"
#include "report/error_pictures.h"
#include "report/panel_chart.h"
#include "report/panel_report.h"
#include "session/panel_file.h"

namespace triad {
namespace {

constexpr std::size_t most_samples = std::size_t(1) << 28;  // of a drawing

struct PanelOptions {
    std::string panel, filter = "triad", output, picture, file, test, json;
    uvec2 bins{3, 3};
    std::optional<std::array<unsigned, 4>> crop;
    std::optional<double> ppd;
    bool taps = false;
    unsigned zoom = 48;
};

TapTable taps_of(const PanelOptions& o, const Panel& panel, double ppd) {
    const uvec2& bins = o.bins;
    if (o.filter == "displaced") {
        check_design(ppd, bins.x, bins.y);
        return displaced_box_taps(panel, bins.x, bins.y);
    }
    if (o.filter == "platt") return platt_taps(panel, ppd, true);
    return kept_taps(panel, ppd,
                     {.bins_x = bins.x,
                      .bins_y = bins.y,
                      .cross_colour = o.filter == "cross-colour",
                      .separable = o.filter == "separable"});
}

/// The picture, or the part of it that --crop names.
RgbImage drives_of(const PanelOptions& o) {
    RgbImage whole = display_of(read_picture(o.picture));
    if (whole.rgb.empty()) throw Error(Exit::scene, o.picture + " lacks R, G or B.");
    if (!o.crop) return whole;
    const auto& [left, top, width, height] = *o.crop;
    if (left + width > whole.width || top + height > whole.height || width < 1 || height < 1)
        throw Error(Exit::usage, "--crop: the picture has " + std::to_string(whole.width) + "x" +
                                     std::to_string(whole.height) + " pixels.");
    RgbImage part{width, height, {}};
    for (unsigned y = 0; y < part.height; ++y) {
        const float* row = whole.rgb.data() + (std::size_t(top + y) * whole.width + left) * 3;
        part.rgb.insert(part.rgb.end(), row, row + part.width * 3);
    }
    return part;
}

RgbImage drawing(const PanelOptions& o, const Panel& panel) {
    if (o.picture.empty()) return magnified(panel, o.zoom);
    const RgbImage drives = drives_of(o);
    if (std::size_t(drives.width) * drives.height * o.zoom * o.zoom > most_samples)
        throw Error(Exit::usage,
                    "--zoom " + std::to_string(o.zoom) +
                        ": the drawing would have more than 2^28 samples; take a part with --crop, or a "
                        "smaller zoom.");
    return magnified(panel, drives, o.zoom);
}

void draw(const PanelOptions& o, const Panel& panel) {
    const std::vector<std::uint8_t> png = png_of(drawing(o, panel));
    write_file(o.output, {reinterpret_cast<const char*>(png.data()), png.size()});
}

void draw_chart(const PanelOptions& o) {
    BytePicture chart = panel_chart(o.ppd.value_or(usual_ppd));
    const std::vector<std::uint8_t> png =
        encode_picture(".png", {chart.width, chart.height, 3, 8, std::move(chart.rgb), {}});
    write_file(o.test, {reinterpret_cast<const char*>(png.data()), png.size()});
}

void check_png(const std::string& option, const std::string& path) {
    if (!path.empty() && !path.ends_with(".png"))
        throw Error(Exit::usage, option + " " + path + ": the extension must be .png.");
}

Exit run(const PanelOptions& o) {
    check_png("-o", o.output);
    check_png("--test", o.test);
    check_outputs({o.output, o.test, o.file, o.json}, {o.panel, o.picture});
    if (!o.test.empty()) {
        draw_chart(o);
        if (o.panel.empty() && o.json.empty()) return Exit::done;
    }
    const bool print = o.json != "-";
    Json rows = Json::array();
    if (o.panel.empty()) {
        if (o.taps || !o.output.empty() || !o.file.empty() || !o.picture.empty())
            throw Error(Exit::usage, "Name the panel: triad panel NAME ...; triad panel alone lists them.");
        for (const Panel& panel : builtin_panels()) {
            if (print) std::puts(panel_line(panel).c_str());
            rows.push_back(panel_row(panel));
        }
        if (print)
            std::puts("Each also turned or mirrored, as in qd-oled@180 and rgb@flip; others as panel.json.");
    } else {
        const Panel panel = panel_named(o.panel);
        if (print) std::fputs(panel_text(panel).c_str(), stdout);
        Json row = panel_row(panel);
        if (o.taps) {
            const double ppd = o.ppd.value_or(panel.ppd.value_or(usual_ppd));
            const TapTable table = taps_of(o, panel, ppd);
            if (print)
                std::printf("%s taps for %g pixels per degree, %s", o.filter.c_str(), ppd,
                            taps_text(table).c_str());
            row["design_ppd"] = ppd;
            row["taps"] = taps_json(table);
        }
        rows.push_back(std::move(row));
        if (!o.output.empty()) draw(o, panel);
        if (!o.file.empty()) write_file(o.file, json_of_panel(panel));
    }
    if (!o.json.empty()) write_report(o.json, "panel", nullptr, std::move(rows));
    return Exit::done;
}

}  // namespace

void add_panel(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<PanelOptions>();
    CLI::App* command =
        app.add_subcommand("panel", "Displays: their emitters, their taps, and how they look magnified");
    command->add_option("PANEL", o->panel, "A name, or a panel.json; without it the built-in ones are listed")
        ->type_name("");
    command->add_flag("--taps", o->taps, "Print the designed taps");
    command
        ->add_option("--ppd", o->ppd,
                     "Pixels per degree that they are designed for (default: the panel's, else 45)")
        ->check(number_within(5, 1000))
        ->type_name("X");
    add_parsed(*command, "--bins", "BXxBY", "Bins per pixel of the film (default 3x3)",
               [o](const std::string& v) { o->bins = parse_size("--bins", v); });
    add_word(*command, "--filter", "How taps are designed (default triad)",
             {"triad", "separable", "cross-colour", "displaced", "platt"}, o->filter);
    command
        ->add_option("-o,--output", o->output, "Draw the emitters, magnified: white, or the picture's drives")
        ->type_name("FILE.png");
    command->add_option("--picture", o->picture, "What the drawing's display shows")->type_name("FILE");
    add_parsed(*command, "--crop", "X,Y,W,H", "The part of the picture",
               [o](const std::string& v) { o->crop = parse_crop("--crop", v); });
    command->add_option("--zoom", o->zoom, "Of the drawing (default 48)")
        ->check(whole_number_within(1, 256))
        ->type_name("N");
    command
        ->add_option(
            "--test", o->test,
            "Draw a chart to see which panel a display has: shown pixel by pixel and seen from the usual "
            "distance, the lines of its own tile are grey")
        ->type_name("FILE.png");
    command->add_option("--write", o->file, "Write the panel as panel.json, to be changed")
        ->type_name("FILE");
    add_json(*command, o->json);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
