// What rays pass on their way: alpha, transparent backgrounds, bodies with something inside, far texture
// tiles.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"

namespace triad::analytic {
namespace {

const View down = orthographic({0, 0, 0}, {0, -1, 0}, 0.1, 0.4);

Film picture(const Scene& scene, bool transparent) {
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.view = down;
    settings.transparent = transparent;
    Scene copy = scene;
    validate(copy);
    Renderer renderer(test_device(), copy, settings);
    renderer.render({0, 256}, [](const Progress&) { return true; });
    return renderer.film();
}

double mean_of(const Film& film, int channel) {
    double sum = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) sum += pixel_mean(film, p)[channel];
    return sum / static_cast<double>(film.pixels());
}

TEST(Alpha, a_lamp_with_coverage_lights_by_its_share) {
    for (AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        Builder b;
        Material lamp = emitter(1.0f);
        lamp.alpha_mode = mode;
        lamp.base_colour.w = 0.25f;
        b.add(square(0, true, 2), lambert(1.0f)).add(square(1, false, 0.5), lamp);
        const Measured m = measure(
            b.scene, {.view = orthographic({0, 0, 0}, {0, -1, 0}, 1e-3, 0.5), .spp = 256, .max_depth = 2});
        // D2: E / L = .752274688 below the centre of a unit square at height 1.
        if (mode == AlphaMode::mask)
            EXPECT_EQ(m.mean, 0.0);
        else
            expect_closed_form("blend", m, 0.25 * 0.752274688 / pi, 1e-4);
    }
}

TEST(TransparentBackground, a_rough_wall_that_passes_everything_shows_none_of_the_environment) {
    for (float roughness : {0.2f, 1.0f}) {
        Material clear = glass(1.0f, roughness);
        clear.thickness = 0;
        Builder b;
        b.add(square(0, true, 2), clear);
        b.scene.environment = EnvironmentMap{8, 4, std::vector<float>(8 * 4 * 3, 1.0f)};
        const Film film = picture(b.scene, true);
        EXPECT_EQ(mean_of(film, 1), 0.0) << roughness;
        EXPECT_NEAR(mean_of(film, 3), 0.0, 0.01) << roughness;
        EXPECT_NEAR(mean_of(picture(b.scene, false), 1), 1.0, 0.01) << roughness;
    }
}

TEST(TransparentBackground, what_is_scattered_through_a_leaf_and_what_is_seen_through_it_are_counted_once) {
    for (float roughness : {0.0f, 0.5f}) {
        Material leaf = glass(1.0f, roughness);
        leaf.thickness = 0;
        leaf.transmission = 0.5f, leaf.diffuse_transmission = DiffuseTransmission{.factor = 0.8f};
        Builder b;
        b.add(square(0, true, 2), leaf);
        b.scene.environment = EnvironmentMap{8, 4, std::vector<float>(8 * 4 * 3, 1.0f)};
        const Film over = picture(b.scene, true);
        EXPECT_NEAR(mean_of(over, 1) + 1 - mean_of(over, 3), mean_of(picture(b.scene, false), 1), 0.01)
            << roughness;
    }
}

TEST(Body, absorbs_on_the_way_to_what_is_inside_it) {
    // An index of 1 bends and reflects nothing: the lamp or the floor inside is seen through half a unit,
    // c^.5.
    Material amber = glass(1.0f);
    amber.attenuation_distance = 1.0f;
    amber.attenuation_colour = vec3(0.25f);
    Builder lamp;
    lamp.add(shapes::box({-2, -1, -2}, {2, 0.25f, 2}), amber).add(square(-0.25, true, 1), emitter(1.0f));
    expect_closed_form("lamp", measure(lamp.scene, {.view = down}), 0.5, 1e-5);

    // Both ways, to the sun and back; a directional light passes no boundary, so the sun is a sky seen
    // through the top.
    Builder floor;
    floor.add(shapes::box({-200, -1, -200}, {200, 0.25f, 200}), amber)
        .add(square(-0.25, true, 100), lambert(1.0f))
        .sky(1.0f);
    // Mean of c^(d / cos) over the cosine: 2 E_3(tau), tau = -ln(c) / 2 = ln 2.
    const double tau = std::log(2.0);
    double transmitted = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double mu = (i + 0.5) / n;
        transmitted += 2 * mu * std::exp(-tau / mu) / n;
    }
    expect_closed_form("floor", measure(floor.scene, {.view = down, .spp = 512}), 0.5 * transmitted, 1e-3);
}

TEST(Body, absorbs_the_light_of_lamps_inside_it) {
    // A floor, and above it a lamp at height 1, in amber up to 1.5; the camera looks in at 45 degrees.
    Material amber = glass(1.0f);
    amber.attenuation_distance = 1.0f;
    amber.attenuation_colour = vec3(0.5f);
    Builder b;
    b.add(shapes::box({-20, -1, -20}, {20, 1.5f, 20}), amber).add(square(0, true, 10), lambert(1.0f));
    const Plan plan{.view = orthographic({0, 0, 0}, glm::normalize(dvec3(1, -1, 0)), 1e-4, 4), .spp = 256};
    const double way = std::pow(0.5, 1.5 * std::sqrt(2.0));

    Builder point = b;
    point.scene.lights.push_back(
        {.type = PunctualLight::Type::point, .position = {0, 1, 0}, .colour = vec3(3.0f)});
    expect_closed_form("point", measure(point.scene, plan), way * 0.5 * 3 / pi, 1e-4);

    Builder square_lamp = b;
    square_lamp.add(square(1, false, 0.5), emitter(1.0f));
    double irradiance = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = (i + 0.5) / n - 0.5, z = (k + 0.5) / n - 0.5, d2 = 1 + x * x + z * z;
            irradiance += std::pow(0.5, std::sqrt(d2)) / (d2 * d2) / (n * n);
        }
    expect_closed_form("square", measure(square_lamp.scene, plan), way * irradiance / pi, 1e-4);
}

TEST(Texture, repeats_as_well_far_from_the_origin) {
    // Three quarters of the image are white; thousands of tiles away its mean is the same.
    Image image;
    image.width = image.height = 1024;
    for (unsigned y = 0; y < 1024; ++y)
        for (unsigned x = 0; x < 1024; ++x) {
            const std::uint8_t v = x < 768 ? 255 : 0;
            image.texels.insert(image.texels.end(), {v, v, v, 255});
        }
    for (float tile : {0.0f, 2048.0f}) {
        Builder b;
        Primitive p = square(0, true, 0.1);
        p.uvs[0] = {{tile, tile}, {tile + 1, tile}, {tile, tile + 1}, {tile + 1, tile + 1}};
        Material m = lambert(1.0f);
        m.base_colour_texture = TextureUse{};
        b.add(p, m).sky(1.0f);
        b.scene.images.push_back(image);
        b.scene.textures.push_back({});
        expect_closed_form("tile " + std::to_string(tile), measure(b.scene, {.view = down}), 0.75, 0.005);
    }
}

TEST(Glass, of_an_absurd_index_is_a_mirror) {
    for (float ior : {1e8f, 1e30f})
        for (float roughness : {0.0f, 0.5f}) {
            Builder b;
            b.add(shapes::box({-1, -1, -1}, {1, 0, 1}), glass(ior, roughness)).sky(1.0f);
            expect_closed_form("ior " + std::to_string(ior), measure(b.scene, {.view = down}), 1.0, 0.005);
        }
}

}  // namespace
}  // namespace triad::analytic
