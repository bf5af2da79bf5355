// Spectra of lights: their colours against closed forms, and what files may say.
#include <gtest/gtest.h>

#include <cmath>

#include "base/files.h"
#include "gltf_builder.h"
#include "pack/pack.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

using Law = LightSpectrum::Law;
using nlohmann::json;

LightSpectrum blackbody(double kelvin) { return {Law::blackbody, kelvin, {}}; }
LightSpectrum lines(std::vector<LightSpectrum::Line> list) { return {Law::lines, 0, std::move(list)}; }

/// What pack_spectrum makes of a light of this spectrum.
dvec3 colour_of(const LightSpectrum& spectrum, Spectral spectral = Spectral::off) {
    Scene scene;
    scene.lights.push_back({.spectrum = spectrum});
    PackedSurfaces packed;
    RenderSettings settings;
    settings.spectral = spectral;
    pack_spectrum(scene, settings, packed);
    return packed.light_spectra.at(0).colour;
}

dvec3 xyz_of(const dvec3& rec709) { return glm::inverse(rec709_from_xyz()) * rec709; }

void expect_near(const dvec3& found, const dvec3& expected, double bound, const std::string& what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], bound) << what << ", channel " << c;
}

TEST(LightSpectrum, white_of_d65_by_the_table_is_one) {
    const dvec3 xyz = integrate_rows(
        [](int i) { return dvec3(cie_1931[i][0], cie_1931[i][1], cie_1931[i][2]) * cie_d65[i]; });
    expect_near(rec709_from_xyz() * (xyz / xyz.y), dvec3(1.0), 1e-5, "D65");
    expect_near(xyz / xyz.y, {.95043, 1, 1.08880}, 1e-4, "XYZ of D65");
}

TEST(LightSpectrum, every_spectrum_has_luminance_one) {
    for (const LightSpectrum& s : {LightSpectrum{}, blackbody(500), blackbody(2856), blackbody(1e6),
                                   lines({{380, 1}}), lines({{780, 1}}), lines({{404.66, 1}, {589.3, 4}})})
        EXPECT_NEAR(xyz_of(colour_of(s)).y, 1, 1e-6);
}

TEST(LightSpectrum, equal_energy_has_the_integrals_of_the_observer) {
    const dvec3 xyz =
        integrate_rows([](int i) { return dvec3(cie_1931[i][0], cie_1931[i][1], cie_1931[i][2]); });
    expect_near(colour_of({}), rec709_from_xyz() * (xyz / xyz.y), 1e-3, "E");
    expect_near(colour_of({}), {1.205, .948, .909}, 1.5e-3, "published");
}

TEST(LightSpectrum, black_bodies_have_the_colour_that_plancks_law_gives) {
    for (const double kelvin : {1000.0, 2855.5, 6504.0, 20000.0}) {
        dvec3 xyz(0.0);
        for (int i = 0; i < 4000; ++i) {  // the formula as it is in the books, in metres
            const double w = 380.05 + 0.1 * i, metres = w * 1e-9;
            const double planck =
                1 / (std::pow(metres, 5) * (std::exp(0.01438776877 / (metres * kelvin)) - 1));
            const int row = int((w - 380) / 5);
            const double t = (w - 380) / 5 - row;
            const auto& a = cie_1931[row];
            const auto& b = cie_1931[row + 1];
            for (int c = 0; c < 3; ++c) xyz[c] += planck * ((1 - t) * a[c] + t * b[c]);
        }
        expect_near(xyz_of(colour_of(blackbody(kelvin))), xyz / xyz.y, 1e-3, std::to_string(kelvin) + " K");
    }
    const dvec3 a = xyz_of(colour_of(blackbody(2855.5)));
    EXPECT_NEAR(a.x / (a.x + a.y + a.z), .44758, 3e-4) << "illuminant A";
    EXPECT_NEAR(a.y / (a.x + a.y + a.z), .40745, 3e-4) << "illuminant A";
}

