// A render that is asked for an error: is that the error it has?
#include <gtest/gtest.h>
#include <cstdint>
#include <vector>

#include <algorithm>
#include <cmath>

#include "kernels/types.h"
#include "lit_room.h"

namespace triad::analytic {
namespace {

constexpr unsigned side = 80;  // the scatter of an estimate falls with the number of pixels

struct Rendered {
    Film film;
    RenderResult result;
};

Rendered render(const RenderGoal& goal, std::uint32_t seed) {
    Scene scene = lit_room(1, false);
    validate(scene);
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.seed = seed;
    settings.view = room_view();
    Renderer renderer(test_device(), scene, settings);
    const RenderResult result = renderer.render_until(goal, [](const Progress&) { return true; });
    return {renderer.film(), result};
}

double relmse(const Film& film, const Film& reference) {
    double error = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const auto x = pixel_mean(film, p), r = pixel_mean(reference, p);
        for (int c = 0; c < 3; ++c) error += (x[c] - r[c]) * (x[c] - r[c]) / (r[c] * r[c] + 0.01);
    }
    return error / (3.0 * double(film.pixels()));
}

class ErrorGoal : public testing::TestWithParam<bool> {};

TEST_P(ErrorGoal, is_the_true_error_within_a_tenth) {
    constexpr double wanted = 0.01;
    const Film reference = render({.samples = {0, 4096}}, 999).film;
    std::vector<double> ratios;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto [film, result] =
            render({.samples = {0, 100000}, .error = wanted, .adaptive = GetParam()}, seed);
        EXPECT_EQ(result.stop, Stop::error);
        EXPECT_LE(estimated_relmse(film), 1.02 * wanted);
        EXPECT_EQ(film.is_even(), !GetParam());
        const double truth = relmse(film, reference) - estimated_relmse(reference);
        ratios.push_back(truth / wanted);
        EXPECT_GT(ratios.back(), 1 / 1.5) << seed << ", " << film.sample_numbers().most << " samples";
        EXPECT_LT(ratios.back(), 1.2) << seed;
    }
    std::nth_element(ratios.begin(), ratios.begin() + 10, ratios.end());
    EXPECT_NEAR(ratios[10], 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Sampling, ErrorGoal, testing::Bool(),
                         [](const auto& info) { return info.param ? "adaptive" : "even"; });

TEST(Adaptive, has_less_error_than_even_sampling_from_as_many_rays) {
    // The rays of an adaptive render go to where paths are long: as many rays are fewer samples.
    const Film reference = render({.samples = {0, 4096}}, 999).film;
    double even = 0, adaptive = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Film a = render({.samples = {0, 64}, .adaptive = true}, seed).film;
        const Film b = render({.samples = {0, 64}}, seed).film;
        const auto rays = [](const Film& f) { return double(f.counters[COUNTER_RAYS]); };
        adaptive += relmse(a, reference) * rays(a);
        even += relmse(b, reference) * rays(b);
    }
    EXPECT_LT(adaptive, even);
}

}  // namespace
}  // namespace triad::analytic
