// Lights with spectra behind a prism: every line lands where Snell's law sends it, with its power, and
// nothing lands elsewhere.
#include <gtest/gtest.h>

#include "analytic/analytic_scene.h"
#include "kernels/types.h"
#include "scene/spectral_data.h"

namespace triad::analytic {
namespace {

using Law = LightSpectrum::Law;

constexpr double slit = 0.01, length = 0.1, side = 0.1, to_screen = 3, albedo = 0.5;

/// An equilateral bar of SF10 along z that a beam crosses at minimum deviation for the d line.
struct Prism {
    Dispersion law = *find_glass("SF10");
    double incidence = std::asin(law.index(line_d) / 2), turn = incidence - pi / 6;
    dvec3 into{std::cos(turn), std::sin(turn), 0}, out{std::cos(turn), -std::sin(turn), 0};
    dvec3 across{-out.y, out.x, 0};  ///< on the screen, against the deviation
    dvec3 entry{-side / 4, 0, 0}, leave{side / 4, 0, 0};
    dvec3 screen = leave + to_screen * out;

    static dvec3 refract(const dvec3& d, const dvec3& n, double eta) {  // n against d; eta: before over after
        const double c = -glm::dot(d, n), k = std::sqrt(1 - eta * eta * (1 - c * c));
        return eta * d + (eta * c - k) * n;
    }

