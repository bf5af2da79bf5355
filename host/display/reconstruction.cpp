#include "display/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace triad {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string text(const uvec2& bins) { return std::to_string(bins.x) + "x" + std::to_string(bins.y); }

[[noreturn]] void refuse(const std::string& method, const std::string& why) {
    throw Error(Exit::usage, "--reconstruct " + method + ": " + why);
}

/// A method's name and the N behind its colon.
struct Word {
    std::string name, argument;
};

Word split(const std::string& method) {
    const std::size_t colon = method.find(':');
    return {method.substr(0, colon), colon == std::string::npos ? "" : method.substr(colon + 1)};
}

/// N of NAME:N; `otherwise` where there is none, 0 where there must be one.
unsigned number_of(const std::string& method, unsigned otherwise) {
    const std::string argument = split(method).argument;
    if (argument.empty() && method.find(':') == std::string::npos && otherwise > 0) return otherwise;
    const bool digits =
        !argument.empty() && argument.size() <= 2 &&
        std::all_of(argument.begin(), argument.end(), [](char c) { return c >= '0' && c <= '9'; });
    const unsigned n = digits ? unsigned(std::stoul(argument)) : 0;
    if (n < 1 || n > 16) refuse(method, "N in " + split(method).name + ":N is a number from 1 to 16.");
    return n;
}

/// The emitters of a panel along the axis that they differ most in; R, G, B of a stripe without one.
struct Triple {
    uvec2 bins{3, 1};
    std::vector<dvec2> centres = {dvec2(1 / 6.0, 0.5), dvec2(0.5), dvec2(5 / 6.0, 0.5)};
    unsigned cell_x = 1, cell_y = 1;
};

Triple triple_of(const std::optional<PanelView>& view) {
    Triple t;
    if (!view || view->panel.advice.full_pixel) return t;
    t.centres.clear();
    t.cell_x = view->panel.cell_x, t.cell_y = view->panel.cell_y;
    dvec2 least(1e9), most(-1e9);
    for (const Output& o : panel_outputs(view->panel)) {
        const dvec2 centre = o.centre - dvec2(o.x, o.y);
        t.centres.push_back(centre);
        least = glm::min(least, centre), most = glm::max(most, centre);
    }
    if (most.y - least.y > most.x - least.x + 1e-9) t.bins = {1, 3};
    return t;
}

/// Each output sees one bin: the third of a pixel that its emitter lies in, or its number where the bins are
/// the channels'.
TapTable own_bins(const Triple& t, bool by_number) {
    TapTable table{t.bins.x, t.bins.y, t.cell_x, t.cell_y, {}};
    for (std::size_t i = 0; i < t.centres.size(); ++i) {
        Taps taps;
        if (by_number)
            taps.first_x = int(i % 3);
        else if (t.bins.x == 3)
            taps.first_x = int(std::floor(t.centres[i].x * 3 + 1e-9));
        else
            taps.first_y = int(std::floor(t.centres[i].y * 3 + 1e-9));
        taps.weights = taps.across = taps.down = {1.0f};
        table.outputs.push_back(taps);
    }
    return table;
}

TapTable displaced(const PixelFilter& filter, const PanelView& view, const uvec2& bins) {
    if (view.panel.advice.full_pixel) {
        const dvec2 centre = dvec2(0.5) + view.panel.advice.shift;
        return filter_taps(filter, bins.x, bins.y, {centre, centre, centre});
    }
    TapTable table{bins.x, bins.y, view.panel.cell_x, view.panel.cell_y, {}};
    const std::vector<Output> outputs = panel_outputs(view.panel);
    for (std::size_t i = 0; i < outputs.size(); i += 3) {
        std::array<dvec2, 3> centres;
        for (std::size_t c = 0; c < 3; ++c)
            centres[c] = outputs[i + c].centre - dvec2(outputs[i + c].x, outputs[i + c].y);
        const TapTable pixel = filter_taps(filter, bins.x, bins.y, centres);
        table.outputs.insert(table.outputs.end(), pixel.outputs.begin(), pixel.outputs.end());
    }
    return table;
}

