// What is known about error: it falls with the square root of independent samples, faster with Sobol's, and
// the noise of a reference is not the picture's.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/error_curves.h"
#include "bench/error_experiment.h"
#include "display/resolve.h"
#include "lit_room.h"

namespace triad::analytic {
namespace {

RgbImage plain(const Film& film) {
    const std::vector<float> rgba = resolve_linear(film);
    RgbImage image{film.width, film.height, {}};
    for (std::size_t p = 0; p < film.pixels(); ++p)
        image.rgb.insert(image.rgb.end(), &rgba[4 * p], &rgba[4 * p] + 3);
    return image;
}

/// References in memory.
struct Kept {
    std::map<std::string, Film> films;
    unsigned rendered = 0;

    ErrorBenchHost host() {
        return {[this](const std::string& key) {
                    const auto film = films.find(key);
                    return film == films.end() ? std::nullopt : std::optional(film->second);
                },
                [this](const std::string& key, const Film& film) { films[key] = film, ++rendered; },
                [](const Progress&, double) { return true; }, [] { return true; }, [](const ErrorRun&) {}};
    }
};

ErrorCase make_case(const std::string& name, const View& view, unsigned size) {
    ErrorCase c;
    c.setting.name = name;
    c.device = &test_device();
    c.settings.width = c.settings.height = size;
    c.settings.view = view;
    c.display = [](Device&, const Film& film) { return plain(film); };
    return c;
}

ErrorBench bench(const ErrorPlan& plan, Scene scene, const std::vector<ErrorCase>& cases, Kept& kept) {
    validate(scene);
    ErrorBench bench;
    for (const ErrorCase& c : cases) bench.settings.push_back(c.setting);
    ErrorScene name;
    name.name = "scene";
    EXPECT_TRUE(run_errors(plan, name, scene, cases, kept.host(), bench));
    fit_curves(bench);
    return bench;
}

/// Light that is smooth over pixel, direction and light: a wall under a large square lamp.
Scene smooth_scene() {
    Builder b;
    b.add(square(0, true, 2), lambert(0.5f));
    b.add(square(1.5, false, 0.6), emitter(4.0f));
    return b.scene;
}

TEST(ErrorBench, independent_samples_have_a_slope_of_one_half_and_sobols_a_steeper_one) {
    std::vector<ErrorCase> cases(2, make_case("sobol", orthographic({0, 0, 0}, {0, -1, 0}, 0.5, 1.0), 48));
    for (ErrorCase& c : cases) c.settings.max_depth = 2;  // direct light
    cases[1].setting.name = "independent";
    cases[1].settings.independent = true;
    Kept kept;
    const ErrorBench b =
        bench({.spp = 128, .repetitions = 5, .reference_spp = 2048}, smooth_scene(), cases, kept);
    ASSERT_EQ(b.curves.size(), 2u);
    const ErrorCurve &sobol = b.curves[0], &independent = b.curves[1];
    ASSERT_EQ(independent.points.size(), 8u);
    ASSERT_TRUE(independent.slope && sobol.slope);
    EXPECT_NEAR(independent.slope->value, -0.5, 0.05);
    EXPECT_LE(independent.slope->low, -0.5);
    EXPECT_GE(independent.slope->high, -0.5);
    EXPECT_LT(sobol.slope->high, -0.6);
    EXPECT_TRUE(b.right()) << sobol.verdict << "\n" << independent.verdict;
    EXPECT_LT(sobol.points.back().relmse.value, 0.5 * independent.points.back().relmse.value);
}

TEST(ErrorBench, the_noise_of_the_reference_does_not_count) {
    // The variance of the first reference is greater than the error that is measured, and still the same
    // comes out. One reference is common to all runs: what the product of its halves is off by, 2304 pixels
    // average out.
    const std::vector<ErrorCase> cases = {make_case("default", room_view(), 48)};
    const auto measure = [&](std::uint64_t reference_spp) {
        Kept kept;
        const ErrorPlan plan{.spp = 32, .repetitions = 8, .reference_spp = reference_spp};
        return bench(plan, lit_room(1, false), cases, kept);
    };
    const ErrorBench poor = measure(16), fair = measure(128), good = measure(2048);
    EXPECT_LT(good.scenes[0].reference_relmse, 0.05 * good.curves[0].points.back().relmse.value);
    const auto ratio = [&](const ErrorBench& b, auto value) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < b.runs.size(); ++i)
            if (b.runs[i].spp == 32) ratios.push_back(value(b.runs[i]) / value(good.runs[i]));
        EXPECT_EQ(ratios.size(), 8u);
        return median(ratios);
    };
    const auto mse = [](const ErrorRun& r) { return r.mse; };
    const auto relmse = [](const ErrorRun& r) { return r.relmse; };
    EXPECT_NEAR(ratio(poor, mse), 1, 0.15);
    EXPECT_NEAR(ratio(fair, mse), 1, 0.05);
    EXPECT_NEAR(ratio(fair, relmse), 1, 0.1);  // whose weights have the reference's noise too
    // What would come out if it were not subtracted.
    EXPECT_GT(poor.scenes[0].reference_relmse, good.curves[0].points.back().relmse.value);
    EXPECT_GT(fair.scenes[0].reference_relmse, 0.15 * good.curves[0].points.back().relmse.value);
}

