#include "bench/subpixel_bench.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "panel/tile_metric.h"

namespace triad {
namespace {

/// Errors of one method at some rays on one display, by eye.
struct Scored {
    std::string method;
    unsigned rays;
    double rays_per_pixel = 0, seconds = 0;
    std::array<TileErrors, all_eyes.size()> tiles;

    void add(const SubpixelShot& shot, const TileMetric& metric, unsigned repetitions) {
        rays_per_pixel += shot.rays_per_pixel / repetitions;
        seconds += shot.seconds / repetitions;
        const auto more = metric.of(shot.drives);
        for (std::size_t e = 0; e < all_eyes.size(); ++e) triad::add(tiles[e], more[e]);
    }
};

/// Rows of all eyes; with the method that they are to be compared with.
void add_rows(const Scored& s, const Scored* yardstick, const std::string& scene, const PanelView& view,
              std::vector<SubpixelRow>& rows) {
    for (std::size_t e = 0; e < all_eyes.size(); ++e) {
        const TileErrors& t = s.tiles[e];
        rows.push_back({scene,
                        view.panel.name,
                        view.ppd,
                        eye_name(all_eyes[e]),
                        s.method,
                        s.rays,
                        s.rays_per_pixel,
                        error_interval(t),
                        root_mean(t.lightness, t.samples),
                        root_mean(t.colour, t.samples),
                        s.seconds,
                        {}});
        if (yardstick && yardstick != &s)
            rows.back().over_triad = difference_interval(t, yardstick->tiles[e]);
    }
}

/// N where N x N rays are `rays` and supersampling has as many; else 0.
unsigned side_of(unsigned rays) {
    const auto side = unsigned(std::lround(std::sqrt(rays)));
    return side * side == rays && side <= 16 ? side : 0;
}

class Run {
  public:
    Run(const SubpixelPlan& plan, const std::vector<SubpixelDisplay>& displays, const std::string& scene,
        SubpixelSource& source, const std::function<bool(const std::string&)>& go_on,
        std::vector<SubpixelRow>& rows)
        : plan_(plan),
          displays_(displays),
          scene_(scene),
          source_(source),
          go_on_(go_on),
          rows_(rows),
          sight_{scene,
                 source.samples(),
                 *std::max_element(plan.rays.begin(), plan.rays.end()),
                 source.reference(),
                 {}} {
        for (const SubpixelDisplay& d : displays)
            metrics_.emplace_back(d.view.panel, d.view.ppd, source.reference(), source.samples());
    }

    /// All methods; false: to stop.
    bool compare(unsigned rays) {
        std::vector<std::vector<SubpixelMethod>> methods;
        for (const SubpixelDisplay& d : displays_) {
            methods.emplace_back();
            if (const unsigned side = side_of(rays)) methods.back().push_back(supersampling(side));
            for (const SubpixelMethod& m : d.methods)
                if (!m.adaptive || source_.adapts()) methods.back().push_back(m);
        }
        return score(methods, rays, true);
    }

    /// Supersampling that compare() had not.
    bool supersample() {
        for (unsigned side = 1; side <= 8; ++side) {
            if (std::count(plan_.rays.begin(), plan_.rays.end(), side * side)) continue;
            const std::vector<std::vector<SubpixelMethod>> methods(displays_.size(), {supersampling(side)});
            if (!score(methods, side * side, false)) return false;
        }
        return true;
    }

    const SubpixelSight& sight() const { return sight_; }

