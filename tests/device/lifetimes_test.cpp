// What is made once and shared: a packed scene by all pictures, eyes and devices; a film by what goes on from
// it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "analytic/analytic_scene.h"
#include "base/error.h"
#include "render/renderer.h"
#include "same_film.h"
#include "trace/node_format.h"

namespace triad {
namespace {

using analytic::varied_scene;

const auto go_on = [](const Progress&) { return true; };

RenderSettings settings() { return analytic::varied_settings(); }

std::shared_ptr<const DeviceScene> on_test_device(std::shared_ptr<const PackedScene> packed) {
    return std::make_shared<DeviceScene>(test_device(), std::move(packed));
}

Film film_of(const DeviceScenes& scenes, const RenderSettings& s, SampleRange range) {
    Renderer renderer(scenes, s);
    renderer.render(range, go_on);
    return renderer.film();
}

TEST(Lifetimes, other_seeds_crops_sizes_and_bins_need_no_other_packing) {
    const Scene scene = varied_scene();
    const auto packed = pack_for(scene, settings());
    const DeviceScenes scenes{on_test_device(packed)};
    std::vector<RenderSettings> others(4, settings());
    others[0].seed = 9;
    others[1].crop = {3, 5, 20, 11};
    others[2].width = 50, others[2].height = 20;
    others[3].bins_x = others[3].bins_y = 2;
    for (const RenderSettings& s : others) {
        EXPECT_EQ(pack_for(scene, s, packed), packed);
        expect_same_bytes(film_of(scenes, s, {0, 4}), picture_case::render(test_device(), scene, s, {{0, 4}}),
                          text_of(s));
    }
}

TEST(Lifetimes, several_devices_add_up_to_the_film_of_one_whatever_nodes_they_walk) {
    if (test_device().info().type != "cpu") GTEST_SKIP() << "a CPU can be opened twice and lends parts";
    const char* selector = std::getenv("TRIAD_TEST_DEVICE");
    Device part = Device::open({.selector = selector ? selector : "", .threads = 1});
    set_format(part, BvhFormat::bvh4);
    const Scene scene = varied_scene();
    RenderSettings s = settings();
    s.width = 160, s.height = 120;
    const auto packed = pack_for(scene, s);
    const DeviceScenes two{on_test_device(packed), std::make_shared<DeviceScene>(part, packed)};
    expect_same_bytes(film_of(two, s, {0, 4}), picture_case::render(test_device(), scene, s, {{0, 4}}),
                      "two devices");
}

TEST(Lifetimes, a_film_goes_on_where_it_was_left) {
    const Scene scene = varied_scene();
    Renderer renderer(test_device(), scene, settings());
    renderer.resume(picture_case::render(test_device(), scene, settings(), {{0, 2}}));
    renderer.render({2, 5}, go_on);
    expect_same_bytes(renderer.film(), picture_case::render(test_device(), scene, settings(), {{0, 5}}),
                      "resumed");
    RenderSettings other = settings();
    other.seed = 77;
    const Film strange = picture_case::render(test_device(), scene, other, {{0, 1}});
    EXPECT_THROW(renderer.resume(strange), Error);
}

TEST(Lifetimes, a_camera_around_the_scene_keeps_its_trees) {
    const Scene scene = varied_scene();
    RenderSettings s = settings();
    auto packed = pack_for(scene, s);
    for (int i = 0; i <= 24; ++i) {
        const double turn = 2 * pi * i / 24;
        s.view = look_at({6 * std::cos(turn), 2, 6 * std::sin(turn)}, {0, 0.5, 0}, 0.7, 37.0 / 29);
        if (i == 0) packed = pack_for(scene, s, packed);
        packed = pack_for(scene, s, packed);
    }
    EXPECT_LE(packed->packings, 2u);
}

TEST(Lifetimes, nodes_of_another_format_are_added_for_the_same_eye) {
    const Scene scene = varied_scene();
    RenderSettings s = settings();
    const auto packed = pack_for(scene, s, {}, {BvhFormat::bvh8});
    EXPECT_TRUE(packed->bvh.nodes4.empty());
    s.view.eye += dvec3(0, 0, 0.01);
    ASSERT_EQ(pack_for(scene, s, packed, {BvhFormat::bvh8}), packed);
    const auto both = pack_for(scene, s, packed, {BvhFormat::bvh4});
    EXPECT_EQ(both->bvh.formats, all_bvh_formats);
    EXPECT_FALSE(both->bvh.nodes4.empty());
    EXPECT_EQ(both->settings.view.eye, packed->settings.view.eye);
    EXPECT_EQ(both->packings, packed->packings);
    EXPECT_EQ(pack_for(scene, s, both, {BvhFormat::bvh8}), both);
}

TEST(Lifetimes, another_eye_shares_what_no_eye_changes) {
    const Scene scene = varied_scene();
    RenderSettings s = settings();
    const auto packed = pack_for(scene, s);
    s.view = look_at({40, 30, 50}, {0, 0, 0}, 0.7, 37.0 / 29);  // beyond where rays were to start
    EXPECT_FALSE(holds_for(*packed, s));
    const auto moved = pack_for(scene, s, packed);
    EXPECT_EQ(moved->packings, 2u);
    EXPECT_EQ(moved->surfaces, packed->surfaces);
    s.spectral = Spectral::full;
    EXPECT_NE(pack_for(scene, s, moved)->surfaces, packed->surfaces) << "wavelengths are packed";
}

TEST(Lifetimes, films_packed_for_different_eyes_do_not_merge) {
    const Scene scene = varied_scene();
    RenderSettings s = settings();
    const auto packed = pack_for(scene, s);
    s.view.eye += dvec3(1e-3, 0, 0);
    ASSERT_TRUE(holds_for(*packed, s));
    const Film kept = film_of({on_test_device(packed)}, s, {0, 2});
    const Film own = picture_case::render(test_device(), scene, s, {{2, 4}});
    EXPECT_NE(kept.settings_text.find("packed_for_eye"), std::string::npos);
    EXPECT_EQ(own.settings_text.find("packed_for_eye"), std::string::npos);
    const std::vector<Film> parts{kept, own};
    EXPECT_THROW(merge(parts), Error);
}

}  // namespace
}  // namespace triad
