#include "measure/subpixel_bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

constexpr std::array eyes = {Eye::scielab, Eye::sharp, Eye::flip};

/// Makes methods, and leaves out those that are not for the plan's panel.
class Methods {
  public:
    explicit Methods(const SubpixelPlan& plan) : plan_(plan) {}

    void add(const std::string& name, ReconstructionChoice choice, bool with_panel = true) {
        if (with_panel) choice.panel = PanelView{plan_.panel, plan_.ppd};
        try {
            all.push_back({name, reconstruction_of(choice)});
        } catch (const Error& error) {
            if (error.exit() != Exit::usage) throw;
        }
    }

    std::vector<SubpixelMethod> all;

  private:
    const SubpixelPlan& plan_;
};

/// Errors of one method at some rays, by eye.
struct Scored {
    std::string method;
    unsigned rays;
    double rays_per_pixel = 0, seconds = 0;
    std::array<TileErrors, eyes.size()> tiles;
};

SubpixelRow row_of(const Scored& s, std::size_t eye, const std::string& scene) {
    const TileErrors& t = s.tiles[eye];
    return {scene,
            eye_name(eyes[eye]),
            s.method,
            s.rays,
            s.rays_per_pixel,
            error_interval(t),
            root_mean(t.lightness, t.samples),
            root_mean(t.colour, t.samples),
            s.seconds,
            {}};
}

}  // namespace

bool beats_triad(const SubpixelRow& row) { return row.over_triad && row.over_triad->high < 0; }

std::vector<SubpixelMethod> subpixel_methods(const SubpixelPlan& plan, unsigned rays, bool rendered) {
    Methods methods(plan);
    const auto side = unsigned(std::lround(std::sqrt(rays)));
    methods.add("centre", {.method = "centre"}, false);
    if (side * side == rays && side <= 16)
        methods.add(format("ssaa:%u", side), {.method = format("ssaa:%u", side)}, false);
    methods.add("pane:4", {.method = "pane:4"}, false);
    methods.add("pane-encoded:4", {.method = "pane-encoded:4"}, false);
    for (const std::string& name : filter_names())
        methods.add(name, {.filter = parse_filter(name), .bins = uvec2(3)}, false);
    for (const char* name : {"subpixel3", "displaced", "platt", "platt:3", "random3", "random3:shared"})
        methods.add(name, {.method = name});
    methods.add("triad-unrefined", {.method = "triad", .refine_steps = 0});
    methods.add(subpixel_yardstick, {.method = "triad"});
    if (rendered) {
        methods.add(subpixel_adaptive, {.method = "triad"});
        methods.all.back().adaptive = true;
    }
    return methods.all;
}

std::vector<std::pair<SubpixelMethod, unsigned>> supersampling_curve(const SubpixelPlan& plan) {
    Methods methods(plan);
    std::vector<std::pair<SubpixelMethod, unsigned>> curve;
    for (unsigned side = 1; side <= 8; ++side) {
        if (std::find(plan.rays.begin(), plan.rays.end(), side * side) != plan.rays.end()) continue;
        methods.add(format("ssaa:%u", side), {.method = format("ssaa:%u", side)}, false);
        curve.push_back({methods.all.back(), side * side});
    }
    return curve;
}

void run_subpixel(const SubpixelPlan& plan, const std::string& scene, SubpixelSource& source, bool rendered,
                  const std::function<bool(const std::string&)>& go_on, std::vector<SubpixelRow>& rows) {
    std::vector<PerceivedMetric> metrics;
    for (const Eye eye : eyes)
        metrics.emplace_back(plan.panel, source.reference(), source.samples(),
                             PerceivedChoice{.ppd = plan.ppd, .eye = eye});
    const auto score = [&](const SubpixelMethod& method, unsigned rays, unsigned repetition, Scored& scored) {
        const SubpixelShot shot = source.shoot(method, rays, plan.seed + repetition);
        scored.rays_per_pixel += shot.rays_per_pixel / plan.repetitions;
        scored.seconds += shot.seconds / plan.repetitions;
        for (std::size_t e = 0; e < eyes.size(); ++e)
            add(scored.tiles[e], tile_errors(metrics[e].of(shot.drives), source.samples()));
    };
    for (const unsigned rays : plan.rays) {
        const std::vector<SubpixelMethod> methods = subpixel_methods(plan, rays, rendered);
        std::vector<Scored> all;
        for (const SubpixelMethod& m : methods) all.push_back({m.name, rays, 0, 0, {}});
        for (unsigned repetition = 0; repetition < plan.repetitions; ++repetition)
            for (std::size_t m = 0; m < methods.size(); ++m) {
                score(methods[m], rays, repetition, all[m]);
                if (!go_on(format("%s, %u rays per pixel, repetition %u: %s", scene.c_str(), rays,
                                  repetition + 1, methods[m].name.c_str())))
                    return;
            }
        const auto yardstick = std::find_if(all.begin(), all.end(),
                                            [](const Scored& s) { return s.method == subpixel_yardstick; });
        for (const Scored& s : all)
            for (std::size_t e = 0; e < eyes.size(); ++e) {
                rows.push_back(row_of(s, e, scene));
                if (yardstick != all.end() && s.method != subpixel_yardstick)
                    rows.back().over_triad = difference_interval(s.tiles[e], yardstick->tiles[e]);
            }
    }
    for (const auto& [method, rays] : supersampling_curve(plan)) {
        Scored scored{method.name, rays, 0, 0, {}};
        for (unsigned repetition = 0; repetition < plan.repetitions; ++repetition)
            score(method, rays, repetition, scored);
        for (std::size_t e = 0; e < eyes.size(); ++e) rows.push_back(row_of(scored, e, scene));
        if (!go_on(scene + ": " + method.name)) return;
    }
}

}  // namespace triad
