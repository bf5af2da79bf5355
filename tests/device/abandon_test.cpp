// A render that is stopped between two launches, or shown to someone there, is the picture that it would have
// been.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"
#include "render/renderer.h"
#include "same_film.h"

namespace triad {
namespace {

constexpr SampleRange all{0, 6};

RenderSettings settings_of_several_launches() {
    RenderSettings settings = analytic::varied_settings();
    settings.width = 320, settings.height = 240;
    return settings;
}

bool keep_going(const Progress&) { return true; }

Film undisturbed(const Scene& scene) {
    Renderer renderer(test_device(), scene, settings_of_several_launches());
    renderer.render_until({.samples = all, .follow = false}, keep_going);
    return renderer.film();
}

TEST(Abandon, a_render_goes_on_from_wherever_it_stopped) {
    const Scene scene = analytic::varied_scene();
    Renderer renderer(test_device(), scene, settings_of_several_launches());
    unsigned stops = 0;
    for (unsigned launches = 0;; ++launches) {
        unsigned asked = 0;
        const RenderResult result = renderer.render_until(
            {.samples = all, .follow = false, .abandon = [&] { return asked++ > launches; }}, keep_going);
        if (result.stop != Stop::interrupt) break;
        ++stops;
    }
    EXPECT_GT(stops, 2u);
    expect_same_bytes(undisturbed(scene), renderer.film(), "stopped between launches");
}

TEST(Abandon, who_looks_on_is_shown_the_film_when_it_is_wanted) {
    const Scene scene = analytic::varied_scene();
    Renderer renderer(test_device(), scene, settings_of_several_launches());
    unsigned asked = 0, shown = 0;
    std::uint64_t samples = 0;
    RenderGoal goal{.samples = all, .follow = false};
    bool wanted = false;
    goal.keep.wanted = [&] { return wanted |= ++asked % 3 == 0; };
    goal.keep.write = [&](const Film& film) {
        const std::uint64_t total = film.sample_numbers().total;
        EXPECT_GE(total, samples);
        samples = total, ++shown, wanted = false;
    };
    renderer.render_until(goal, keep_going);
    EXPECT_GT(shown, 0u);
    expect_same_bytes(undisturbed(scene), renderer.film(), "looked at");
}

}  // namespace
}  // namespace triad
