// Renders that end at an error or a time: their samples are those of every other render.
#include <gtest/gtest.h>

#include <functional>

#include "analytic/analytic_scene.h"
#include "base/parallel_for.h"
#include "display/perceived_sets.h"
#include "same_film.h"

namespace triad {
namespace {

Film render_to(Device& device, const RenderSettings& settings, const RenderGoal& goal) {
    Scene scene = analytic::varied_scene();
    validate(scene);
    Renderer renderer(device, scene, settings);
    renderer.render_until(goal, [](const Progress&) { return true; });
    return renderer.film();
}

/// Every pixel of the film holds the very samples that an even render of as many has.
void expect_first_samples(const RenderSettings& settings, const Film& film) {
    const std::size_t bins = film.bins();
    for (const std::uint32_t n : {film.sample_numbers().least, film.sample_numbers().most}) {
        const Film even = render_to(test_device(), settings, {.samples = {0, n}});
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            if (film.samples[p] != n) continue;
            for (std::size_t i = 0; i < 4 * bins; ++i)
                ASSERT_EQ(film.sums[p * 4 * bins + i], even.sums[p * 4 * bins + i]) << p;
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_EQ(film.half_sums[p * 3 + c], even.half_sums[p * 3 + c]) << p;
        }
    }
}

/// Renders on every size of work-group and on one thread are equal. `goal_on`: for a device.
void expect_same_everywhere(const std::function<RenderGoal(Device&)>& goal_on) {
    Device& device = test_device();
    const std::size_t before = device.preferred_local();
    const Film whole = render_to(device, analytic::varied_settings(), goal_on(device));
    EXPECT_FALSE(whole.is_even());
    for (std::size_t local : {1, 8, 64}) {
        device.set_preferred_local(local);
        expect_same_bytes(whole, render_to(device, analytic::varied_settings(), goal_on(device)),
                          "local size " + std::to_string(local));
    }
    device.set_preferred_local(before);
    if (device.info().type != "cpu") return;
    const char* selector = std::getenv("TRIAD_TEST_DEVICE");
    Device one = Device::open({.selector = selector ? selector : "", .threads = 1});
    set_host_threads(1);
    expect_same_bytes(whole, render_to(one, analytic::varied_settings(), goal_on(one)), "one thread");
    set_host_threads(0);
}

TEST(RenderGoal, an_error_is_reached_by_the_same_samples_on_every_work_group_size_and_thread) {
    expect_same_everywhere([](Device&) {
        return RenderGoal{.samples = {0, 10000}, .error = 0.1, .adaptive = true};
    });
}

TEST(RenderGoal, perceived_error_sends_samples_alike_on_every_work_group_size_and_thread) {
    expect_same_everywhere([](Device& device) {
        RenderGoal goal{.samples = {0, 40}, .adaptive = true};
        goal.set_errors = perceived_sets(device, {*builtin_panel("rgb"), 45}, {});
        return goal;
    });
}

TEST(RenderGoal, a_pixel_with_n_samples_holds_the_first_n_however_it_came_to_them) {
    for (const unsigned bins : {1u, 2u}) {
        RenderSettings settings = analytic::varied_settings();
        settings.bins_x = bins;
        const Film film = render_to(test_device(), settings, {.samples = {0, 40}, .adaptive = true});
        ASSERT_FALSE(film.is_even());
        EXPECT_NEAR(film.sample_numbers().mean, 40, 1);
        expect_first_samples(settings, film);
    }
}

TEST(RenderGoal, an_even_render_that_time_ends_within_a_sample_has_one_more_of_some_pixels) {
    RenderSettings settings = analytic::varied_settings();
    settings.width = settings.height = 512;
    settings.bins_x = 2;
    const Film film = render_to(test_device(), settings, {.samples = {0, 4096}, .seconds = 0.7});
    const SampleNumbers n = film.sample_numbers();
    EXPECT_GE(n.least, 2u);
    EXPECT_LE(n.most, n.least + 2);
    expect_first_samples(settings, film);
}

TEST(RenderGoal, photons_of_a_sample_that_time_cuts_count_in_its_pixels_alone) {
    RenderSettings settings = analytic::varied_settings();
    settings.width = settings.height = 400;
    settings.integrator = Integrator::photons;
    settings.photons = 200000;
    const Film film = render_to(test_device(), settings, {.samples = {0, 4096}, .seconds = 0.9});
    const SampleNumbers n = film.sample_numbers();
    EXPECT_LE(n.most, n.least + 1);
    const Film even = render_to(test_device(), settings, {.samples = {0, n.least}});
    double light = 0, more = 0, as_even = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::size_t c = 0; c < 3; ++c) {
            const double extra = double(film.sums[p * 4 + c] - even.sums[p * 4 + c]);
            if (film.samples[p] == n.least) {
                ASSERT_EQ(extra, 0) << p;
            } else {
                light += extra, as_even += double(even.sums[p * 4 + c]) / n.least, ++more;
            }
        }
    if (more > 30000) {  // a slow device ends after whole samples
        EXPECT_NEAR(light / as_even, 1.0, 0.1);
    }
}

TEST(RenderGoal, a_time_that_ends_within_a_pass_leaves_a_film_that_counts_right) {
    const RenderSettings settings = analytic::varied_settings();
    Scene scene = analytic::varied_scene();
    validate(scene);
    Renderer renderer(test_device(), scene, settings);
    const RenderResult result = renderer.render_until(
        {.samples = {0, 1u << 20}, .seconds = 0.5, .adaptive = true}, [](const Progress&) { return true; });
    const Film film = renderer.film();
    EXPECT_EQ(result.stop, Stop::time);
    ASSERT_EQ(film.ranges.size(), 1u);
    EXPECT_EQ(film.ranges[0].end, film.sample_numbers().least);
    EXPECT_EQ(film.ranges[0], result.range);
}

}  // namespace
}  // namespace triad