TEST(ErrorBench, references_are_kept_reused_and_rendered_on) {
    std::vector<ErrorCase> cases = {make_case("default", room_view(), 16)};
    Kept kept;
    ErrorPlan plan{.spp = 2, .repetitions = 1, .reference_spp = 8};
    bench(plan, lit_room(1, false), cases, kept);
    EXPECT_EQ(kept.rendered, 1u);
    cases[0].settings.seed = 5, cases[0].settings.roulette = 1, cases[0].settings.bins_x = 2;
    cases[0].settings.independent = true;  // nothing that changes what is expected
    plan.reference_spp = 6;
    EXPECT_EQ(bench(plan, lit_room(1, false), cases, kept).scenes[0].reference_spp, 8);
    EXPECT_EQ(kept.rendered, 1u);
    plan.reference_spp = 31;  // two equal halves need 32
    bench(plan, lit_room(1, false), cases, kept);
    EXPECT_EQ(kept.rendered, 2u);
    ASSERT_EQ(kept.films.size(), 1u);
    Kept fresh;
    bench(plan, lit_room(1, false), cases, fresh);
    EXPECT_EQ(kept.films.begin()->second.sums, fresh.films.begin()->second.sums);
    EXPECT_EQ(kept.films.begin()->second.ranges, (std::vector<SampleRange>{{0, 32}}));
    cases[0].settings.max_depth = 3;
    bench(plan, lit_room(1, false), cases, kept);
    EXPECT_EQ(kept.films.size(), 2u);
}

TEST(ErrorBench, a_wrong_picture_is_found) {
    std::vector<ErrorCase> cases(2, make_case("all light", room_view(), 48));
    cases[1].setting.name = "no fifth bounce";
    cases[1].settings.max_depth = 5;
    Kept kept;
    ErrorPlan plan{.spp = 64, .repetitions = 3, .reference_spp = 1024};
    const ErrorBench b = bench(plan, lit_room(1, false), cases, kept);
    EXPECT_TRUE(b.curves[0].right) << b.curves[0].verdict;
    EXPECT_FALSE(b.curves[1].right) << b.curves[1].verdict;
    EXPECT_FALSE(b.right());
    EXPECT_EQ(b.wrong(), "scene, no fifth bounce");
    plan.own_references = true;
    EXPECT_TRUE(bench(plan, lit_room(1, false), cases, kept).right());
}

TEST(ErrorBench, adaptive_runs_have_a_curve_too) {
    std::vector<ErrorCase> cases(2, make_case("even", room_view(), 32));
    cases[1].setting.name = "adaptive";
    cases[1].adaptive = true;
    Kept kept;
    const ErrorBench b =
        bench({.spp = 32, .repetitions = 2, .reference_spp = 512}, lit_room(1, false), cases, kept);
    EXPECT_TRUE(b.right());
    ASSERT_EQ(b.curves[1].points.size(), 6u);
    EXPECT_NEAR(b.curves[1].points.back().spp, 32, 1);
    EXPECT_LT(b.curves[1].points.back().relmse.value, 1.2 * b.curves[0].points.back().relmse.value);
}

