#include "bench/subpixel_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/colour.h"
#include "base/text.h"
#include "display/perceived_sets.h"

namespace triad {
namespace {

/// Of one scene, ready for more rays: rays by a panel's filter need one for each display.
constexpr std::size_t most_renderers = 64;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RgbImage rgb_of(unsigned width, unsigned height, const std::vector<float>& rgba) {
    RgbImage image{width, height, std::vector<float>(std::size_t(width) * height * 3)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
        image.rgb[i] = std::clamp(rgba[i / 3 * 4 + i % 3], 0.0f, 1.0f);
    return image;
}

class RenderedSource : public SubpixelSource {
  public:
    RenderedSource(Device& device, const RenderedView& view) : device_(device), view_(view) {
        RenderSettings large = view.settings;
        large.width *= view.samples, large.height *= view.samples;
        large.seed = view.settings.seed + 0x5eed;
        Renderer renderer(device, *view.scene, large);
        renderer.render({0, view.reference_spp}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        reference_ = rgb_of(film.width, film.height, resolve_display(device, film, display()));
    }

    const RgbImage& reference() const override { return reference_; }
    unsigned samples() const override { return view_.samples; }
    bool adapts() const override { return true; }
    void forget() override { films_.clear(); }

    SubpixelShot shoot(const SubpixelMethod& method, unsigned rays, std::uint32_t seed) override {
        const std::uint64_t spp = whole_bins(rays, method.how.bins_x * method.how.bins_y);
        const Shared& shared = film_of(method, spp, seed);
        DisplaySettings settings = display();
        apply(method.how, settings);
        const double start = now();
        const auto rgba = resolve_display(device_, shared.film, settings);
        return {shown_in_8_bits(shared.film.width, shared.film.height, rgba),
                shared.film.sample_numbers().mean, shared.seconds + now() - start};
    }

  private:
    struct Shared {
        Film film;
        double seconds = 0;
    };

    DisplaySettings display() const {
        DisplaySettings settings;
        settings.exposure_ev = view_.exposure_ev, settings.tone_map = view_.tone_map, settings.alpha = false;
        return settings;
    }

    /// Methods with the same rays share the film of a seed.
    const Shared& film_of(const SubpixelMethod& method, std::uint64_t spp, std::uint32_t seed) {
        RenderSettings settings = view_.settings;
        apply(method.how, settings);
        const std::string rays = text_of(settings);
        std::string key = rays + " " + std::to_string(spp) + " " + std::to_string(seed);
        if (method.adaptive)
            key += format(" adaptive %s %g", method.how.panel->panel.name.c_str(), method.how.panel->ppd);
        if (const auto found = films_.find(key); found != films_.end()) return found->second;
        if (renderers_.size() >= most_renderers) renderers_.clear();
        auto& renderer = renderers_[rays];
        if (!renderer) renderer = std::make_unique<Renderer>(device_, *view_.scene, settings);
        renderer->restart(seed);
        RenderGoal goal;
        goal.samples = {0, spp}, goal.adaptive = method.adaptive, goal.follow = false;
        if (method.adaptive && method.how.panel) {
            DisplaySettings shown = display();
            apply(method.how, shown);
            goal.set_errors = perceived_sets(device_, *method.how.panel, shown);
        }
        const RenderResult result = renderer->render_until(goal, [](const Progress&) { return true; });
        return films_[key] = {renderer->film(), result.seconds};
    }

    Device& device_;
    const RenderedView view_;
    RgbImage reference_;
    std::map<std::string, std::unique_ptr<Renderer>> renderers_;
    std::map<std::string, Shared> films_;
};

}  // namespace

RgbImage shown_in_8_bits(unsigned width, unsigned height, const std::vector<float>& rgba) {
    RgbImage image{width, height, std::vector<float>(std::size_t(width) * height * 3)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        const double encoded = srgb_encode(std::clamp(double(rgba[i / 3 * 4 + i % 3]), 0.0, 1.0));
        image.rgb[i] = float(srgb_decode(std::round(encoded * 255) / 255));
    }
    return image;
}

std::unique_ptr<SubpixelSource> rendered_source(Device& device, const RenderedView& view) {
    return std::make_unique<RenderedSource>(device, view);
}

}  // namespace triad
