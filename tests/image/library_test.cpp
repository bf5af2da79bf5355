// The library: what it returns is what the command line writes, and what is wrong is said in one sentence.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/io.h"
#include "program.h"
#include "triad/triad.h"
#include "unit/temporary_folder.h"

namespace api = triad::api;
using triad::TemporaryFolder;

namespace {

api::Film rendered(const api::Options& options, std::uint64_t spp = 4) {
    return api::render(api::Scene(), {.width = 40, .height = 24, .spp = spp, .seed = 3, .options = options});
}

/// The sentence, and the exit code before it.
template <class Work>
std::string refusal(const Work& work) {
    try {
        work();
    } catch (const api::Error& error) {
        return std::to_string(error.exit_code()) + " " + error.what();
    }
    return "nothing was thrown";
}

/// A square of side 2 in the plane z = 0, its front towards +z.
struct Square {
    std::vector<float> positions{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, uvs{0, 1, 1, 1, 1, 0, 0, 0},
        normals{0, 0, 9, 0, 0, 9, 0, 0, 9, 0, 0, 9};
    std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    api::Mesh mesh{
        .name = "square", .positions = positions, .indices = indices, .normals = normals, .uvs = uvs};
};

/// It fills the picture.
const api::Camera near_camera{.eye = {0, 0, 1}, .fov = 60};

}  // namespace

TEST(Library, renders_the_film_of_the_command_line) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), exr = (folder / "a.exr").string();
    ASSERT_EQ(run_triad("render -q --size 40x24 --spp 4 --seed 3 --max-depth 3 --aov depth --film " + film +
                        " -o " + exr)
                  .exit,
              0);
    const api::Film mine = rendered({{"max_depth", "3"}, {"aov", "depth"}});
    mine.save(folder / "b.film");
    EXPECT_TRUE(bytes_of(film) == bytes_of(folder / "b.film"));
    EXPECT_EQ(mine.spp(), 4);
    EXPECT_TRUE(mine.complete());
    EXPECT_GT(mine.relmse().value(), 0);
    EXPECT_EQ(mine.metadata().at("triad:seed"), "3");

    const api::Image image = mine.image(), theirs = api::read_image(exr);
    EXPECT_EQ(image.width, 40u);
    EXPECT_EQ(image.channels, 3u);
    EXPECT_TRUE(image.pixels == theirs.pixels);
    EXPECT_TRUE(mine.layers().at("depth.Z") == triad::read_picture(exr).find("depth.Z")->values);
    EXPECT_TRUE(api::load_film(film).image().pixels == theirs.pixels);

    mine.write({folder / "b.png", folder / "b.exr"}, {{"exposure", "1"}});
    ASSERT_EQ(run_triad("resolve " + film + " --exposure 1 -o " + (folder / "a.png").string()).exit, 0);
    EXPECT_TRUE(api::read_image(folder / "b.png").pixels == api::read_image(folder / "a.png").pixels);
    EXPECT_NE(triad::read_picture(folder / "b.exr").find("depth.Z"), nullptr);
    const api::Bitmap bitmap = mine.bitmap({{"exposure", "1"}});
    const std::vector<float> png = api::read_image(folder / "b.png").pixels;
    ASSERT_EQ(bitmap.bytes.size(), png.size());
    for (std::size_t i = 0; i < png.size(); ++i) ASSERT_EQ(bitmap.bytes[i], std::lround(png[i] * 255));
}

TEST(Library, merges_films_to_the_bits_of_one_run) {
    const auto part = [](const char* samples) {
        return api::render(api::Scene(), {.width = 16, .height = 16, .options = {{"samples", samples}}});
    };
    const api::Film a = part("0:2"), b = part("2:6"), whole = part("0:6");
    EXPECT_TRUE(api::merge({b, a}).image().pixels == whole.image().pixels);
    EXPECT_EQ(refusal([&] { api::merge({a, whole}); }).substr(0, 1), "6");
}

TEST(Library, keeps_a_film_that_the_command_line_goes_on_with) {
    const TemporaryFolder folder;
    const std::string film = (folder / "a.film").string(), scene = TRIAD_SCENES "/cornell/cornell.gltf";
    const api::Film whole =
        api::render(scene, {.width = 64, .height = 36, .spp = 256, .options = {{"max-depth", "3"}}});
    whole.save(folder / "whole.film");
    const api::Film begun = api::render(scene,
                                        {.width = 64,
                                         .height = 36,
                                         .spp = 256,
                                         .options = {{"max-depth", "3"}, {"film", film}, {"strict", "on"}}},
                                        [](const api::Progress&) { return false; });
    EXPECT_FALSE(begun.complete());
    EXPECT_FALSE(api::load_film(film).complete());
    const Outcome resumed = run_triad("render -q -o " + (folder / "a.png").string() + " --resume " + film);
    EXPECT_EQ(resumed.exit, 0) << resumed.output;
    EXPECT_TRUE(bytes_of(film) == bytes_of(folder / "whole.film"));
}

