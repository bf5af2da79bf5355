// Indices of refraction: the catalogue against its makers' numbers, and what files and command lines may say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "gltf_builder.h"
#include "session/prepare.h"

namespace triad {
namespace {

double index(const char* glass, double nanometres) { return find_glass(glass)->index(nanometres); }

TEST(Glass, catalogue_has_the_makers_index_and_abbe_number) {
    const struct {
        const char* name;
        double nd, vd;
    } table[] = {{"SF10", 1.72825, 28.41},   {"N-SF10", 1.72828, 28.53},       {"SF11", 1.78472, 25.76},
                 {"N-SF11", 1.78472, 25.68}, {"N-BK7", 1.51680, 64.17},        {"F2", 1.62004, 36.37},
                 {"SF6", 1.80518, 25.43},    {"N-LASF9", 1.85025, 32.17},      {"diamond", 2.41749, 55.30},
                 {"water", 1.33340, 55.76},  {"fused-silica", 1.45846, 67.82}, {"cubo", 1.53984, 6.93}};
    for (const auto& g : table) {
        EXPECT_NEAR(index(g.name, line_d), g.nd, 6e-6) << g.name;
        EXPECT_NEAR(find_glass(g.name)->abbe_number(), g.vd, 6e-3) << g.name;
    }
}

TEST(Glass, indices_at_other_lines_are_the_catalogues) {
    EXPECT_NEAR(index("SF10", 404.66), 1.77579, 6e-6);
    EXPECT_NEAR(index("SF10", 706.52), 1.71681, 6e-6);
    EXPECT_NEAR(index("N-BK7", 546.07), 1.51872, 6e-6);
    EXPECT_NEAR(index("water", 632.8), 1.33211, 6e-6);
    EXPECT_NEAR(index("cubo", 400), 1.69412, 6e-6);
}

TEST(Glass, two_terms_of_cauchy_keep_index_and_dispersion_of_sf10) {
    // The pair 1.7280, .01342 that is often copied has n_d 1.76687.
    EXPECT_NEAR(index("SF10-cauchy", line_d), index("SF10", line_d), 2e-5);
    EXPECT_NEAR(index("SF10-cauchy", line_F) - index("SF10-cauchy", line_C),
                index("SF10", line_F) - index("SF10", line_C), 2e-5);
}

TEST(Glass, the_fit_of_cubo_differs_by_little_more_than_a_thousandth) {
    double most = 0;
    for (double w = shortest_wavelength; w <= longest_wavelength; w += 1)
        most = std::max(most, std::abs(index("cubo", w) - index("cubo-sellmeier", w)));
    EXPECT_NEAR(most, 1.14e-3, 1e-5);
}

TEST(Glass, khr_dispersion_keeps_the_abbe_number_it_was_given) {
    const Dispersion d = abbe_dispersion(1.5168, 20 / 64.17);
    EXPECT_NEAR(d.index(line_d), 1.5168, 1e-6);
    EXPECT_NEAR(d.abbe_number(), 64.17, 0.02);
    EXPECT_EQ(abbe_dispersion(1.05, 1e6).index(780), 1.0) << "never below that of nothing";
}

TEST(Glass, names_are_found_however_they_are_written) {
    EXPECT_TRUE(find_glass("n-bk7"));
    EXPECT_TRUE(find_glass("Fused Silica"));
    EXPECT_TRUE(find_glass("cubo_sellmeier"));
    EXPECT_FALSE(find_glass("SF99"));
    EXPECT_FALSE(find_glass(""));
}

TEST(Glass, every_glass_of_the_catalogue_is_sane_and_in_the_schema) {
    const auto bytes = read_file(TRIAD_SOURCE_DIR "/docs/schema/extras.schema.json");
    const auto schema = nlohmann::json::parse(bytes.begin(), bytes.end());
    std::vector<std::string> names;
    for (const Glass& g : glass_catalogue()) {
        EXPECT_TRUE(g.dispersion.is_sane()) << g.name;
        names.push_back(g.name);
    }
    EXPECT_EQ(schema["properties"]["glass"]["enum"].get<std::vector<std::string>>(), names);
}

using nlohmann::json;

/// A triangle of glass with these extras and extensions beside transmission and volume.
GltfBuilder& with_glass(GltfBuilder& b, const json& extras, const json& extensions = json::object(),
                        double thickness = 1) {
    b.triangle().primitive()["material"] = 0;
    json all = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                {"KHR_materials_volume", {{"thicknessFactor", thickness}}}};
    all.update(extensions);
    b.document["materials"] = json::array({{{"name", "prism"}, {"extensions", all}, {"extras", extras}}});
    return b;
}

Material loaded(const json& extras, const json& extensions = json::object(), double thickness = 1,
                std::size_t warnings = 0) {
    GltfBuilder b;
    const Scene scene = with_glass(b, extras, extensions, thickness).load();
    EXPECT_EQ(b.report.warnings.size(), warnings);
    return scene.materials.at(0);
}

json triad(const json& members) { return {{"triad", members}}; }

TEST(GlassInFiles, extras_and_extension_arrive) {
    const Material sf10 = loaded(triad({{"glass", "SF10"}, {"priority", 2}}));
    ASSERT_TRUE(sf10.dispersion);
    EXPECT_NEAR(sf10.ior, 1.72825, 6e-6);
    EXPECT_EQ(sf10.priority, 2u);
    EXPECT_NEAR(loaded(triad({{"cauchy", {1.5, 0.004}}})).dispersion->index(500), 1.516, 1e-9);
    const Material own = loaded(triad({{"sellmeier", {{"B", {1.0, 0.2}}, {"C", {0.01, 0.02}}}}}));
    EXPECT_NEAR(own.dispersion->index(500), std::sqrt(1 + .25 / .24 + .2 * .25 / .23), 1e-9);
    const Material khr = loaded(json::object(), {{"KHR_materials_ior", {{"ior", 1.6}}},
                                                 {"KHR_materials_dispersion", {{"dispersion", 0.5}}}});
    EXPECT_NEAR(khr.dispersion->abbe_number(), 40, 0.02);
    EXPECT_FALSE(loaded(json::object(), {{"KHR_materials_dispersion", {{"dispersion", 0}}}}).dispersion);
    EXPECT_FALSE(loaded(42).dispersion) << "extras belong to everybody";
}

TEST(GlassInFiles, dispersion_without_volume_is_left_out_with_a_warning) {
    EXPECT_FALSE(loaded(triad({{"glass", "SF10"}}), json::object(), 0, 1).dispersion);
    EXPECT_FALSE(
        loaded(json::object(), {{"KHR_materials_dispersion", {{"dispersion", 0.5}}}}, 0, 1).dispersion);
    EXPECT_FALSE(
        loaded(json::object(),
               {{"KHR_materials_ior", {{"ior", 0}}}, {"KHR_materials_dispersion", {{"dispersion", 0.5}}}}, 1,
               1)
            .dispersion);
    loaded(triad({{"glas", "SF10"}}), json::object(), 1, 1);
}

TEST(GlassInFiles, dispersion_without_volume_says_what_is_missing) {
    GltfBuilder b;
    with_glass(b, triad({{"glass", "SF10"}}), json::object(), 0).load();
    const std::string said = b.report.warnings.at(0);
    for (const char* words :
         {"'prism'", "KHR_materials_transmission", "KHR_materials_volume", "it is left out"})
        EXPECT_NE(said.find(words), std::string::npos) << said;
}

TEST(GlassInFiles, an_index_that_no_body_has_is_a_warning) {
    const struct {
        double ior;
        float used;
        const char* words;
    } cases[] = {{0.5, 1.0f, "has an ior below 1, which is taken as 1"},
                 {1000, 1000.0f, "has an ior above 10, which no transparent material has"}};
    for (const auto& c : cases) {
        GltfBuilder b;
        const Scene scene = with_glass(b, json::object(), {{"KHR_materials_ior", {{"ior", c.ior}}}}).load();
        EXPECT_EQ(scene.materials.at(0).ior, c.used);
        ASSERT_EQ(b.report.warnings.size(), 1u);
        EXPECT_NE(b.report.warnings[0].find(c.words), std::string::npos) << b.report.warnings[0];
        EXPECT_NE(b.report.warnings[0].find("'prism'"), std::string::npos) << b.report.warnings[0];
    }
}

TEST(GlassInFiles, numbers_of_extensions_that_cannot_be_are_errors) {
    const struct {
        json extensions;
        const char* words;
    } cases[] = {
        {{{"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", -1}}}},
         "attenuationDistance"},
        {{{"KHR_materials_ior", {{"ior", -1.5}}}}, "ior"},
        {{{"KHR_materials_dispersion", {{"dispersion", -0.3}}}}, "dispersion"},
        {{{"KHR_materials_ior", {{"ior", 1000}}}, {"KHR_materials_dispersion", {{"dispersion", 0.3}}}},
         "index of refraction outside 1 to 10"}};
    for (const auto& c : cases) {
        GltfBuilder b;
        try {
            Scene scene = with_glass(b, json::object(), c.extensions).load();
            validate(scene);
            ADD_FAILURE() << c.extensions;
        } catch (const Error& e) {
            EXPECT_EQ(e.exit(), Exit::scene);
            EXPECT_NE(std::string(e.what()).find(c.words), std::string::npos) << e.what();
            EXPECT_EQ(std::string(e.what()).back(), '.') << e.what();
        }
    }
}

