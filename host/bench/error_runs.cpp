#include "bench/error_runs.h"

#include <algorithm>
#include <map>
#include <memory>

#include "base/error.h"
#include "bench/error_curves.h"
#include "bench/error_reference.h"
#include "kernels/types.h"
#include "metric/flip.h"

namespace triad {
namespace {

/// One setting on the scene at hand.
struct Lane {
    ErrorCase what;
    std::shared_ptr<const RenderedReference> reference;
    std::unique_ptr<Renderer> renderer;
    std::vector<std::uint64_t> budgets;
    ErrorCurve curve;
    TileMeans tiles;  ///< of the last budgets
};

std::vector<std::uint64_t> budgets_up_to(std::uint64_t spp) {
    std::vector<std::uint64_t> budgets;
    for (std::uint64_t n = 1; n < spp; n *= 2) budgets.push_back(n);
    budgets.push_back(spp);
    return budgets;
}

class Runs {
  public:
    Runs(const ErrorPlan& plan, const ErrorScene& scene, const ErrorBenchHost& host, ErrorBench& bench)
        : plan_(plan), scene_(scene), host_(host), bench_(bench) {}

    /// False: stopped.
    bool run(const Scene& scene, std::vector<ErrorCase> cases) {
        std::map<std::string, std::shared_ptr<const RenderedReference>> references;
        for (ErrorCase& c : cases) {
            const ErrorCase& like = plan_.own_references ? c : cases.front();
            auto& reference = references[reference_key(scene, reference_settings(like.settings))];
            if (!reference) {
                auto rendered = render_reference(scene, like, plan_.reference_spp, host_);
                if (!rendered) return false;
                reference = std::make_shared<const RenderedReference>(std::move(*rendered));
            }
            lanes_.push_back({c,
                              reference,
                              std::make_unique<Renderer>(*c.device, scene, c.settings),
                              budgets_up_to(plan_.spp),
                              {scene_.name, c.setting.name},
                              {}});
            Lane& lane = lanes_.back();
            const Film film = lane.renderer->film();
            if (film.width != reference->display.width || film.height != reference->display.height)
                throw Error(Exit::usage, "The pictures of the settings " + cases.front().setting.name +
                                             " and " + c.setting.name +
                                             " differ in size, so that they have no error in common.");
            // The first launches find their size; they are not measured.
            lane.renderer->render({0, 1}, [&](const Progress&) { return host_.go_on(); });
        }
        add_scene();
        const bool complete = repetitions();
        for (Lane& lane : lanes_) {
            lane.curve.verdict = "Not tested: that takes a run to its end, of two samples or more";
            if (lane.tiles.films > 0) {
                const MeanTest test = test_means(lane.tiles, lane.reference->tiles);
                lane.curve.right = test.same, lane.curve.verdict = test.sentence;
            }
            bench_.curves.push_back(std::move(lane.curve));
        }
        return complete;
    }

  private:
    const ErrorPlan& plan_;
    const ErrorScene& scene_;
    const ErrorBenchHost& host_;
    ErrorBench& bench_;
    std::vector<Lane> lanes_;

    void add_scene() {
        const RenderedReference& r = *lanes_.front().reference;
        ErrorScene& s = bench_.scenes.emplace_back(scene_);
        s.reference = r.reference.mean, s.reference_display = r.display;
        s.reference_spp = r.reference.spp, s.reference_relmse = r.reference.relmse;
        s.reference_seconds = r.seconds;
    }

    bool repetitions() {
        for (unsigned repetition = 0; repetition < plan_.repetitions; ++repetition)
            for (std::size_t i = 0; i < lanes_.size(); ++i)  // no setting is always the first
                if (!run(lanes_[(i + repetition) % lanes_.size()], repetition)) return false;
        return true;
    }

