#pragma once
/// The scenes of scenes/hard/, generated, and pictures of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "device/device_fixture.h"
#include "generated_scenes.h"
#include "io/io.h"
#include "render/renderer.h"
#include "scene/film.h"

namespace triad::hard {

/// The scene, validated.
Scene load(const std::string& name);

struct Shot {
    unsigned width = 32, height = 32, spp = 16, seed = 1, max_depth = 0, camera = 0;
    std::size_t flatten_below = RenderSettings{}.flatten_below;
};

RenderSettings settings_of(const Scene& scene, const Shot& shot);
/// Rendered on the test device; no sample may be dropped for a NaN or an infinity.
Film render(const Scene& scene, const RenderSettings& settings, unsigned spp);
Film render(const Scene& scene, const Shot& shot);

/// Mean radiance of a pixel, by channel.
dvec3 pixel(const Film& film, unsigned x, unsigned y);
/// Mean over a rectangle of pixels.
dvec3 mean(const Film& film, unsigned x, unsigned y, unsigned width, unsigned height);

/// Mean of the green channel over a rectangle, and the standard error of that mean from `seeds` pictures.
struct Measured {
    double mean = 0, standard_error = 0;
};
Measured measure(const Scene& scene, const Shot& shot, unsigned seeds,
                 const std::array<unsigned, 4>& rectangle);
Measured measure(const Scene& scene, const Shot& shot, unsigned seeds);

/// Student's t quantile of eight seeds at 1e-5, two-sided: a family of fifty comparisons is wrong once in
/// 2000, and seeds are fixed.
inline constexpr unsigned seeds = 8;
inline constexpr double t_limit = 10.1;

/// What docs/hard.md shows: printed and kept in the report.
void report(const std::string& what, double measured, double bound);

/// Expects |measured - expected| <= t_limit standard errors + bias |expected|, with a standard error below 1
/// %.
void expect_mean(const std::string& what, const Measured& measured, double expected, double bias = 1e-5);

class Hard : public testing::Test {
  protected:
    void SetUp() override {
        const std::string why = why_no_scenes();
        if (!why.empty()) GTEST_SKIP() << why;
    }
};

}  // namespace triad::hard
