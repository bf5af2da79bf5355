// Hard because of numbers: the same scene elsewhere, at other scales, and of both at once.
#include <cmath>
#include <memory>

#include "double_tracer.h"
#include "hard_scene.h"
#include "metric/statistics.h"

namespace triad::hard {
namespace {

constexpr Shot still_life{.width = 40, .height = 30, .spp = 4};

/// Through a lens, so that its size and focus scale too.
Film still(const std::string& name, double scale = 1) {
    const Scene scene = load(name);
    RenderSettings settings = settings_of(scene, still_life);
    settings.view.lens_radius = 0.1 * scale;
    settings.view.focus_distance = 24 * scale;
    return render(scene, settings, still_life.spp);
}

void expect_same_bits(const std::string& what, const Film& a, const Film& b) {
    ASSERT_EQ(a.sums.size(), b.sums.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.sums.size(); ++i) different += a.sums[i] != b.sums[i];
    report(what + ", sums that differ", double(different), 0);
    EXPECT_EQ(different, 0u) << what;
}

TEST_F(Hard, coordinates_at_1e6_change_no_bit) {
    const Film here = still("still_life");
    EXPECT_GT(mean(here, 0, 0, here.width, here.height).y, 0.05);
    expect_same_bits("vertices at 1e6", here, still("still_life_vertices_at_1e6"));
    expect_same_bits("nodes at 1e6", here, still("still_life_nodes_at_1e6"));
}

TEST_F(Hard, scaling_by_powers_of_two_changes_no_bit) {
    const Film whole = still("still_life_2^0");
    for (int k = -20; k <= 20; ++k)
        expect_same_bits("2^" + std::to_string(k), whole,
                         still("still_life_2^" + std::to_string(k), std::ldexp(1.0, k)));
}

/// Pictures of independent seeds.
std::vector<Batch> batches(const std::string& name, std::uint32_t first_seed) {
    const Scene scene = load(name);
    std::vector<Batch> result;
    for (std::uint32_t seed = first_seed; seed < first_seed + 12; ++seed) {
        const Film film = render(scene, {.width = 32, .height = 24, .spp = 16, .seed = seed});
        Batch batch{film.width, film.height, {}};
        for (unsigned y = 0; y < film.height; ++y)
            for (unsigned x = 0; x < film.width; ++x)
                for (int c = 0; c < 3; ++c) batch.rgb.push_back(float(pixel(film, x, y)[c]));
        result.push_back(std::move(batch));
    }
    return result;
}

TEST_F(Hard, coordinates_at_1e_minus_6_show_the_same_picture) {
    // Rounding differs, so the statistics of two independent sets of pictures: wrong once in 1e6.
    const Agreement found =
        compare_pictures(batches("still_life", 1), batches("still_life_of_1e-6", 101), {.tile = 8});
    report("scaled by 1e-6: worst t of " + std::to_string(found.comparisons) + " tile means",
           std::abs(found.worst.t), found.critical_t);
    EXPECT_TRUE(found.agree) << found.sentence();
}

/// Radiance along a camera ray of a scene of Lambert, unlit black and one sun, to the first surface, without
/// bounces.
dvec3 sunlit(const Scene& scene, const DoubleTracer& tracer, const dvec3& eye, const dvec3& direction,
             DoubleHit& hit) {
    hit = tracer.trace(eye, direction);
    if (!hit.found()) return dvec3(0.0);
    const PunctualLight& sun = scene.lights.at(0);
    const dvec3 to_sun = -sun.direction;
    const double cosine = glm::dot(hit.normal, to_sun);
    if (cosine <= 0) return dvec3(0.0);
    const dvec3 at = eye + hit.t * direction + hit.normal * (1e-12 * hit.t);
    if (tracer.trace(at, to_sun, 0, std::numeric_limits<double>::infinity(), true).found()) return dvec3(0.0);
    return dvec3(vec3(tracer.material(hit).base_colour)) * dvec3(sun.colour) * (cosine / pi);
}

dvec3 camera_direction(const View& view, double x, double y, unsigned width, unsigned height) {
    return glm::normalize(view.forward + view.right * ((x / width * 2 - 1) * view.extent.x) -
                          view.up * ((y / height * 2 - 1) * view.extent.y));
}

/// Pixels whose inside is one colour to the referee, by a grid of rays, must have that colour; returns how
/// many they are.
std::size_t expect_sunlit(const std::string& what, const Scene& scene, const DoubleTracer& tracer,
                          const View& view, const Film& film, double tolerance) {
    std::size_t compared = 0, wrong = 0, lit = 0;
    double worst = 0;
    constexpr int grid = 5;
    for (unsigned y = 0; y < film.height; ++y)
        for (unsigned x = 0; x < film.width; ++x) {
            dvec3 first(0.0);
            bool even = true;
            for (int j = 0; j < grid && even; ++j)
                for (int i = 0; i < grid && even; ++i) {
                    DoubleHit hit;
                    const dvec3 seen = sunlit(scene, tracer, view.eye,
                                              camera_direction(view, x + i / (grid - 1.0),
                                                               y + j / (grid - 1.0), film.width, film.height),
                                              hit);
                    if (i + j == 0) first = seen;
                    even = glm::length(seen - first) <= 1e-9 * glm::length(first);
                }
            if (!even) continue;
            ++compared;
            lit += first != dvec3(0.0);
            const double error = glm::length(pixel(film, x, y) - first);
            worst = std::max(worst, error);
            wrong += !(error <= tolerance * std::max(glm::length(first), 1e-3));
        }
    report(what + ", wrong of " + std::to_string(compared) + " even pixels (" + std::to_string(lit) + " lit)",
           double(wrong), 0);
    EXPECT_EQ(wrong, 0u) << what << ": the largest error is " << worst;
    EXPECT_GT(lit, compared / 8) << what;
    return compared;
}

std::size_t expect_sunlit(const std::string& what, const std::string& name, const Shot& shot,
                          double tolerance) {
    const Scene scene = load(name);
    return expect_sunlit(what, scene, DoubleTracer(scene), settings_of(scene, shot).view, render(scene, shot),
                         tolerance);
}

TEST_F(Hard, a_millimetre_stands_and_throws_its_shadow_on_ten_kilometres) {
    const Shot shot{.width = 64, .height = 48, .spp = 16, .max_depth = 2};
    EXPECT_GT(expect_sunlit("kilometres and millimetres", "kilometres_and_millimetres", shot, 1e-4), 2000u);
}

TEST_F(Hard, a_camera_that_comes_down_to_ten_kilometres_sees_right_with_few_packings) {
    const Scene scene = load("kilometres_and_millimetres");
    const DoubleTracer tracer(scene);
    RenderSettings settings = settings_of(scene, {.width = 24, .height = 18, .max_depth = 2});
    const View last = settings.view;
    std::shared_ptr<const PackedScene> packed;
    unsigned views = 0;
    for (double height = 800; height > 0.01; height /= 5) {
        settings.view = last;
        settings.view.eye += last.up * height;
        packed = pack_for(scene, settings, packed);
        for (const double aside : {0.0, 0.02, -0.02}) {
            settings.view.eye = last.eye + (last.up + last.right * aside) * height;
            const auto kept = pack_for(scene, settings, packed);
            EXPECT_EQ(kept, packed) << "a step aside at a height of " << height;
            Renderer renderer(DeviceScenes{std::make_shared<DeviceScene>(test_device(), kept)}, settings);
            renderer.render({0, 16}, [](const Progress&) { return true; });
            expect_sunlit("seen from " + std::to_string(height) + " m", scene, tracer, settings.view,
                          renderer.film(), 1e-4);
            ++views;
        }
    }
    report("coming down to ten kilometres, packings for " + std::to_string(views) + " views",
           packed->packings, views / 3);
    EXPECT_LE(packed->packings, views / 3);
}

TEST_F(Hard, a_sun_at_the_horizon_throws_shadows_a_hundred_times_as_long) {
    // The cosine is 0.01: 1e-6 of it absolute, from rounding of normals, is 1e-4.
    const Shot shot{.width = 64, .height = 48, .spp = 16, .max_depth = 2};
    EXPECT_GT(expect_sunlit("grazing horizon", "horizon", shot, 1e-3), 2000u);
}

/// The share of the picture that the tubes cover, from their silhouettes: none hides another (their ends are
/// rings of six vertices, one after the other).
double covered_by_hairs(const Scene& scene, const View& view) {
    constexpr int rows = 256;
    double covered = 0;
    for (const MeshInstance& instance : scene.instances)
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (scene.materials[p.material].name != "hair") continue;
            for (std::size_t h = 0; h < p.positions.size(); h += 12) {
                double lo[2] = {1e9, 1e9}, hi[2] = {-1e9, -1e9}, at[2] = {};
                for (std::size_t k = 0; k < 12; ++k) {
                    const dvec3 v = transform_point(instance.to_world, dvec3(p.positions[h + k])) - view.eye;
                    const double depth = glm::dot(v, view.forward),
                                 x = glm::dot(v, view.right) / depth / view.extent.x;
                    lo[k / 6] = std::min(lo[k / 6], x), hi[k / 6] = std::max(hi[k / 6], x);
                    at[k / 6] += glm::dot(v, view.up) / depth / view.extent.y / 6;
                }
                for (int row = 0; row < rows; ++row) {
                    const double s = ((row + 0.5) / rows * 2 - 1 - at[0]) / (at[1] - at[0]);
                    const double from = glm::mix(lo[0], lo[1], s), to = glm::mix(hi[0], hi[1], s);
                    covered += std::max(0.0, std::min(to, 1.0) - std::max(from, -1.0)) / 2 / rows;
                }
            }
        }
    return covered;
}

TEST_F(Hard, hairs_cover_their_share_from_afar) {
    const Scene scene = load("hair_far_away");
    const Shot shot{.width = 32, .height = 32, .spp = 256};
    const double covered = covered_by_hairs(scene, settings_of(scene, shot).view);
    report("hairs far away, share covered", covered, 0.1);
    // A hair is 0.1 mm thick, and float places its vertices within 4e-6 m of where they are: 2 % of a
    // silhouette of two sides at random, 0.1 % of the sum of five hundred, a hundredth of that of the light
    // that they leave.
    expect_mean("hairs far away, what they leave", measure(scene, shot, seeds), 1 - covered, 1e-4);
}

}  // namespace
}  // namespace triad::hard
