// The number of photons that a pilot chooses.
#include "render/photon_pilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analytic/analytic_scene.h"

namespace triad::analytic {
namespace {

RenderSettings wide_view(Integrator integrator) {
    RenderSettings s;
    s.width = 160, s.height = 120;
    s.integrator = integrator;
    s.view = look_at({0, 1.5, 4}, {0, 0.5, 0}, 0.8, 160.0 / 120);
    return s;
}

/// A floor, a mirror that stands on it and a lamp; `away`: the mirror throws the lamp's light into nothing.
Scene mirror_scene(bool away) {
    Material mirror;
    mirror.metallic = 1.0f, mirror.roughness = 0.0f;
    Builder b;
    b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
    if (away)
        b.add(shapes::quad({-0.5f, 0.01f, 0.5f}, {1, 0, 0}, {0, 0, -1}), mirror);
    else
        b.add(shapes::quad({-0.5f, 0, -1}, {1, 0, 0}, {0, 1.2f, 0}), mirror);
    PunctualLight lamp;
    lamp.type = PunctualLight::Type::point;
    lamp.position = {0, 2, 1};
    lamp.colour = vec3(10.0f);
    b.scene.lights.push_back(lamp);
    validate(b.scene);
    return b.scene;
}

/// The same floor and mirror under a lamp that is neither small nor large beside its distance from the
/// mirror.
Scene panel_scene(bool away, float side) {
    Scene scene = mirror_scene(away);
    scene.lights.clear();
    Builder b;
    b.scene = std::move(scene);
    Material lamp = lambert(0.0f);
    lamp.emission = vec3(10.0f);
    b.add(shapes::quad({-side / 2, 2, 0.5f}, {side, 0, 0}, {0, 0, side}), lamp);
    validate(b.scene);
    return b.scene;
}

Film film_of(const Scene& scene, const RenderSettings& settings,
             const std::optional<Features>& features = {}) {
    Renderer renderer(test_device(), scene, settings, features);
    renderer.render({0, 16}, [](const Progress&) { return true; });
    return renderer.film();
}

std::uint64_t photons_of(const Scene& scene, const RenderSettings& settings) {
    return Renderer(test_device(), scene, settings).photons();
}

TEST(PhotonPilot, number_is_where_error_times_work_is_least) {
    // The least of (paths + photons / s) (rays + 8 s) over the powers of two is never much below that of
    // ours.
    for (const double paths : {0.001, 0.1, 1.0})
        for (const double photons : {0.0, 1e-5, 1e-3, 0.1, 10.0})
            for (const double rays : {1.0, 5.0, 50.0}) {
                const auto cost = [&](double s) { return (paths + photons / s) * (rays + 8 * s); };
                double least = INFINITY;
                for (double s = 1; s >= 1.0 / 64; s /= 2) least = std::min(least, cost(s));
                const double ours = best_photon_share(paths, photons, rays);
                EXPECT_LE(cost(ours), 1.05 * least) << paths << ' ' << photons << ' ' << rays;
                EXPECT_EQ(std::exp2(std::round(std::log2(ours))), ours);
                EXPECT_GE(ours, 1.0 / 64);
                EXPECT_LE(ours, 1.0);
            }
}

TEST(PhotonPilot, number_is_small_where_what_photons_bring_is_never_seen) {
    const RenderSettings settings = wide_view(Integrator::automatic);
    const std::uint64_t pixels = 160 * 120;
    EXPECT_EQ(photons_of(mirror_scene(true), settings), pixels / 64);
    EXPECT_GE(photons_of(mirror_scene(false), settings), pixels / 16) << "a patch of light on the floor";
}

TEST(PhotonPilot, number_is_that_of_the_whole_picture_and_of_no_seed) {
    const Scene scene = mirror_scene(false);
    RenderSettings settings = wide_view(Integrator::automatic);
    const std::uint64_t count = photons_of(scene, settings);
    settings.seed = 17;
    EXPECT_EQ(photons_of(scene, settings), count);
    settings.crop = {10, 20, 30, 8};
    EXPECT_EQ(photons_of(scene, settings), count);
    settings.bins_x = 3;
    EXPECT_EQ(photons_of(scene, settings), count);
    settings.photons = 77;
    EXPECT_EQ(photons_of(scene, settings), 77u) << "as asked";
    settings.photons = 0, settings.integrator = Integrator::photons;
    EXPECT_EQ(photons_of(scene, settings), 160u * 120u) << "as documented";
}

TEST(PhotonPilot, number_is_named_by_the_film_which_another_render_goes_on_from) {
    const Scene scene = mirror_scene(false);
    RenderSettings settings = wide_view(Integrator::automatic);
    Renderer chosen(test_device(), scene, settings);
    chosen.render({0, 2}, [](const Progress&) { return true; });
    const Film film = chosen.film();
    settings.photons = chosen.photons();
    Renderer asked(test_device(), scene, settings);
    asked.render({0, 2}, [](const Progress&) { return true; });
    EXPECT_EQ(asked.film().settings, film.settings);
    EXPECT_EQ(asked.film().sums, film.sums);
    EXPECT_NO_THROW(asked.resume(film));
}

TEST(PhotonPilot, takes_photons_of_a_middling_light_where_they_pay) {
    RenderSettings settings = wide_view(Integrator::automatic);
    Renderer chosen(test_device(), panel_scene(false, 0.6f), settings);
    ASSERT_TRUE(chosen.packed().photons_in_doubt);
    EXPECT_GT(chosen.photons(), 0u);
    EXPECT_EQ(chosen.integrator(), "photons: something casts the light of a large source");
}

TEST(PhotonPilot, takes_paths_with_their_bits_where_photons_do_not_pay) {
    const Scene scene = panel_scene(true, 0.8f);
    RenderSettings settings = wide_view(Integrator::automatic);
    Renderer chosen(test_device(), scene, settings);
    ASSERT_TRUE(chosen.packed().photons_in_doubt);
    EXPECT_EQ(chosen.photons(), 0u);
    EXPECT_EQ(chosen.integrator(), "path: a pilot found photons not worth their work");
    chosen.render({0, 16}, [](const Progress&) { return true; });
    settings.integrator = Integrator::path;
    const Film asked = film_of(scene, settings);
    EXPECT_EQ(chosen.film().sums, asked.sums);
    EXPECT_EQ(chosen.film().settings, asked.settings) << "they merge";
    settings.integrator = Integrator::automatic, settings.photons = 100;
    EXPECT_EQ(photons_of(scene, settings), 100u) << "as asked";
}

TEST(PhotonPilot, paths_on_what_was_packed_for_photons_leave_nothing_to_them) {
    const Scene scene = mirror_scene(false);
    RenderSettings settings = wide_view(Integrator::automatic);
    const std::shared_ptr<const PackedScene> packed = pack_for(scene, settings);
    settings.integrator = Integrator::path;
    ASSERT_TRUE(holds_for(*packed, settings));
    Features all;  // a program that could
    all.dispersion = all.light_spectra = false;
    Renderer renderer({std::make_shared<DeviceScene>(test_device(), packed)}, settings, all);
    renderer.render({0, 16}, [](const Progress&) { return true; });
    EXPECT_EQ(renderer.film().sums, film_of(scene, settings).sums);
}

TEST(PhotonPilot, films_agree_unless_one_lacks_a_caustic) {
    const Scene scene = mirror_scene(false);
    RenderSettings photons = wide_view(Integrator::photons), paths = wide_view(Integrator::path);
    const Film with = film_of(scene, photons), without = film_of(scene, paths);
    EXPECT_FALSE(agree(with, without));
    photons.seed = paths.seed = 1;
    EXPECT_TRUE(agree(with, film_of(scene, photons)));
    EXPECT_TRUE(agree(without, film_of(scene, paths)));
    const Scene panel = panel_scene(false, 0.6f);
    EXPECT_TRUE(agree(film_of(panel, photons), film_of(panel, paths)));
}

}  // namespace
}  // namespace triad::analytic
