// Recorded paths are the paths of the picture, and what is told about a pixel adds up to it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "analytic/analytic_scene.h"
#include "kernels/types.h"
#include "render/pixel_report.h"

namespace triad {
namespace {

constexpr SampleRange range{3, 640};  // more than a launch, and not from the start

struct Recorded {
    Film film;
    std::vector<RecordedPath> paths;
    std::vector<std::string> sources;
    PixelReport report;
};

/// One pixel of the varied scene, rendered and recorded.
Recorded record(Scene scene, unsigned x, unsigned y, unsigned bins, unsigned max_depth = 0,
                Spectral spectral = Spectral::automatic) {
    validate(scene);
    RenderSettings settings = analytic::varied_settings();
    settings.crop = {x, y, 1, 1};
    settings.bins_x = bins;
    settings.max_depth = max_depth;
    settings.spectral = spectral;
    Renderer renderer(test_device(), scene, settings);
    renderer.render(range, [](const Progress&) { return true; });
    Recorded r{renderer.film(), {}, renderer.packed().light_sources, report_pixel(renderer, 0, 0, range, 7)};
    renderer.record_pixel(0, 0, range, [&](const RecordedPath& path) { r.paths.push_back(path); });
    return r;
}

vec3 contributions(const RecordedPath& path) {
    vec3 sum(0.0f);
    for (const RecordedVertex& v : path.vertices) sum += v.found + v.direct;
    return sum;
}

TEST(Record, paths_have_the_bits_of_the_film) {
    for (const auto& [x, y] : {std::pair{18u, 20u}, {10u, 17u}, {26u, 16u}, {36u, 28u}})
        for (const unsigned bins : {1u, 2u}) {
            const Recorded r = record(analytic::varied_scene(), x, y, bins);
            ASSERT_EQ(r.paths.size(), range.end - range.begin);
            std::vector<std::int64_t> sums(4 * bins), halves(3);
            std::uint64_t rays = 0, at = range.begin;
            for (const RecordedPath& path : r.paths) {
                EXPECT_EQ(path.sample, at++);
                rays += path.rays;
                for (int c = 0; c < 4; ++c) {
                    const auto fixed = std::llrint(path.value[c] * std::ldexp(1.0f, r.film.quanta_log2));
                    sums[4 * path.bin + static_cast<unsigned>(c)] += fixed;
                    if (c < 3 && path.half == 0) halves[static_cast<unsigned>(c)] += fixed;
                }
            }
            EXPECT_EQ(sums, r.film.sums) << x << ", " << y;
            EXPECT_EQ(halves, r.film.half_sums);
            EXPECT_EQ(rays, r.film.counters[COUNTER_RAYS]);
        }
}

TEST(Record, wavelengths_add_up_as_colours_do) {
    Scene scene = analytic::varied_scene();
    for (Material& m : scene.materials)
        if (m.transmission > 0) m.dispersion = find_glass("SF10"), m.roughness = 0.3f;
    for (const Spectral spectral : {Spectral::automatic, Spectral::full, Spectral::classic}) {
        const Recorded r = record(scene, 10, 17, 1, 0, spectral);
        std::int64_t sum = 0;
        unsigned coloured = 0;
        for (const RecordedPath& path : r.paths) {
            const vec3 parts = contributions(path);
            float size = 0;
            for (const RecordedVertex& v : path.vertices) size += std::abs(v.found.x) + std::abs(v.direct.x);
            EXPECT_NEAR(parts.x, path.value[0], 1e-5f * size + 1e-7f);
            sum += std::llrint(path.value[0] * std::ldexp(1.0f, r.film.quanta_log2));
            coloured += path.value[0] < 0;
        }
        EXPECT_EQ(sum, r.film.sums[0]);
        unsigned forked = 0;
        for (const RecordedPath& path : r.paths) {
            std::set<float> wavelengths;
            unsigned returns = 0;
            for (std::size_t k = 1; k < path.vertices.size(); ++k) {
                wavelengths.insert(path.vertices[k].wavelength);
                returns += path.vertices[k].edge <= path.vertices[k - 1].edge;
            }
            wavelengths.erase(0.0f);
            forked += returns == 2 && wavelengths.size() > 1;
            if (spectral != Spectral::automatic) {
                EXPECT_EQ(returns, 0u);
            }
        }
        // three wavelengths, one after the other
        EXPECT_EQ(forked > 100, spectral == Spectral::automatic) << forked;
        // single wavelengths leave the gamut; classic cuts them
        if (spectral != Spectral::full) {
            EXPECT_EQ(coloured > 0, spectral == Spectral::automatic) << coloured;
        }
    }
}

TEST(Record, every_path_is_the_sum_of_what_its_vertices_brought) {
    const Recorded r = record(analytic::varied_scene(), 10, 17, 1);
    unsigned lit = 0, longest = 0;
    for (const RecordedPath& path : r.paths) {
        const vec3 sum = contributions(path);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], path.value[c], 1e-5f * path.value[c]);
        lit += path.value.x > 0;
        longest = std::max(longest, path.met);
        ASSERT_FALSE(path.vertices.empty());
        EXPECT_NE(path.vertices.back().end, unsigned(PATH_GOES_ON));
        for (std::size_t k = 0; k + 1 < path.vertices.size(); ++k)
            EXPECT_EQ(path.vertices[k].end, unsigned(PATH_GOES_ON));
    }
    EXPECT_GT(lit, 100u);
    EXPECT_GT(longest, 4u);
}