TEST(ErrorBench, stops_between_passes_with_what_was_measured) {
    Scene scene = lit_room(1, false);
    validate(scene);
    const std::vector<ErrorCase> cases = {make_case("default", room_view(), 16)};
    Kept kept;
    ErrorBenchHost host = kept.host();
    int left = 6;
    host.go_on = [&] { return left-- > 0; };
    ErrorBench b;
    b.settings = {cases[0].setting};
    ErrorScene name;
    name.name = "scene";
    EXPECT_FALSE(run_errors({.spp = 256, .repetitions = 5, .reference_spp = 8}, name, scene, cases, host, b));
    fit_curves(b);
    EXPECT_GT(b.runs.size(), 0u);
    EXPECT_LT(b.runs.size(), 9u);
    ASSERT_EQ(b.curves.size(), 1u);
    EXPECT_EQ(b.curves[0].points.size(), b.runs.size());
    EXPECT_TRUE(b.curves[0].right);
    EXPECT_TRUE(b.curves[0].verdict.starts_with("Not tested")) << b.curves[0].verdict;
}

/// Two scenes of one size, two settings, on the test's device.
ErrorExperiment small_experiment() {
    ErrorExperiment e;
    e.plan = {.spp = 2, .repetitions = 2, .reference_spp = 8};
    e.scenes = {{"lit", "lit.glb"}, {"again", "again.glb --size 16x16"}};
    e.settings = {{"all light", ""}, {"three edges", "--max-depth 3"}};
    e.device = [](std::size_t) -> Device& { return test_device(); };
    e.load = [](std::size_t) {
        Scene scene = lit_room(1, false);
        validate(scene);
        return scene;
    };
    e.prepare = [](std::size_t, std::size_t setting, const Scene&) {
        ErrorCase c = make_case("", room_view(), 16);
        c.settings.max_depth = setting == 0 ? 0 : 3;
        return c;
    };
    return e;
}

TEST(ErrorExperiment, measures_every_setting_on_every_scene_and_names_them) {
    Kept kept;
    const ErrorBench b = run_experiment(small_experiment(), kept.host());
    EXPECT_FALSE(b.interrupted);
    EXPECT_EQ(b.repetitions, 2u);
    ASSERT_EQ(b.scenes.size(), 2u);
    EXPECT_EQ(b.scenes[1].options, "again.glb --size 16x16");
    ASSERT_EQ(b.settings.size(), 2u);
    EXPECT_EQ(b.settings[1].options, "--max-depth 3");
    EXPECT_EQ(b.settings[1].device, test_device().info().name);
    ASSERT_EQ(b.curves.size(), 4u);
    const char* expected[4][2] = {
        {"lit", "all light"}, {"lit", "three edges"}, {"again", "all light"}, {"again", "three edges"}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(b.curves[i].scene, expected[i][0]);
        EXPECT_EQ(b.curves[i].setting, expected[i][1]);
    }
    EXPECT_EQ(b.runs.size(), 4u * 2 * 2) << "budgets of 1 and 2, two repetitions";
    EXPECT_TRUE(b.changes.empty());
}

TEST(ErrorExperiment, compares_with_an_earlier_one) {
    Kept kept;
    ErrorExperiment e = small_experiment();
    e.scenes.resize(1);
    e.plan = {.spp = 4, .repetitions = 3, .reference_spp = 2048};
    e.before = run_experiment(e, kept.host()).runs;
    ASSERT_FALSE(e.before.empty());
    for (ErrorRun& run : e.before) run.seconds *= 1e-3;
    const ErrorBench b = run_experiment(e, kept.host());
    ASSERT_EQ(b.changes.size(), 2u);
    for (const ErrorChange& change : b.changes) EXPECT_GT(change.time_ratio.value, 10);
    EXPECT_EQ(b.worse(), "lit, all light; lit, three edges");
}

TEST(ErrorExperiment, stops_after_the_scene_that_was_interrupted) {
    Kept kept;
    ErrorBenchHost host = kept.host();
    host.go_on = [] { return false; };
    const ErrorBench b = run_experiment(small_experiment(), host);
    EXPECT_TRUE(b.interrupted);
    EXPECT_EQ(b.scenes.size(), 1u);
}

TEST(ErrorExperiment, wants_different_names_before_anything_is_opened) {
    for (const auto which : {&ErrorExperiment::scenes, &ErrorExperiment::settings}) {
        ErrorExperiment e = small_experiment();
        (e.*which)[1].name = (e.*which)[0].name;
        e.device = [](std::size_t) -> Device& { throw std::logic_error("opened"); };
        Kept kept;
        try {
            run_experiment(e, kept.host());
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            EXPECT_NE(std::string(error.what()).find((e.*which)[0].name), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace triad::analytic