std::string words(const PixelFilter& filter) {
    return filter_names()[std::size_t(filter.shape)] + ":" + number(filter.width);
}

class Maker {
  public:
    explicit Maker(const ReconstructionChoice& choice) : c_(choice) {}

    Reconstruction make() {
        r_.method = c_.method.empty() ? c_.panel && !c_.filter ? "triad"
                                        : c_.filter            ? "filter"
                                                               : ""
                                      : c_.method;
        const std::string name = split(r_.method).name;
        const bool takes_filter = name == "filter" || name == "random3", uses_panel = known(name);
        if (c_.filter && !takes_filter) refuse(r_.method, "--filter goes with filter and random3 alone.");
        if (c_.panel && !uses_panel)
            refuse(r_.method, "it makes the same picture for every panel; leave --panel out.");
        if (uses_panel) r_.panel = c_.panel;
        make(name);
        return std::move(r_);
    }

  private:
    const ReconstructionChoice& c_;
    Reconstruction r_;

    /// Whether its drives are for a panel.
    bool known(const std::string& name) {
        if (r_.method.empty()) return false;
        const MethodWords& m = method_named(r_.method);
        if (m.needs_panel && !c_.panel)
            refuse(r_.method, "it is made for a panel; name it with --panel (triad panel lists them).");
        return m.needs_panel || name == "filter" || name == "subpixel3";
    }

    void set_bins(const uvec2& bins) {
        if (c_.bins && *c_.bins != bins)
            refuse(r_.method, "it has " + text(bins) + " bins per pixel, not " + text(*c_.bins) + ".");
        r_.bins_x = bins.x, r_.bins_y = bins.y;
    }
    void choose_bins(const uvec2& bins) { set_bins(c_.bins.value_or(bins)); }
    uvec2 bins() const { return {r_.bins_x, r_.bins_y}; }

    TapTable designed(const TapDesign& design) const {
        return kept_taps(r_.panel->panel, r_.panel->ppd, design);
    }

    void make(const std::string& name) {
        if (name.empty()) {
            choose_bins({1, 1});
        } else if (name == "centre") {
            set_bins({1, 1});
            r_.ray_start = RayStart::centre, r_.order = ToneOrder::per_pixel;
        } else if (name == "ssaa") {
            set_bins(uvec2(number_of(r_.method, 0)));
            r_.ray_start = RayStart::centre, r_.order = ToneOrder::per_pixel;
        } else if (name == "pane" || name == "pane-encoded") {
            set_bins(uvec2(number_of(r_.method, 4)));
            if (name == "pane-encoded") r_.order = ToneOrder::per_bin_encoded;
        } else if (name == "filter") {
            make_filter();
        } else if (name == "subpixel3") {
            const Triple triple = triple_of(r_.panel);
            set_bins(triple.bins);
            r_.ray_start = RayStart::centre;
            r_.taps = own_bins(triple, false);
            r_.filter = "own subpixel";
        } else if (name == "displaced") {
            choose_bins({3, 3});
            r_.taps = displaced_box_taps(r_.panel->panel, r_.bins_x, r_.bins_y);
            r_.filter = "displaced box";
            r_.order = ToneOrder::noise_aware;
        } else if (name == "platt") {
            const bool nine = r_.method == "platt";
            r_.taps = platt_taps(r_.panel->panel, r_.panel->ppd, nine);
            set_bins({r_.taps->bins_x, r_.taps->bins_y});
            r_.filter = nine ? "Platt, nine filters" : "Platt, three filters";
        } else if (name == "random3") {
            make_random();
        } else {
            make_triad();
        }
    }

    void make_filter() {
        if (!c_.filter) refuse(r_.method, "name the filter with --filter NAME[:WIDTH].");
        choose_bins({3, 3});
        r_.filter = words(*c_.filter);
        if (r_.panel) {
            r_.taps = displaced(*c_.filter, *r_.panel, bins());
            r_.filter += ", displaced";
            r_.order = ToneOrder::noise_aware;
        } else {
            r_.taps = filter_taps(*c_.filter, r_.bins_x, r_.bins_y);
            r_.order = ToneOrder::per_pixel;
        }
    }