TEST(LightSpectrum, lines_have_the_observers_response_by_their_power) {
    const auto response = [](int row) { return dvec3(cie_1931[row][0], cie_1931[row][1], cie_1931[row][2]); };
    const dvec3 green = response(30), red = response(54);  // 530 and 650 nm
    const dvec3 sum = green + 3.0 * red;
    expect_near(xyz_of(colour_of(lines({{530, 1}, {650, 3}}))), sum / sum.y, 0.02, "two lines");
    for (const double end : {380.0, 780.0}) {  // the half of a line that is cut off does not weaken it
        const dvec3 found = xyz_of(colour_of(lines({{530, 1e-6}, {end, 1}})));
        const dvec3 both = 1e-6 * green + response(end == 380 ? 0 : 80);
        expect_near(found, both / both.y, 0.02 * glm::length(both / both.y), "a line at the end");
    }
}

TEST(LightSpectrum, one_spectrum_is_packed_once_and_only_for_lights) {
    Scene scene;
    scene.lights = {
        {.spectrum = blackbody(3000)}, {.spectrum = blackbody(3000)}, {.spectrum = lines({{532, 1}})}};
    scene.materials.resize(2);
    scene.materials[0].emission = vec3(2.0f);
    scene.materials[0].emission_spectrum = blackbody(3000);
    scene.materials[1].emission_spectrum = blackbody(4000);  // emits nothing
    for (const bool full : {false, true}) {
        PackedSurfaces packed;
        RenderSettings settings;
        settings.spectral = full ? Spectral::full : Spectral::automatic;
        pack_materials(scene, {}, packed);
        pack_spectrum(scene, settings, packed);
        EXPECT_EQ(packed.light_spectra.size(), 2u);
        EXPECT_EQ(packed.spectrum.size(), full ? 3u : 0u) << "without wavelengths colours say it all";
        const LightColour c = light_colour(packed, blackbody(3000));
        EXPECT_EQ(c.index != 0, full);
        EXPECT_EQ(packed.materials[0].emission[0], 2 * (full ? 1.0f : c.seen.x));
    }
}