  private:
    bool score(const std::vector<std::vector<SubpixelMethod>>& methods, unsigned rays, bool with_yardstick) {
        std::vector<std::vector<Scored>> all(displays_.size());
        for (std::size_t d = 0; d < displays_.size(); ++d)
            for (const SubpixelMethod& m : methods[d]) all[d].push_back({m.name, rays, 0, 0, {}});
        // Programs are compiled, and devices woken, before anything is timed.
        for (const auto& of_display : methods)
            for (const SubpixelMethod& m : of_display)
                if (warm_.insert(m.name).second) source_.shoot(m, 1, plan_.seed);
        for (unsigned repetition = 0; repetition < plan_.repetitions; ++repetition) {
            source_.forget();
            for (std::size_t d = 0; d < displays_.size(); ++d) {
                for (std::size_t m = 0; m < methods[d].size(); ++m) {
                    const SubpixelShot shot = source_.shoot(methods[d][m], rays, plan_.seed + repetition);
                    all[d][m].add(shot, metrics_[d], plan_.repetitions);
                    const std::string& name = methods[d][m].name;
                    if (with_yardstick && d == 0 && repetition == 0 && rays == sight_.rays &&
                        (name == "box" || name == "displaced" || name == subpixel_yardstick))
                        sight_.drives.emplace_back(name, shot.drives);
                }
                const PanelView& view = displays_[d].view;
                if (!go_on_(format("%s, %u rays per pixel, repetition %u: %s at %g pixels per degree",
                                   scene_.c_str(), rays, repetition + 1, view.panel.name.c_str(), view.ppd)))
                    return false;
            }
        }
        for (std::size_t d = 0; d < displays_.size(); ++d) {
            const auto yardstick = std::find_if(
                all[d].begin(), all[d].end(), [](const Scored& s) { return s.method == subpixel_yardstick; });
            for (const Scored& s : all[d])
                add_rows(s, with_yardstick && yardstick != all[d].end() ? &*yardstick : nullptr, scene_,
                         displays_[d].view, rows_);
        }
        return true;
    }

    const SubpixelPlan& plan_;
    const std::vector<SubpixelDisplay>& displays_;
    const std::string& scene_;
    SubpixelSource& source_;
    const std::function<bool(const std::string&)>& go_on_;
    std::vector<SubpixelRow>& rows_;
    std::deque<TileMetric> metrics_;  // they cannot be moved
    std::set<std::string> warm_;      ///< methods that ran
    SubpixelSight sight_;
};

}  // namespace

bool is_compared(const SubpixelRow& row) { return row.over_triad && row.method != subpixel_adaptive; }
bool beats_triad(const SubpixelRow& row) { return row.over_triad && row.over_triad->high < 0; }

SubpixelDisplay subpixel_display(const PanelView& view) {
    SubpixelDisplay display{view, {}};
    const auto add = [&](const std::string& name, ReconstructionChoice choice, bool for_panel) {
        if (for_panel) choice.panel = view;
        try {
            display.methods.push_back({name, reconstruction_of(choice)});
        } catch (const Error& error) {
            if (error.exit() != Exit::usage) throw;  // not for this panel
        }
    };
    for (const char* name : {"centre", "pane:4", "pane-encoded:4"}) add(name, {.method = name}, false);
    for (const std::string& name : filter_names())
        add(name, {.filter = parse_filter(name), .bins = uvec2(3)}, false);
    for (const char* name : {"subpixel3", "displaced", "platt", "platt:3", "random3", "random3:shared"})
        add(name, {.method = name}, true);
    add("triad-unrefined", {.method = "triad", .refine_steps = 0}, true);
    add(subpixel_yardstick, {.method = "triad"}, true);
    display.methods.push_back({subpixel_adaptive, display.methods.back().how, true});
    return display;
}

SubpixelMethod supersampling(unsigned side) {
    const std::string name = format("ssaa:%u", side);
    return {name, reconstruction_of({.method = name})};
}

void run_subpixel(const SubpixelPlan& plan, const std::vector<SubpixelSubject>& subjects,
                  const std::function<bool(const std::string&)>& go_on, std::vector<SubpixelRow>& rows,
                  std::vector<SubpixelSight>& sights) {
    std::vector<SubpixelDisplay> displays;
    for (const PanelView& view : plan.displays) displays.push_back(subpixel_display(view));
    for (const SubpixelSubject& subject : subjects) {
        inform("Scene " + subject.name);
        const auto source = subject.make();
        Run run(plan, displays, subject.name, *source, go_on, rows);
        for (const unsigned rays : plan.rays)
            if (!run.compare(rays)) return;
        sights.push_back(run.sight());
        if (!run.supersample()) return;
    }
}

}  // namespace triad
