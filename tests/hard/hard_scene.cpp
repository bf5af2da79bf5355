#include "hard_scene.h"

#include <cmath>
#include <cstdio>

#include "kernels/types.h"
#include "scene/view.h"

namespace triad::hard {

Scene load(const std::string& name) {
    Scene scene = load_gltf(generated(name) / (name + ".glb"));
    validate(scene);
    return scene;
}

RenderSettings settings_of(const Scene& scene, const Shot& shot) {
    RenderSettings s;
    s.width = shot.width, s.height = shot.height;
    s.seed = shot.seed;
    s.max_depth = shot.max_depth;
    s.flatten_below = shot.flatten_below;
    s.view = view_of(scene.cameras.at(shot.camera), double(shot.width) / shot.height);
    return s;
}

Film render(const Scene& scene, const RenderSettings& settings, unsigned spp) {
    Renderer renderer(test_device(), scene, settings);
    renderer.render({0, spp}, [](const Progress&) { return true; });
    Film film = renderer.film();
    EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
    return film;
}

Film render(const Scene& scene, const Shot& shot) {
    return render(scene, settings_of(scene, shot), shot.spp);
}

dvec3 pixel(const Film& film, unsigned x, unsigned y) {
    const auto m = pixel_mean(film, std::size_t(y) * film.width + x);
    return {m[0], m[1], m[2]};
}

dvec3 mean(const Film& film, unsigned x, unsigned y, unsigned width, unsigned height) {
    dvec3 sum(0.0);
    for (unsigned j = y; j < y + height; ++j)
        for (unsigned i = x; i < x + width; ++i) sum += pixel(film, i, j);
    return sum / (double(width) * height);
}

Measured measure(const Scene& scene, const Shot& shot, unsigned count, const std::array<unsigned, 4>& r) {
    Renderer renderer(test_device(), scene, settings_of(scene, shot));
    double sum = 0, squares = 0;
    for (std::uint32_t seed = 1; seed <= count; ++seed) {
        renderer.restart(seed);
        renderer.render({0, shot.spp}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
        const double m = mean(film, r[0], r[1], r[2], r[3]).y;
        sum += m, squares += m * m;
    }
    const double average = sum / count;
    return {average, std::sqrt(std::max(0.0, squares / count - average * average) / (count - 1))};
}

Measured measure(const Scene& scene, const Shot& shot, unsigned count) {
    return measure(scene, shot, count, {0, 0, shot.width, shot.height});
}

void report(const std::string& what, double measured, double bound) {
    std::printf("    %-58s %-12.4g bound %.4g\n", what.c_str(), measured, bound);
}

void expect_mean(const std::string& what, const Measured& m, double expected, double bias) {
    const double bound = t_limit * m.standard_error + bias * std::abs(expected);
    report(what + ", for " + std::to_string(expected), m.mean - expected, bound);
    EXPECT_NEAR(m.mean, expected, bound) << what;
    EXPECT_LT(m.standard_error, 0.01 * std::abs(expected)) << what << " is too noisy to prove anything";
}

}  // namespace triad::hard
