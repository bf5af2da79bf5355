// Where camera rays start: bin centres that are the pixels of a larger picture, and pixel filters. And films
// in bands.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "analytic/analytic_scene.h"
#include "pack/pack.h"
#include "pack/ray_filter.h"
#include "panel/pixel_filter.h"
#include "same_film.h"

namespace triad {
namespace {

using analytic::varied_scene;

const char* const source = R"(#include "common/language.h"
#include "shading/sample.h"
/* The rays of samples [0, bins) of every pixel, at the places of their bins; how many came to each. */
kernel void bin_rays(global const Frame* frame, global Ray* rays, global uint* counts, uint pixels) {
    const uint i = get_global_id(0);
    if (i >= pixels) return;
    const Frame f = *frame;
    const uint x = i % f.crop[2], y = i / f.crop[2], bins = f.bins[0] * f.bins[1];
    const uint pixel = (f.crop[1] + y) * (uint)f.camera.pixels[0] + f.crop[0] + x;
    for (uint s = 0; s < bins; ++s) {
        const SampleName name = sample_name(&f, pixel, s);
        SampleWeight weight;
        const Ray ray = sample_camera_ray(&f, 0, &name, x, y, &weight);
        const uint at = (y * f.bins[1] + name.bin / f.bins[0]) * f.crop[2] * f.bins[0] + x * f.bins[0] +
                        name.bin % f.bins[0];
        rays[at] = ray;
        ++counts[at];
    }
}
/* Places and weights of samples [0, count) of bin `bin` of pixel (x, y). */
kernel void filter_places(global const Frame* frame, global const float* tables, global float* out, uint x,
                          uint y, uint bin, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Frame f = *frame;
    const Sampler s = sampler_make(7u, i, 0u, 0u, 3u);
    Vec3 weight;
    const Vec2 at = ray_filter_sample(&f, tables, x, y, bin, sampler_2d(&s, 0u), &weight);
    out[5 * i] = at.x, out[5 * i + 1] = at.y;
    out[5 * i + 2] = weight.x, out[5 * i + 3] = weight.y, out[5 * i + 4] = weight.z;
}
)";

/// Origin and direction of the rays through the centres of all bins, row-major over bins.
std::vector<float> centre_rays(RenderSettings settings) {
    settings.ray_start = RayStart::centre;
    Scene scene = varied_scene();
    const dev::Frame frame = frame_of(pack(scene, settings), settings);
    const std::uint32_t pixels = frame.crop[2] * frame.crop[3],
                        rays = pixels * settings.bins_x * settings.bins_y;
    Device& device = test_device();
    const Buffer f = device.upload(std::vector<dev::Frame>{frame});
    const Buffer out = device.allocate(rays * sizeof(dev::Ray)),
                 counts = device.upload(std::vector<std::uint32_t>(rays));
    device.run(device.build_source("ray_start_test.cl", source).kernel("bin_rays"),
               Arguments().add(f).add(out).add(counts).add(pixels), pixels);
    EXPECT_EQ(device.download<std::uint32_t>(counts), std::vector<std::uint32_t>(rays, 1)) << "each bin once";
    std::vector<float> values;
    for (const dev::Ray& ray : device.download<dev::Ray>(out)) {
        values.insert(values.end(), ray.origin, ray.origin + 3);
        values.insert(values.end(), ray.direction, ray.direction + 3);
    }
    return values;
}

TEST(RayStart, centres_of_bins_are_the_pixels_of_a_larger_picture_bit_for_bit) {
    for (const unsigned s : {1u, 2u, 3u, 5u, 8u}) {
        RenderSettings small = analytic::varied_settings();
        small.bins_x = small.bins_y = s;
        RenderSettings large = analytic::varied_settings();
        large.width *= s, large.height *= s;
        EXPECT_EQ(centre_rays(small), centre_rays(large)) << s;
        small.crop = {3, 5, 11, 7};
        large.crop = {3 * s, 5 * s, 11 * s, 7 * s};
        EXPECT_EQ(centre_rays(small), centre_rays(large)) << s << ", a crop";
    }
}

TEST(RayStart, two_of_four_rays_on_purple_make_a_pixel_half_purple) {
    analytic::Builder b;
    Material purple;
    purple.unlit = true;
    purple.base_colour = {0.5f, 0.0f, 0.75f, 1.0f};
    b.add(shapes::quad({-9, -9, 0}, {9, 0, 0}, {0, 18, 0}), purple);  // the left half of what is seen
    RenderSettings settings;
    settings.width = settings.height = 1;
    settings.bins_x = settings.bins_y = 2;
    settings.ray_start = RayStart::centre;
    settings.view = analytic::orthographic({0, 0, 0}, {0, 0, -1}, 1, 5);
    validate(b.scene);
    Renderer renderer(test_device(), b.scene, settings);
    renderer.render({0, 4}, [](const Progress&) { return true; });
    const auto mean = pixel_mean(renderer.film(), 0);
    EXPECT_EQ(mean[0], 0.25);
    EXPECT_EQ(mean[1], 0.0);
    EXPECT_EQ(mean[2], 0.375);
}

RenderSettings filtered(const TapTable& table, unsigned bins_x) {
    RenderSettings settings = analytic::varied_settings();
    settings.bins_x = bins_x, settings.bins_y = 1;
    settings.ray_start = RayStart::filter;
    settings.ray_filter = table;
    return settings;
}

/// A table of two pixels, whose channels have lobes of either sign at different places.
TapTable signed_table() {
    TapTable table =
        filter_taps(parse_filter("lanczos:3"), 3, 3, {dvec2(1 / 6.0, 0.5), dvec2(0.5), dvec2(5 / 6.0, 0.5)});
    const TapTable other = filter_taps(parse_filter("mitchell:2"), 3, 3);
    table.cell_x = 2;
    table.outputs.insert(table.outputs.end(), other.outputs.begin(), other.outputs.end());
    return table;
}

TEST(RayStart, weights_of_places_are_the_filter) {
    constexpr std::uint32_t count = 1 << 16;
    const TapTable table = signed_table();
    for (const unsigned bins : {1u, 3u}) {
        const RenderSettings settings = filtered(table, bins);
        Scene scene = varied_scene();
        Device& device = test_device();
        const Buffer frame =
            device.upload(std::vector<dev::Frame>{frame_of(pack(scene, settings), settings)});
        const Buffer tables = device.upload(ray_filter_tables(settings)),
                     out = device.allocate(count * 5 * sizeof(float));
        for (std::uint32_t x = 0; x < 2; ++x)
            for (std::uint32_t bin = 0; bin < bins; ++bin) {
                device.run(device.build_source("ray_start_test.cl", source).kernel("filter_places"),
                           Arguments().add(frame).add(tables).add(out).add(x).add(3u).add(bin).add(count),
                           count);
                const auto places = device.download<float>(out);
                for (unsigned c = 0; c < 3; ++c) {
                    if (bins == 3 && c != bin) continue;
                    const Taps& taps = table.outputs[x * 3 + c];
                    std::vector<double> sums(taps.weights.size());
                    double outside = 0;
                    for (std::uint32_t i = 0; i < count; ++i) {
                        const int u = int(std::floor(places[5 * i] * 3)) - taps.first_x,
                                  v = int(std::floor(places[5 * i + 1] * 3)) - taps.first_y;
                        const double weight = places[5 * i + 2 + c] / double(count);
                        if (u >= 0 && v >= 0 && u < int(taps.width) && v < int(taps.height))
                            sums[std::size_t(v) * taps.width + std::size_t(u)] += weight;
                        else
                            outside += std::abs(weight);
                    }
                    EXPECT_EQ(outside, 0.0);
                    for (std::size_t i = 0; i < sums.size(); ++i)
                        ASSERT_NEAR(sums[i], taps.weights[i], 5e-4)
                            << bins << " " << x << " " << c << " " << i;
                }
            }
    }
}

TEST(RayStart, the_box_as_a_filter_is_jitter_bit_for_bit) {
    const Scene scene = varied_scene();
    const Film by_filter =
        picture_case::render(test_device(), scene, filtered(filter_taps({}, 1, 1), 1), {{0, 4}});
    const Film jittered = picture_case::render(test_device(), scene, analytic::varied_settings(), {{0, 4}});
    expect_same_bytes(by_filter, jittered, "box");
    EXPECT_NE(by_filter.settings, jittered.settings);
}

TEST(RayStart, the_general_program_gives_the_bits_of_the_special_one) {
    const Scene scene = varied_scene();
    for (const RayStart start : {RayStart::jitter, RayStart::centre, RayStart::filter}) {
        RenderSettings settings = filtered(signed_table(), 3);
        settings.ray_start = start;
        Features everything;
        expect_same_bytes(picture_case::render(test_device(), scene, settings, {{0, 6}}),
                          picture_case::render(test_device(), scene, settings, {{0, 6}}, everything),
                          "general");
    }
}

TEST(RayStart, a_filter_for_other_bins_is_refused) {
    RenderSettings settings = filtered(filter_taps({}, 1, 1), 2);
    EXPECT_THROW(Renderer(test_device(), varied_scene(), settings), Error);
}

TEST(Film, in_bands_has_the_bytes_of_one_in_one_piece) {
    const Scene scene = varied_scene();
    RenderSettings settings = analytic::varied_settings();
    settings.width = 64, settings.height = 151;
    settings.bins_x = settings.bins_y = 3;
    Device small = limited_device(smallest_allocation);  // for a film of 2.8 MB: three pieces at least
    const Film pieces = picture_case::render(small, scene, settings, {{0, 9}, {9, 18}}),
               whole = picture_case::render(test_device(), scene, settings, {{0, 9}, {9, 18}});
    expect_same_bytes(pieces, whole, "bands");
}

}  // namespace
}  // namespace triad
