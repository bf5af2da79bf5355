// Spectra of lights: what paths and photons draw has the light's colour on the mean, and nothing else is
// drawn.
#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/pack.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

const char* const spectra_source = R"(#include "common/spectrum.h"
/* Of evenly spread numbers: what light of spectrum `which` adds to a path (or, by_light, to a photon), and at which wavelength. */
__kernel void draw_light(__global Vec4* out, __global const Spectrum* spectrum, uint which, uint by_light, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float u = (convert_float(i) + 0.5f) / convert_float(count);
    Vec3 filter;
    float nanometres;
    if (by_light != 0u) {
        float carried;
        nanometres = spectrum_draw_light(spectrum, which, u, &carried);
        filter = vec3_scale(spectrum_filter(spectrum, nanometres), carried);
    } else {
        nanometres = spectrum_sample(spectrum, u, &filter);
        filter = vec3_scale(filter, spectrum_of_light(spectrum, which, nanometres));
    }
    out[i] = vec3_with(filter, nanometres);
}
)";

/// The colour of a spectrum at luminance 1, from the tables of colour science alone, in steps of a tenth of a
/// nm.
dvec3 colour_of(const LightSpectrum& light) {
    dvec3 sum(0.0);
    for (int i = 0; i < 4000; ++i) {
        const double x = (0.1 * i + 0.05) / spectral_step;
        const int row = int(x);
        const auto& a = cie_1931[row];
        const auto& b = cie_1931[row + 1];
        for (int c = 0; c < 3; ++c)
            sum[c] += light.power(wavelength_of_row(0) + 0.1 * i + 0.05) * glm::mix(a[c], b[c], x - row);
    }
    return rec709_from_xyz() * (sum / sum.y);
}

void spectra_of_lights(Check& check) {
    using Law = LightSpectrum::Law;
    const LightSpectrum lights[] = {{},
                                    {Law::blackbody, 3000, {}},
                                    {Law::lines, 0, {{532, 1}}},
                                    {Law::lines, 0, {{404.66, 1}, {435.83, 2}, {546.07, 3}, {589.3, 8}}}};
    Scene scene;
    for (const LightSpectrum& s : lights) scene.lights.push_back({.spectrum = s});
    RenderSettings settings;
    settings.spectral = Spectral::full;
    auto surfaces = std::make_shared<PackedSurfaces>();
    pack_spectrum(scene, settings, *surfaces);
    PackedScene packed;
    set_surfaces(packed, surfaces);
    pack_lights(scene, packed);
    pack_wavelengths(packed);
    const Buffer spectrum = check.device.upload(packed.spectrum);
    const std::size_t count = std::size_t(1) << 18;
    for (std::uint32_t which = 0; which <= std::size(lights); ++which)
        for (const std::uint32_t by_light : {0u, 1u}) {
            const auto drawn =
                run_kernel<std::array<float, 4>>(check.device, spectra_source, "draw_light",
                                                 Arguments().add(spectrum).add(which).add(by_light), count);
            dvec3 sum(0.0);
            double aside = 0;
            for (const auto& f : drawn) {
                sum += dvec3(f[0], f[1], f[2]);
                if (which == 3 && by_light) aside = std::max(aside, std::abs(double(f[3]) - 532));
            }
            // The tables of a light are straight between whole nanometres, those of the observer over 5 nm.
            const dvec3 expected = which == 0 ? dvec3(1.0) : colour_of(lights[which - 1]);
            const dvec3 packed_colour =
                which == 0 ? dvec3(1.0) : dvec3(surfaces->light_spectra[which - 1].colour);
            for (int c = 0; c < 3; ++c) {
                check.near(sum[c] / double(count), packed_colour[c], 2e-5, "mean of channel ", c,
                           " of spectrum ", which, by_light ? ", drawn by it" : ", drawn by all");
                check.near(packed_colour[c], expected[c], which == 0 ? 1e-5 : 3e-3, "colour ", c,
                           " of spectrum ", which);
            }
            check.holds(aside <= 1, "a laser of 532 nm sends light ", aside, " nm beside");
        }
}

}  // namespace

void add_light_spectra(std::vector<CheckCase>& cases) {
    cases.push_back({"W6", "spectra of lights", CheckLevel::quick, spectra_of_lights});
}

}  // namespace triad
