// The noise that an eye sees on a panel, as a render reports it.
#include <gtest/gtest.h>
#include <cmath>

#include "display/perceived_noise.h"
#include "lit_room.h"
#include "panel/perceived.h"

namespace triad::analytic {
namespace {

Film render_room(unsigned spp, std::uint32_t seed) {
    RenderSettings settings;
    settings.width = 96, settings.height = 80;
    settings.seed = seed;
    settings.independent = true;
    settings.view = room_view();
    Scene scene = lit_room(1, false);
    validate(scene);
    Renderer renderer(test_device(), scene, settings);
    renderer.render({0, spp}, [](const Progress&) { return true; });
    return renderer.film();
}

RgbImage shown(const Film& film, const DisplaySettings& display) {
    const std::vector<float> rgba = resolve_display(test_device(), film, display);
    RgbImage image{film.width, film.height, {}};
    for (std::size_t p = 0; p < film.pixels(); ++p)
        image.rgb.insert(image.rgb.end(), {rgba[4 * p], rgba[4 * p + 1], rgba[4 * p + 2]});
    return image;
}

TEST(PerceivedNoise, estimated_from_one_film_is_what_separates_it_from_the_picture) {
    const Panel panel = *builtin_panel("rgb");
    const DisplaySettings display{.order = ToneOrder::per_pixel};
    const PerceivedNoise noise(test_device(), panel, 45, display);
    const RgbImage picture = shown(render_room(2048, 1), display);
    double estimated = 0, true_noise = 0;
    constexpr unsigned films = 6;
    for (unsigned k = 0; k < films; ++k) {
        const Film film = render_room(32, 100 + k);
        RgbImage difference = shown(film, display);
        for (std::size_t i = 0; i < difference.rgb.size(); ++i) difference.rgb[i] -= picture.rgb[i];
        const double true_one = perceived_difference(panel, difference, {.ppd = 45, .border = 0});
        true_noise += true_one * true_one;
        estimated += std::pow(noise.of(film).value(), 2);
    }
    EXPECT_NEAR(std::sqrt(estimated / true_noise), 1.0, 0.1);
}

TEST(PerceivedNoise, falls_with_the_root_of_the_samples) {
    const PerceivedNoise noise(test_device(), *builtin_panel("qd-oled"), 45, {.order = ToneOrder::per_pixel});
    const double few = noise.of(render_room(32, 1)).value(), many = noise.of(render_room(512, 2)).value();
    EXPECT_NEAR(few / many, 4.0, 0.5);
}

TEST(PerceivedNoise, is_not_known_without_both_halves) {
    const PerceivedNoise noise(test_device(), *builtin_panel("rgb"), 45, {});
    EXPECT_FALSE(noise.of(render_room(1, 1)));
}

TEST(PerceivedNoise, is_larger_on_a_screen_that_is_closer) {
    const Film film = render_room(16, 3);
    const Panel panel = *builtin_panel("rgb");
    double last = 0;
    for (const double ppd : {110.0, 60.0, 30.0}) {
        const double now = PerceivedNoise(test_device(), panel, ppd, {}).of(film).value();
        EXPECT_GT(now, last) << ppd;
        last = now;
    }
}

}  // namespace
}  // namespace triad::analytic