    /// Where on the screen the middle of the beam lands, and the share of it that both faces let through.
    std::pair<double, double> landing(double nanometres) const {
        const double n = law.index(nanometres);
        const dvec3 first(-std::sqrt(.75), .5, 0), second(std::sqrt(.75), .5, 0);
        const auto through = [](double cos_i, double cos_t, double from, double to) {
            const double s = (from * cos_i - to * cos_t) / (from * cos_i + to * cos_t);
            const double p = (from * cos_t - to * cos_i) / (from * cos_t + to * cos_i);
            return 1 - (s * s + p * p) / 2;
        };
        const dvec3 within = refract(into, first, 1 / n), beyond = refract(within, -second, n);
        const double t = through(-glm::dot(into, first), -glm::dot(within, first), 1, n) *
                         through(glm::dot(within, second), glm::dot(beyond, second), n, 1);
        const dvec3 exit = entry + within * (glm::dot(leave - entry, second) / glm::dot(within, second));
        const dvec3 at = exit + beyond * (glm::dot(screen - exit, out) / glm::dot(beyond, out));
        return {glm::dot(at - screen, across), t};
    }
};

Primitive quad(const dvec3& p, const dvec3& a, const dvec3& b) {
    return shapes::quad(vec3(p), vec3(a), vec3(b));
}

/// A beam of irradiance 1 through the slit and the prism onto the screen.
Scene bench(const std::optional<LightSpectrum>& spectrum) {
    const Prism p;
    Builder b;
    Material glass = picture_case::glass(1.7f);
    glass.dispersion = p.law;
    glass.ior = float(p.law.index(line_d));
    const double h = side * std::sqrt(.75);
    const dvec3 corners[] = {{-side / 2, -h / 2, 0}, {side / 2, -h / 2, 0}, {0, h / 2, 0}}, z{0, 0, length};
    Primitive bar;
    for (int i = 0; i < 6; ++i) bar.positions.push_back(vec3(corners[i % 3] + (i < 3 ? -0.5 : 0.5) * z));
    bar.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    b.add(bar, glass);
    const dvec3 up(-p.into.y, p.into.x, 0), plate = p.entry - 0.3 * p.into, wide{0, 0, 2};
    b.add(quad(plate + slit * up - wide / 2.0, wide, up), lambert(0));
    b.add(quad(plate - slit * up - wide / 2.0, wide, -5.0 * up), lambert(0));
    b.add(quad(p.screen - 0.5 * p.across - wide / 2.0, wide, p.across), lambert(float(albedo)));
    b.scene.lights.push_back(
        {.type = PunctualLight::Type::directional, .direction = p.into, .spectrum = spectrum});
    return b.scene;
}

constexpr unsigned size = 512;
constexpr double half = 0.2, bin = 2 * half / size;

/// Flux on the screen by place across it: bins of equal width from -half on.
std::vector<dvec3> screen_flux(const std::optional<LightSpectrum>& spectrum, unsigned spp = 4) {
    const Prism p;
    Scene scene = bench(spectrum);
    validate(scene);
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.view = orthographic(p.screen, p.out, half, 1);
    settings.integrator = Integrator::automatic;
    settings.photons = 1 << 18;
    settings.max_depth = 4;  // what is reflected within the prism, or between the screen and it, is left out
    Renderer renderer(test_device(), scene, settings);
    EXPECT_GT(renderer.photons(), 0u) << renderer.packed().integrator;
    renderer.render({0, spp}, [](const Progress&) { return true; });
    const Film film = renderer.film();
    EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
    EXPECT_EQ(film.counters[COUNTER_SATURATED], 0u);
    std::vector<dvec3> flux(size, dvec3(0.0));
    for (unsigned y = 0; y < size; ++y)
        for (unsigned x = 0; x < size; ++x) {
            const dvec3 at = settings.view.right * ((x + 0.5) / size * 2 - 1) -
                             settings.view.up * ((y + 0.5) / size * 2 - 1);
            const int place = std::clamp(int((glm::dot(at, p.across) + 1) / 2 * size), 0, int(size) - 1);
            const auto mean = pixel_mean(film, std::size_t(y) * size + x);
            flux[place] += dvec3(mean[0], mean[1], mean[2]) * (bin * bin * pi / albedo);
        }
    return flux;
}

double luminance(const dvec3& rgb) { return (glm::inverse(rec709_from_xyz()) * rgb).y; }

/// What has landed within the width of the slit and of a line around a place.
struct Spot {
    dvec3 flux{0.0};
    double centre = 0;
};

Spot spot_at(const std::vector<dvec3>& flux, double place) {
    Spot s;
    double weight = 0;
    for (unsigned i = 0; i < size; ++i) {
        const double x = -half + (i + 0.5) * bin;
        if (std::abs(x - place) > slit + 0.004) continue;
        s.flux += flux[i];
        weight += luminance(flux[i]);
        s.centre += x * luminance(flux[i]);
    }
    s.centre /= weight;
    return s;
}

double total(const std::vector<dvec3>& flux) {
    double sum = 0;
    for (const dvec3& f : flux) sum += luminance(f);
    return sum;
}

double response(double nanometres) {
    const double x = (nanometres - 380) / 5;
    return glm::mix(cie_1931[int(x)][1], cie_1931[int(x) + 1][1], x - int(x));
}

TEST(LightSpectra, a_laser_through_a_prism_is_one_spot_of_its_colour) {
    for (const double nanometres : {450.0, 532.0, 632.8}) {
        const auto [place, share] = Prism().landing(nanometres);
        const auto flux = screen_flux(LightSpectrum{Law::lines, 0, {{nanometres, 1}}});
        const Spot spot = spot_at(flux, place);
        EXPECT_NEAR(spot.centre, place, 2e-4) << nanometres;
        EXPECT_NEAR(luminance(spot.flux), 2 * slit * length * share, 0.01 * 2 * slit * length * share)
            << nanometres;
        EXPECT_NEAR(luminance(spot.flux), total(flux), 1e-9) << "light of " << nanometres << " nm elsewhere";
        if (nanometres == 532) {
            EXPECT_TRUE(spot.flux.g > 0 && spot.flux.r < 0) << "outside Rec.709, and signed";
        }
    }
}

TEST(LightSpectra, two_lines_land_apart_by_their_powers_and_the_observers_response) {
    const double blue = 486.1, red = 656.3, powers[] = {3, 1};
    const auto [blue_place, blue_share] = Prism().landing(blue);
    const auto [red_place, red_share] = Prism().landing(red);
    const auto flux = screen_flux(LightSpectrum{Law::lines, 0, {{blue, powers[0]}, {red, powers[1]}}}, 16);
    const Spot b = spot_at(flux, blue_place), r = spot_at(flux, red_place);
    EXPECT_NEAR(b.centre, blue_place, 2e-4);
    EXPECT_NEAR(r.centre, red_place, 2e-4);
    const double expected = powers[0] * response(blue) * blue_share / (powers[1] * response(red) * red_share);
    EXPECT_NEAR(luminance(b.flux) / luminance(r.flux), expected, 0.015 * expected);
    EXPECT_NEAR(luminance(b.flux) + luminance(r.flux), total(flux), 1e-9) << "light elsewhere";
}

TEST(LightSpectra, white_light_is_the_whole_band) {
    for (const auto& spectrum :
         {std::optional<LightSpectrum>(), std::optional<LightSpectrum>(LightSpectrum{})}) {
        const auto flux = screen_flux(spectrum);
        const Prism p;
        const double violet = p.landing(400).first, red = p.landing(700).first;
        const double ends[] = {p.landing(380).first - slit - 2 * bin, p.landing(780).first + slit + 2 * bin};
        ASSERT_LT(violet, red);
        for (unsigned i = 0; i < size; ++i) {
            const double x = -half + (i + 0.5) * bin;
            if (x > violet && x < red) {
                EXPECT_GT(luminance(flux[i]), 0) << x;
            }
            if (x < ends[0] || x > ends[1]) {
                EXPECT_EQ(flux[i], dvec3(0.0)) << x;
            }
        }
    }
}

TEST(LightSpectra, nothing_at_the_limits_of_what_files_may_say_is_no_number) {
    const Dispersion glasses[] = {{Dispersion::Law::cauchy, 0, {1.0}, {}},
                                  {Dispersion::Law::cauchy, 0, {9.9, 0.01}, {}},
                                  abbe_dispersion(1.5, 60),
                                  {Dispersion::Law::sellmeier, 1, {0.5}, {0.1435}}};  // next to its pole
    const LightSpectrum spectra[] = {{Law::lines, 0, {{380, 1}}},
                                     {Law::lines, 0, {{780, 1e30}, {500, 1e-30}}},
                                     {Law::blackbody, LightSpectrum::least_temperature, {}},
                                     {Law::blackbody, LightSpectrum::most_temperature, {}}};
    for (int i = 0; i < 4; ++i)
        for (const Spectral scheme : {Spectral::automatic, Spectral::full, Spectral::classic}) {
            ASSERT_TRUE(glasses[i].is_sane()) << i;
            Builder b;
            Material body = glass(float(glasses[i].index(line_d)), i % 2 ? 0.3f : 0.0f);
            body.dispersion = glasses[i];
            Material lamp = emitter(1);
            lamp.emission_spectrum = spectra[i];
            b.add(shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), lambert(0.7f));
            b.add(shapes::box({-0.7f, 0.3f, -0.4f}, {0.7f, 1.1f, 0.4f}), body);
            b.add(shapes::quad({-0.6f, 2.2f, -0.6f}, {1.2f, 0, 0}, {0, 0, 1.2f}), lamp);
            b.scene.lights.push_back({.position = {1, 2, 1}, .spectrum = spectra[3 - i]});
            Scene scene = b.scene;
            validate(scene);
            RenderSettings settings;
            settings.width = settings.height = 32;
            settings.spectral = scheme;
            settings.integrator = Integrator::automatic;
            settings.view = look_at({0.4, 1.5, 3.6}, {0, 0.5, 0}, 0.8, 1);
            Renderer renderer(test_device(), scene, settings);
            renderer.render({0, 16}, [](const Progress&) { return true; });
            const Film film = renderer.film();
            EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u) << i << ", " << int(scheme);
            EXPECT_EQ(film.counters[COUNTER_SATURATED], 0u) << i << ", " << int(scheme);
            double sum = 0;
            for (std::size_t p = 0; p < film.pixels(); ++p) sum += std::abs(pixel_mean(film, p)[0]);
            EXPECT_TRUE(std::isfinite(sum) && sum > 0) << i << ", " << int(scheme);
        }
}

}  // namespace
}  // namespace triad::analytic
