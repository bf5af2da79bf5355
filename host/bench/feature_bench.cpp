#include "bench/feature_bench.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "bench/feature_scenes.h"
#include "kernels/types.h"
#include "render/renderer.h"

namespace triad {
namespace {

/// A renderer whose runs are timed in turn with those of others.
class Program {
  public:
    Program(Device& device, const FeatureScene& s, const std::optional<Features>& features = {})
        : renderer_(device, s.scene, s.settings, features), pixels_(s.settings.width * s.settings.height) {}

    void run(std::uint32_t seed, std::uint64_t samples) {
        renderer_.restart(seed);
        const RenderResult result =
            renderer_.render_until({.samples = {0, samples}}, [](const Progress&) { return true; });
        seconds_.push_back(result.seconds);
        film_ = renderer_.film();
        rays_per_sample_ = double(film_->counters[COUNTER_RAYS]) / (double(pixels_) * double(samples));
    }

    const Film& film() const { return *film_; }
    const Features& features() const { return renderer_.features(); }

    FeatureRun against(const Program& base) const {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < seconds_.size(); ++i) ratios.push_back(seconds_[i] / base.seconds_[i]);
        return {renderer_.compile_seconds(), median(seconds_), rays_per_sample_, median_estimate(ratios)};
    }

  private:
    Renderer renderer_;
    double pixels_;
    std::vector<double> seconds_;
    double rays_per_sample_ = 0;
    std::optional<Film> film_;
};

FeatureCost measure(Device& device, const FeatureBenchPlan& plan, const FeatureScene& without,
                    const FeatureOption* feature, const FeatureScene* with) {
    Program left_out(device, without);
    Features on = left_out.features();
    if (feature)
        on.*feature->member = true;
    else
        on = Features{};
    Program unused(device, without, on);
    std::optional<Program> used;
    if (with) used.emplace(device, *with);
    std::vector<Program*> programs = {&left_out, &unused};
    if (used) programs.push_back(&*used);
    for (unsigned r = 0; r < plan.repetitions; ++r) {
        // Who comes first gains or loses by what ran before: everybody does once.
        std::rotate(programs.begin(), programs.begin() + 1, programs.end());
        for (Program* p : programs) p->run(r, plan.samples);
    }
    FeatureCost cost;
    cost.feature = feature ? feature->words() : "all";
    cost.left_out = left_out.against(left_out);
    cost.unused = unused.against(left_out);
    if (used) cost.used = used->against(left_out);
    cost.same_bits = left_out.film().sums == unused.film().sums;
    return cost;
}

}  // namespace

EmptyCaches::EmptyCaches() {
    for (const char* name : {"XDG_CACHE_HOME", "POCL_CACHE_DIR"}) ::setenv(name, folder_.path().c_str(), 1);
}

std::vector<FeatureCost> measure_features(Device& device, const FeatureBenchPlan& plan,
                                          const std::function<bool(const FeatureCost&)>& report) {
    std::vector<FeatureCost> costs;
    const auto add = [&](const FeatureScene& without, const FeatureOption* feature,
                         const FeatureScene* with) {
        costs.push_back(measure(device, plan, without, feature, with));
        return report(costs.back());
    };
    const std::vector<FeatureCase> cases = feature_cases(plan.size);
    for (const FeatureCase& c : cases)
        if (!add(c.without, &c.feature, &c.with)) return costs;
    add(cases.front().without, nullptr, nullptr);
    return costs;
}

}  // namespace triad