    /// One repetition of one setting.
    bool run(Lane& lane, unsigned repetition) {
        Renderer& renderer = *lane.renderer;
        const std::uint32_t seed = plan_.seed + repetition;
        renderer.restart(seed);
        std::uint64_t have = 0;
        double seconds = 0;
        for (std::size_t i = 0; i < lane.budgets.size(); ++i) {
            const std::uint64_t budget = lane.budgets[i];
            if (lane.what.adaptive)
                renderer.restart(seed), have = 0, seconds = 0;  // its decisions need all rounds
            const RenderResult result = renderer.render_until(
                {.samples = {have, budget}, .adaptive = lane.what.adaptive, .follow = false},
                [&](const Progress&) { return host_.go_on(); });
            if (result.stop == Stop::interrupt) return false;
            have = budget;
            seconds += result.seconds;
            // Repetition 0 finds how far the time reaches; all others go as far, so that every budget has
            // them all.
            const double next = i + 1 < lane.budgets.size() ? double(lane.budgets[i + 1]) : double(budget);
            if (repetition == 0 && plan_.seconds > 0 && seconds * next / double(budget) > plan_.seconds)
                lane.budgets.resize(i + 1);
            measure(lane, repetition, seed, seconds, i + 1 == lane.budgets.size());
        }
        host_.on_run(bench_.runs.back());
        return true;
    }

    void measure(Lane& lane, unsigned repetition, std::uint32_t seed, double seconds, bool last) {
        const Film film = lane.renderer->film();
        const RenderedReference& reference = *lane.reference;
        RgbImage picture = picture_of(film), display = lane.what.display(*lane.what.device, film);
        std::vector<float> flip = flip_map(display, reference.display);
        const PictureError error = picture_error(picture.rgb, reference.reference);
        bench_.runs.push_back({.scene = scene_.name,
                               .setting = lane.what.setting.name,
                               .repetition = repetition,
                               .seed = seed,
                               .spp = film.sample_numbers().mean,
                               .seconds = seconds,
                               .rays = film.counters[COUNTER_RAYS],
                               .mse = error.mse,
                               .relmse = error.relmse,
                               .reference_relmse = reference.reference.relmse,
                               .relmse_trimmed = error.relmse_trimmed,
                               .flip = mean_flip(flip),
                               .fireflies = error.fireflies,
                               .nan = film.counters[COUNTER_NOT_FINITE]});
        if (last && !mean_variance(film).empty()) lane.tiles.add(film);
        if (repetition > 0) return;
        lane.curve.rel_error = relative_difference(picture.rgb, reference.reference);
        lane.curve.picture = std::move(picture), lane.curve.display = std::move(display);
        lane.curve.flip_map = std::move(flip);
    }
};

}  // namespace

bool run_errors(const ErrorPlan& plan, const ErrorScene& name, const Scene& scene,
                std::vector<ErrorCase> cases, const ErrorBenchHost& host, ErrorBench& bench) {
    return Runs(plan, name, host, bench).run(scene, std::move(cases));
}

void fit_curves(ErrorBench& bench) {
    std::vector<ErrorCurve> curves = curves_of(bench.runs);
    for (ErrorCurve& curve : curves)
        for (ErrorCurve& measured : bench.curves) {
            if (measured.scene != curve.scene || measured.setting != curve.setting) continue;
            curve.right = measured.right, curve.verdict = std::move(measured.verdict);
            curve.picture = std::move(measured.picture), curve.display = std::move(measured.display);
            curve.rel_error = std::move(measured.rel_error), curve.flip_map = std::move(measured.flip_map);
        }
    // Rows come in the order of the runs, and no setting is always the first.
    const auto place = [&](const ErrorCurve& c) {
        std::size_t scene = 0, setting = 0;
        while (bench.scenes[scene].name != c.scene) ++scene;
        while (bench.settings[setting].name != c.setting) ++setting;
        return std::pair(scene, setting);
    };
    std::sort(curves.begin(), curves.end(),
              [&](const ErrorCurve& a, const ErrorCurve& b) { return place(a) < place(b); });
    bench.curves = std::move(curves);
}

}  // namespace triad