TEST(GlassInFiles, what_is_malformed_is_refused_with_a_sentence) {
    const struct {
        json extras;
        const char* words;
    } cases[] = {{{{"triad", "SF10"}}, "extras.triad is not an object"},
                 {triad({{"glass", "SF99"}}), "there are SF10, N-SF10"},
                 {triad({{"glass", 10}}), "extras.triad.glass is not a string"},
                 {triad({{"cauchy", {1.5}}}), "not an array of 2 to 3 finite numbers"},
                 {triad({{"cauchy", json::array()}}), "extras.triad.cauchy is empty"},
                 {triad({{"glass", nullptr}}), "extras.triad.glass is empty"},
                 {triad({{"sellmeier", {{"B", json::array()}, {"C", {0.1}}}}}), "sellmeier.B is empty"},
                 {triad({{"cauchy", {1.5, "x"}}}), "not an array of 2 to 3 finite numbers"},
                 {triad({{"cauchy", {0.9, 0.001}}}), "outside 1 to 10"},
                 {triad({{"cauchy", {15, 0}}}), "outside 1 to 10"},
                 {triad({{"sellmeier", {{"B", {1.0}}}}}), "is not an object with"},
                 {triad({{"sellmeier", {{"B", {1.0}}, {"C", {0.1, 0.2}}}}}), "different number"},
                 {triad({{"sellmeier", {{"B", {1.0}}, {"C", {0.3}}}}}), "outside 1 to 10"},
                 {triad({{"glass", "F2"}, {"cauchy", {1.5, 0}}}), "only one of"},
                 {triad({{"priority", -1}}), "whole number from 0 to 255"},
                 {triad({{"priority", 1.5}}), "whole number from 0 to 255"},
                 {triad({{"priority", "high"}}), "whole number from 0 to 255"}};
    for (const auto& c : cases) {
        GltfBuilder b;
        try {
            with_glass(b, c.extras).load();
            ADD_FAILURE() << c.extras;
        } catch (const Error& e) {
            EXPECT_EQ(e.exit(), Exit::scene);
            EXPECT_NE(std::string(e.what()).find(c.words), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find("'prism'"), std::string::npos) << e.what();
        }
    }
}