TEST(Library, makes_pictures_for_a_panel) {
    const api::Film film = rendered({{"bins", "3x3"}}, 9);
    const api::Image mean = film.image(), panel = film.image({{"panel", "rgb"}}),
                     mirrored = film.image({{"panel", "bgr"}});
    EXPECT_FALSE(mean.pixels == panel.pixels);
    EXPECT_FALSE(mirrored.pixels == panel.pixels);
    for (const float v : panel.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
    EXPECT_EQ(rendered({{"panel", "rgb"}}, 9).metadata().at("triad:panel"), "rgb");
    EXPECT_TRUE(rendered({{"panel", "rgb"}}, 9).image().pixels == panel.pixels);
}

// More choices than are kept, a render within a render's report, and one that fails.
TEST(Library, devices_that_stay_open_change_no_bit) {
    const std::vector<float> first = rendered({}).image().pixels;
    for (const api::Options& options : std::vector<api::Options>{
             {{"format", "bvh4"}}, {{"driver", "wave"}}, {{"threads", "1"}}, {{"driver", "wave-stages"}}, {}})
        EXPECT_TRUE(rendered(options).image().pixels == first);
    std::vector<float> within;
    api::render(api::Scene(), {.width = 40, .height = 24, .spp = 4}, [&](const api::Progress&) {
        if (within.empty()) within = rendered({}).image().pixels;
        return true;
    });
    EXPECT_TRUE(within == first);
    EXPECT_EQ(refusal([] { rendered({{"camera", "none such"}}); }).substr(0, 2), "1 ");
    EXPECT_TRUE(rendered({}).image().pixels == first);
}

TEST(Library, films_know_whether_they_are_complete) {
    const TemporaryFolder folder;
    const auto stop = [](const api::Progress&) { return false; };
    const api::Film timed =
        api::render(api::Scene(), {.width = 32, .height = 18, .options = {{"time", "0.2"}}});
    EXPECT_TRUE(timed.complete());
    timed.save(folder / "timed.film");
    EXPECT_TRUE(api::load_film(folder / "timed.film").complete()) << "its time was its goal";
    const api::Film begun =
        api::render(api::Scene(), {.width = 40, .height = 24, .spp = 1u << 20, .seed = 3}, stop);
    EXPECT_FALSE(api::merge({begun}).complete());
    EXPECT_TRUE(api::merge({rendered({})}).complete());
}

TEST(Library, stops_when_the_report_says_so) {
    int calls = 0;
    const api::Film film = api::render(api::Scene(), {.width = 64, .height = 36, .spp = 1000000},
                                       [&](const api::Progress& progress) {
                                           EXPECT_GE(progress.done, 0);
                                           EXPECT_GT(progress.spp, 0);
                                           return ++calls < 3;
                                       });
    EXPECT_EQ(calls, 3);
    EXPECT_FALSE(film.complete());
    EXPECT_GT(film.spp(), 0);
    EXPECT_LT(film.spp(), 1000000);
}

TEST(Library, gives_back_what_the_report_throws) {
    EXPECT_THROW(api::render(api::Scene(), {.width = 8, .height = 8, .spp = 1000000},
                             [](const api::Progress&) -> bool { throw std::out_of_range("mine"); }),
                 std::out_of_range);
}

TEST(Library, renders_arrays_to_known_answers) {
    const Square square;
    const api::Material lamp{.base_colour = {0, 0, 0, 1}, .emission = {1, 2, 0.5f}};
    const api::Scene scene = api::make_scene({&square.mesh, 1}, {&lamp, 1}, near_camera);
    EXPECT_EQ(scene.triangles(), 2u);
    EXPECT_EQ(scene.bounds().value(), (std::array<double, 6>{-1, -1, 0, 1, 1, 0}));
    const api::Image lit =
        api::render(scene, {.width = 8, .height = 8, .spp = 4, .options = {{"max-depth", "1"}}}).image();
    for (std::size_t i = 0; i < lit.pixels.size(); ++i)
        EXPECT_NEAR(lit.pixels[i], lamp.emission[i % 3], 1e-5) << i;
}

/// In even light of radiance 1 a matte surface has the radiance of its albedo.
TEST(Library, lays_textures_on_arrays) {
    const Square square;
    const std::vector<std::uint8_t> texels{0, 255, 0, 255, 255, 255, 0, 255,
                                           0, 255, 0, 255, 255, 255, 0, 255};
    const api::Material material{.base_colour = {0.5f, 0.5f, 1, 1},
                                 .base_colour_texture = api::Texture{2, 2, texels}};
    const api::Scene scene = api::make_scene({&square.mesh, 1}, {&material, 1}, near_camera);
    const api::Settings settings{.width = 2,
                                 .height = 2,
                                 .spp = 64,
                                 .options = {{"look", "white"}, {"ground", "off"}, {"crop", "0,0,2,1"}}};
    // The view spans +-0.577, so that with interpolation left is darker, and right brighter.
    const api::Image image = api::render(scene, settings).image();
    const float white = image.pixels[1] / 0.5f;
    EXPECT_GT(white, 0);
    EXPECT_LT(image.pixels[0], 0.25f * white);
    EXPECT_GT(image.pixels[3], 0.25f * white);
    EXPECT_NEAR(image.pixels[1], image.pixels[4], 0.1f * white);
    EXPECT_LT(image.pixels[2], 0.06f * white);  // varnish alone reflects blue
}

TEST(Library, compares_pictures) {
    const api::Image a{2, 1, 3, {0, 0, 0, 0, 0, 0}}, b{2, 1, 4, {1, 1, 1, 1, 0, 0, 0, 1}};
    const api::Comparison c = api::compare(a, b);
    EXPECT_NEAR(c.rmse, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(c.mae, 0.5, 1e-6);
    EXPECT_NEAR(c.relmse, 0.5 / 1.01, 1e-6);
    EXPECT_NEAR(c.psnr, 10 * std::log10(2), 1e-5);
    EXPECT_GT(c.flip, 0.1);
    EXPECT_EQ(api::compare(a, a).flip, 0);
    EXPECT_EQ(refusal([&] {
                  api::compare(a, {1, 1, 3, {0, 0, 0}});
              }),
              "7 The pictures differ in size: one is 2x1, the reference is 1x1.");
    EXPECT_EQ(refusal([&] { api::compare(a, {2, 1, 3, {0, 0, 0}}); }).substr(0, 1), "1");
}

TEST(Library, tells_what_an_eye_sees_as_the_command_line_does) {
    const TemporaryFolder folder;
    const std::string a = (folder / "a.exr").string(), b = (folder / "b.exr").string(),
                      json = (folder / "c.json").string();
    const api::Film film =
        api::render(api::Scene(), {.width = 96, .height = 64, .spp = 9, .options = {{"panel", "rgb"}}});
    const api::Film reference = api::render(
        api::Scene(), {.width = 288, .height = 192, .spp = 2, .options = {{"reconstruct", "pane:1"}}});
    film.write(a), reference.write(b);
    const Outcome compared =
        run_triad("compare " + a + " " + b + " --metric perceived --panel rgb --eye sharp --json " + json);
    ASSERT_EQ(compared.exit, 0) << compared.output;
    const auto row = nlohmann::json::parse(bytes_of(json)).at("rows").at(0).at("perceived").at(0);
    const api::Perceived seen = api::perceived(film.image(), reference.image(), "rgb", 0, "sharp");
    EXPECT_GT(seen.error, 0);
    EXPECT_NEAR(seen.error, row.at("error").get<double>(), 1e-6 * seen.error);
    EXPECT_NEAR(seen.de_p95, row.at("de_p95").get<double>(), 1e-6 * seen.de_p95);
    EXPECT_NE(refusal([&] { api::perceived(film.image(), reference.image(), "rgb", 0, "cat"); }).find("cat"),
              std::string::npos);
    EXPECT_EQ(refusal([&] { api::perceived(reference.image(), film.image(), "rgb"); }).substr(0, 1), "7");
}

TEST(Library, filters_a_larger_picture) {
    const api::Image bins{2, 2, 3, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1}};
    const api::Image mean = api::reconstruct(bins, {{"bins", "2x2"}});
    ASSERT_EQ(mean.pixels.size(), 3u);
    EXPECT_NEAR(mean.pixels[0], 0.5f, 1e-6);
    EXPECT_NEAR(mean.pixels[2], 0.25f, 1e-6);
}

TEST(Library, exposes_pictures_by_themselves) {
    const api::Image dark{2, 2, 3, std::vector<float>(12, 0.01f)};
    const auto shown = [&](const char* exposure) {
        return api::reconstruct(dark, {{"reconstruct", "pane:1"}, {"exposure", exposure}}).pixels[0];
    };
    EXPECT_GT(shown("auto"), 5 * shown("0"));
    const api::Film film = rendered({{"exposure", "auto"}});
    EXPECT_FALSE(film.bitmap().bytes == film.bitmap({{"exposure", "0"}}).bytes);
}

TEST(Library, says_what_there_is) {
    ASSERT_FALSE(api::devices().empty());
    bool chosen = false;
    for (const api::Device& device : api::devices()) chosen = chosen || (device.chosen && device.usable);
    EXPECT_TRUE(chosen);
    EXPECT_EQ(api::panels().front().name, "rgb");
    EXPECT_EQ(api::version(), TRIAD_VERSION);
    int reports = 0;
    const auto rows = api::check("", "quick", {"M1", "M3"}, [&](const api::CheckResult&) {
        ++reports;
        return true;
    });
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(reports, 2);
    EXPECT_EQ(rows[0].right, std::optional(true)) << rows[0].value;
}

TEST(Library, says_what_is_wrong_in_a_sentence) {
    const api::Scene scene;
    const auto of_options = [&](const api::Options& options) {
        return refusal([&] { api::render(scene, {.width = 8, .height = 8, .spp = 1, .options = options}); });
    };
    EXPECT_EQ(of_options({{"max-dept", "3"}}), "1 There is no option 'max-dept'. Did you mean 'max-depth'?");
    EXPECT_EQ(
        of_options({{"variant", "red"}}),
        "1 --variant decides what of a file is loaded: give it to load(), or the file's name to render().");
    EXPECT_NE(of_options({{"output", "a.png"}}).find("for the command line"), std::string::npos);
    EXPECT_NE(of_options({{"max-depth", "many"}}).find("--max-depth"), std::string::npos);
    EXPECT_NE(of_options({{"spp", "4"}}).find("among the options and beside them"), std::string::npos);
    EXPECT_NE(of_options({{"env", ""}}).find("a value is missing"), std::string::npos);
    EXPECT_EQ(refusal([&] { api::render(scene, {.width = 8}); }),
              "1 A picture needs width and height, or neither.");
    EXPECT_EQ(refusal([] { api::load("/no/such.glb"); }).substr(0, 1), "2");
    EXPECT_EQ(refusal([] {
                  api::load("/no/such.glb", {{"spp", "4"}});
              }),
              "1 --spp is an option of render(), not of load().");
    EXPECT_EQ(refusal([] { api::load_film("/no/such.film"); }).substr(0, 1), "2");
    EXPECT_EQ(refusal([] { api::set_verbosity(7); }).substr(0, 1), "1");
    EXPECT_EQ(refusal([] { api::check("", "slow"); }).substr(0, 1), "1");
    EXPECT_EQ(refusal([] { api::render(api::make_scene({}), {.width = 8, .height = 8}); }).substr(0, 1), "2");
}

TEST(Library, names_the_array_at_fault) {
    const Square square;
    const auto of_mesh = [](const api::Mesh& mesh) { return refusal([&] { api::make_scene({&mesh, 1}); }); };
    const std::vector<float> four{0, 0, 0, 0};
    const std::vector<float> nothing(12);
    const std::vector<std::uint32_t> beyond{0, 1, 4};
    api::Mesh mesh = square.mesh;
    mesh.positions = four;
    EXPECT_EQ(of_mesh(mesh), "2 The positions of Mesh 0 'square' have 4 values, which is no multiple of 3.");
    mesh = square.mesh, mesh.indices = beyond;
    EXPECT_EQ(of_mesh(mesh), "2 The indices of Mesh 0 'square' include 4, and it has 4 vertices.");
    mesh = square.mesh, mesh.normals = std::span(square.normals).first(3);
    EXPECT_EQ(of_mesh(mesh), "2 The normals of Mesh 0 'square' are 1, and its positions 4.");
    mesh = square.mesh, mesh.normals = nothing;
    EXPECT_EQ(of_mesh(mesh), "2 The normals of Mesh 0 'square' include one without a direction.");
    mesh = square.mesh, mesh.material = 1;
    EXPECT_EQ(of_mesh(mesh), "2 Mesh 0 'square' has material 1, and there are 1.");
    mesh = square.mesh, mesh.to_world[3] = 1;
    EXPECT_NE(of_mesh(mesh).find("last row"), std::string::npos);
    EXPECT_EQ(of_mesh(square.mesh), "nothing was thrown");
    const api::Material metal{.metallic = 2};
    EXPECT_NE(refusal([&] { api::make_scene({}, {&metal, 1}); }).find("Material 0"), std::string::npos);
    EXPECT_EQ(refusal([&] {
                  api::make_scene({&square.mesh, 1}, {}, api::Camera{.target = {0, 0, 5}});
              }),
              "2 The camera has eye and target in one place, or looks along its up.");
}