TEST(Record, paths_longer_than_what_is_kept_lose_nothing) {
    // A mirror box without a way out but the camera's; light comes from its dim walls.
    analytic::Builder b;
    Material wall;
    wall.base_colour = {0.999f, 0.999f, 0.999f, 1.0f};
    wall.roughness = 0.0f;
    wall.emission = vec3(0.01f);
    wall.double_sided = true;
    b.add(shapes::box({-9, -9, -9}, {9, 9, 9}), wall);
    const Recorded r = record(b.scene, 5, 5, 1);
    unsigned long_ones = 0;
    for (const RecordedPath& path : r.paths) {
        long_ones += path.met > PATH_VERTICES;
        EXPECT_EQ(path.vertices.size(), std::min<std::size_t>(path.met, PATH_VERTICES));
        EXPECT_NEAR(contributions(path).x, path.value.x, 1e-4f * path.value.x);
    }
    EXPECT_GT(long_ones, 50u);
}

TEST(Record, tells_lights_apart) {
    Scene scene = analytic::varied_scene();
    scene.lights[0].name = "bulb";
    const Recorded r = record(scene, 18, 20, 1);
    dvec3 found(0.0), direct(0.0);
    std::vector<std::string> names;
    for (const PixelReport::Source& s : r.report.sources) {
        names.push_back(s.name);
        found += s.found, direct += s.direct;
        if (s.name == "light \"bulb\"") {
            EXPECT_EQ(s.found, dvec3(0.0)) << "nothing hits a point";
            EXPECT_GT(s.direct.x, 0.0);
        }
    }
    EXPECT_NE(std::find(names.begin(), names.end(), "light \"bulb\""), names.end());
    EXPECT_NE(std::find(names.begin(), names.end(), "environment"), names.end());
    EXPECT_NE(std::find(names.begin(), names.end(), "material 4"), names.end()) << "the lamp";
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] + direct[c], r.report.mean[c], 1e-6 * r.report.mean[c]);
    scene.lights.clear();
    scene.environment.reset();
    const Recorded lamp = record(scene, 18, 20, 1);
    ASSERT_EQ(lamp.report.sources.size(), 1u);
    EXPECT_EQ(lamp.report.sources[0].name, "material 4");
}

TEST(Record, the_report_has_the_numbers_of_the_film) {
    const Recorded r = record(analytic::varied_scene(), 10, 17, 1);
    const auto mean = pixel_mean(r.film, 0);
    const auto variance = mean_variance(r.film);
    double squares = 0;
    for (const RecordedPath& path : r.paths) squares += std::pow(path.value.y - mean[1], 2);
    EXPECT_EQ(r.report.samples, r.film.samples[0]);
    EXPECT_NEAR(r.report.variance.y, squares / double(r.paths.size() - 1), 1e-9);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(r.report.mean[c], mean[static_cast<std::size_t>(c)], 1e-7);
        EXPECT_NEAR(r.report.mean_variance[c], variance[static_cast<std::size_t>(c)],
                    1e-6 * variance[0] + 1e-12);
    }
    double by_depth = 0;
    for (const PixelReport::Depth& d : r.report.depths) by_depth += d.found.y + d.direct.y;
    EXPECT_NEAR(by_depth, mean[1], 1e-6 * mean[1]);
    EXPECT_EQ(r.report.depths[0].paths, r.report.samples);
    ASSERT_EQ(r.report.largest.size(), 7u);
    float most = 0;
    for (const RecordedPath& path : r.paths)
        most = std::max(most, path.value.x + path.value.y + path.value.z);
    const vec4 first = r.report.largest[0].value;
    EXPECT_EQ(first.x + first.y + first.z, most);
    EXPECT_GE(r.report.share(0), r.report.share(6));
    EXPECT_NEAR(r.report.share(0), most / ((mean[0] + mean[1] + mean[2]) * double(r.paths.size())), 1e-6);
}

TEST(Record, depths_count_edges_as_max_depth_does) {
    const Recorded r = record(analytic::varied_scene(), 18, 20, 1, 2);
    ASSERT_LE(r.report.depths.size(), 2u);
    for (const RecordedPath& path : r.paths) {
        EXPECT_LE(path.met, 2u);
        EXPECT_TRUE(path.vertices.back().end != PATH_LONGEST || path.met == 2);
    }
}

}  // namespace
}  // namespace triad