TEST(GlassOnTheCommandLine, finds_its_material_or_says_what_there_is) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[0].name = scene.materials[1].name = "a=b";
    scene.materials[0].transmission = scene.materials[1].transmission = 1;
    scene.materials[0].thickness = scene.materials[1].thickness = 1;
    scene.materials[2].name = "wall";
    apply_glass(scene, "a=b=N-BK7");
    for (int i : {0, 1}) {
        ASSERT_TRUE(scene.materials[i].dispersion);
        EXPECT_NEAR(scene.materials[i].ior, 1.5168, 1e-5);
    }
    const struct {
        const char *text, *words;
    } cases[] = {{"a", "expected MATERIAL=NAME"},
                 {"=SF10", "expected MATERIAL=NAME"},
                 {"a=b=", "expected MATERIAL=NAME"},
                 {"a=b=SF99", "there are SF10"},
                 {"floor=SF10", "there are 'a=b', 'a=b', 'wall'"},
                 {"wall=SF10", "no solid body that transmits"}};
    for (const auto& c : cases) try {
            apply_glass(scene, c.text);
            ADD_FAILURE() << c.text;
        } catch (const Error& e) {
            EXPECT_EQ(e.exit(), Exit::usage);
            EXPECT_NE(std::string(e.what()).find(c.words), std::string::npos) << e.what();
        }
}

}  // namespace
}  // namespace triad