/// A triangle that shines, beside a lamp, with these extras.
GltfBuilder& with_light(GltfBuilder& b, const json& of_material, const json& of_light) {
    b.triangle().primitive()["material"] = 0;
    b.document["materials"] =
        json::array({{{"name", "tube"}, {"emissiveFactor", {1, 1, 1}}, {"extras", of_material}}});
    b.document["extensionsUsed"] = {"KHR_lights_punctual"};
    b.document["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "point"}, {"name", "bulb"}, {"extras", of_light}}});
    b.document["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return b;
}

json spectrum(const json& value) { return {{"triad", {{"spectrum", value}}}}; }

TEST(LightSpectrumInFiles, arrives_at_materials_and_lights) {
    const struct {
        json value;
        LightSpectrum expected;
    } cases[] = {{"E", {}},
                 {{{"blackbody", 3000}}, blackbody(3000)},
                 {{{"laser", 532}}, lines({{532, 1}})},
                 {{{"lines", {{404.66, 1}, {546.07, 2.5}}}}, lines({{404.66, 1}, {546.07, 2.5}})}};
    for (const auto& c : cases) {
        GltfBuilder b;
        const Scene scene = with_light(b, spectrum(c.value), spectrum(c.value)).load();
        EXPECT_TRUE(b.report.warnings.empty());
        EXPECT_EQ(scene.materials.at(0).emission_spectrum, c.expected) << c.value;
        EXPECT_EQ(scene.lights.at(0).spectrum, c.expected) << c.value;
    }
}

TEST(LightSpectrumInFiles, d65_is_what_every_light_has) {
    GltfBuilder with, without;
    const Scene d65 = with_light(with, spectrum("D65"), spectrum("D65")).load();
    EXPECT_EQ(hash_of(d65), hash_of(with_light(without, 42, 42).load()));
    GltfBuilder e;
    EXPECT_NE(hash_of(d65), hash_of(with_light(e, 42, spectrum("E")).load()));
}

TEST(LightSpectrumInFiles, what_cannot_shine_or_is_not_known_is_a_warning) {
    GltfBuilder b;
    with_light(b, spectrum("E"), {{"triad", {{"spectra", "E"}}}});
    b.document["materials"][0].erase("emissiveFactor");
    b.load();
    EXPECT_EQ(b.report.warnings.size(), 2u);
}

TEST(LightSpectrumInFiles, what_is_malformed_is_refused_with_a_sentence) {
    const struct {
        json value;
        const char* words;
    } cases[] = {
        {"A", "is 'A', which is not known; there are D65, E, {\"blackbody\": KELVIN}"},
        {42, "is none of D65, E"},
        {json::object(), "extras.triad.spectrum is empty"},
        {{{"laser", 532}, {"blackbody", 3000}}, "is none of D65, E"},
        {{{"led", 450}}, "spectrum.led is not known; there are D65, E"},
        {{{"laser", 379.5}}, "is 379.5 nm, which is not visible; give a wavelength from 380 to 780 nm"},
        {{{"laser", 1064}}, "is 1064 nm, which is not visible"},
        {{{"laser", "green"}}, "spectrum.laser is not a finite number"},
        {{{"blackbody", 0}}, "is 0 K; give a temperature from 500"},
        {{{"blackbody", -3000}}, "is -3000 K; give a temperature"},
        {{{"blackbody", 1e9}}, "is 1e+09 K; give a temperature"},
        {{{"blackbody", nullptr}}, "extras.triad.spectrum.blackbody is empty"},
        {{{"lines", json::array()}}, "extras.triad.spectrum.lines is empty"},
        {{{"lines", 589}}, "is not an array of 1 to 1000 pairs [NM, POWER]"},
        {{{"lines", {589, 1}}}, "spectrum.lines[0] is not an array of 2 finite numbers"},
        {{{"lines", {{589, 1}, {590}}}}, "spectrum.lines[1] is not an array of 2 finite numbers"},
        {{{"lines", {{589, 1}, {800, 1}}}}, "spectrum.lines[1] is 800 nm, which is not visible"},
        {{{"lines", {{589, -1}}}}, "spectrum.lines[0] has a power of -1"},
        {{{"lines", {{589, 0}}}}, "has no power at all"}};
    for (const auto& c : cases)
        for (const bool material : {false, true}) {
            GltfBuilder b;
            try {
                with_light(b, material ? spectrum(c.value) : json(42),
                           material ? json(42) : spectrum(c.value))
                    .load();
                ADD_FAILURE() << c.value;
            } catch (const Error& e) {
                const std::string said = e.what();
                EXPECT_EQ(e.exit(), Exit::scene);
                EXPECT_NE(said.find(c.words), std::string::npos) << said;
                EXPECT_NE(said.find(material ? "'tube'" : "'bulb'"), std::string::npos) << said;
            }
        }
    GltfBuilder b;
    EXPECT_THROW(with_light(b, 42, {{"triad", "E"}}).load(), Error);
}

TEST(LightSpectrumInFiles, the_schema_knows_the_names_and_limits) {
    const auto bytes = read_file(TRIAD_SOURCE_DIR "/docs/schema/extras.schema.json");
    const json schema = json::parse(bytes.begin(), bytes.end());
    const json& spectrum = schema["$defs"]["spectrum"]["oneOf"];
    EXPECT_EQ(spectrum[0]["enum"], json({"D65", "E"}));
    const json& kelvin = spectrum[1]["properties"]["blackbody"];
    EXPECT_EQ(kelvin["minimum"], LightSpectrum::least_temperature);
    EXPECT_EQ(kelvin["maximum"], LightSpectrum::most_temperature);
    EXPECT_EQ(schema["$defs"]["wavelength"]["minimum"], shortest_wavelength);
    EXPECT_EQ(schema["$defs"]["wavelength"]["maximum"], longest_wavelength);
}

TEST(LightSpectrum, a_scene_with_an_absurd_one_is_refused) {
    for (const LightSpectrum& s : {blackbody(0), blackbody(NAN), lines({}), lines({{900, 1}}),
                                   lines({{500, NAN}}), lines({{500, -1}}), lines({{500, 0}})}) {
        Scene scene;
        scene.lights.push_back({.spectrum = s});
        EXPECT_THROW(validate(scene), Error);
    }
}

}  // namespace
}  // namespace triad
