// A render that is stopped between two launches, or shown to someone there, is the picture that it would have
// been.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

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

/// Twice the device at hand.
class TwoDevices {
  public:
    std::vector<Device*> all() { return {&first_, &second_}; }

  private:
    Device first_ = again(), second_ = again();

    static Device again() { return Device::open({.selector = std::to_string(test_device().info().index)}); }
};

/// A lamp above a ball of glass, whose caustic photons bring.
Scene caustic() {
    analytic::Builder b;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), analytic::lambert(0.7f));
    b.add(shapes::lat_long_sphere({0, 0.6f, 0}, 0.5f, 24, 12), analytic::glass(1.5f));
    b.add(shapes::quad({-0.5f, 2.2f, -0.5f}, {1, 0, 0}, {0, 0, 1}), analytic::emitter(6.0f));
    validate(b.scene);
    return b.scene;
}

RenderSettings by_photons() {
    RenderSettings settings;
    settings.width = 160, settings.height = 120;
    settings.integrator = Integrator::photons;
    settings.photons = 5000;
    settings.view = look_at({0.4, 1.5, 3.6}, {0, 0.5, 0}, 0.8, 64.0 / 48);
    return settings;
}

TEST(Abandon, several_devices_leave_samples_with_photons_in_their_middle) {
    const Scene scene = caustic();
    TwoDevices devices;
    Renderer renderer(devices.all(), scene, by_photons());
    for (const unsigned most : {3u, 17u}) {
        std::atomic<unsigned> asked = 0;
        const RenderResult result = renderer.render_until(
            {.samples = {0, 200}, .follow = false, .abandon = [&] { return asked++ > most; }}, keep_going);
        EXPECT_EQ(result.stop, Stop::interrupt);
        for (const DeviceWork& work : result.devices) EXPECT_EQ(work.failure, "");
        renderer.restart(by_photons().seed);
    }
    renderer.render_until({.samples = all, .follow = false}, keep_going);
    Renderer alone(test_device(), scene, by_photons());
    alone.render_until({.samples = all, .follow = false}, keep_going);
    expect_same_bytes(alone.film(), renderer.film(), "after what was abandoned");
}

TEST(Abandon, who_says_stop_within_a_pass_is_asked_by_the_thread_that_renders_and_not_again) {
    const std::thread::id here = std::this_thread::get_id();
    const Scene scene = analytic::varied_scene();
    TwoDevices devices;
    Renderer shared(devices.all(), scene, settings_of_several_launches());
    Renderer alone(test_device(), scene, settings_of_several_launches());
    for (Renderer* renderer : {&shared, &alone}) {
        unsigned calls = 0, elsewhere = 0;
        double samples = 0;
        renderer->render_until({.samples = {0, 256}, .follow = false, .report_seconds = 0},
                               [&](const Progress& progress) {
                                   elsewhere += std::this_thread::get_id() != here;
                                   ++calls, samples = progress.samples;
                                   return false;
                               });
        EXPECT_EQ(calls, 1u);
        EXPECT_EQ(elsewhere, 0u);
        const SampleNumbers numbers = renderer->film().sample_numbers();
        EXPECT_EQ(numbers.least, numbers.most) << "the pass is ended";
        EXPECT_LT(numbers.most, 256u);
        if (renderer == &alone) {
            EXPECT_LT(samples, numbers.mean);
        }
    }
}

}  // namespace
}  // namespace triad