    /// Rays start where the filter is large and carry its sign: nothing is left to do for taps.
    void make_random() {
        const bool shared = r_.method == "random3:shared";
        Triple triple = triple_of(r_.panel);
        triple.bins = shared ? uvec2(1, 1) : uvec2(3, 1);
        set_bins(triple.bins);
        r_.ray_start = RayStart::filter, r_.order = ToneOrder::per_pixel;
        r_.ray_filter = c_.filter ? displaced(*c_.filter, *r_.panel, {3, 3}) : designed(published_design);
        r_.filter = std::string(c_.filter ? words(*c_.filter) : "optimal") + ", by rays";
        if (!shared) {
            triple.cell_x = triple.cell_y = 1, triple.centres.resize(3);
            r_.taps = own_bins(triple, true);
        }
    }

    void make_triad() {
        choose_bins({3, 3});
        const bool refine = c_.refine_steps > 0 && !r_.panel->panel.advice.full_pixel;
        TapDesign design;
        // Taps that reach further leave [0, 1] further, which only a refinement takes back.
        if (!refine) design.reach = published_design.reach, design.pull = published_design.pull;
        design.bins_x = r_.bins_x, design.bins_y = r_.bins_y;
        r_.taps = designed(design);
        r_.filter = "optimal";
        r_.order = ToneOrder::noise_aware;
        if (refine) {
            r_.refine = design_refine(r_.panel->panel, r_.panel->ppd);
            r_.refine_steps = c_.refine_steps;
            r_.filter += ", refined " + std::to_string(c_.refine_steps);
        }
    }
};

}  // namespace

const std::vector<MethodWords>& reconstruction_methods() {
    static const std::vector<MethodWords> methods = {
        {"centre", "one ray at the centre of the pixel"},
        {"ssaa:N", "N x N rays at bin centres, their mean"},
        {"pane:N", "N x N bins, tone-mapped one by one, their mean light"},
        {"pane-encoded:N", "the same, the mean of sRGB-encoded values"},
        {"filter", "the pixel filter of --filter; with --panel, around each emitter"},
        {"subpixel3", "a ray at each third of the pixel: R, G and B from one each"},
        {"displaced", "a box of one pixel around each emitter", true},
        {"platt", "three samples per pixel, nine optimal filters", true},
        {"platt:3", "three samples per pixel, three optimal filters", true},
        {"random3", "rays by the optimal filters, one path for each channel", true},
        {"random3:shared", "rays by the optimal filters, one path for all channels", true},
        {"triad", "3 x 3 bins, tone-mapped one by one where rays suffice, optimal taps, bounded refinement",
         true}};
    return methods;
}

const MethodWords& method_named(const std::string& method) {
    std::string names;
    for (const MethodWords& m : reconstruction_methods()) {
        const bool takes_number = m.name.ends_with(":N");
        if (takes_number ? split(m.name).name == split(method).name : m.name == method) return m;
        names += (names.empty() ? "" : ", ") + m.name;
    }
    refuse(method, "there is no such method. There are " + names + ".");
}

Reconstruction reconstruction_of(const ReconstructionChoice& choice) { return Maker(choice).make(); }

void apply(const Reconstruction& method, DisplaySettings& settings) {
    settings.order = method.order;
    settings.taps = method.taps;
    settings.refine = method.refine;
    settings.refine_steps = method.refine_steps;
    if (method.panel) settings.alpha = false;
}

void apply(const Reconstruction& method, RenderSettings& settings) {
    settings.bins_x = method.bins_x, settings.bins_y = method.bins_y;
    settings.ray_start = method.ray_start;
    settings.ray_filter = method.ray_filter;
}

std::uint64_t whole_bins(std::uint64_t samples, unsigned bins) { return (samples + bins - 1) / bins * bins; }

}  // namespace triad
