// Dispersion and priorities in whole pictures with a closed form.
#include "check/cases.h"
#include "check/picture.h"
#include "scene/spectral_data.h"

namespace triad {
namespace {

using namespace picture_case;

/// Mean of a channel of a lamp of radiance 1 seen through bodies that fill the view, along -z.
Measured through(Check& check, Builder& bodies, int channel = 1) {
    bodies.add(shapes::quad({-3, -3, -9}, {6, 0, 0}, {0, 6, 0}), emitter(1.0f));
    return measure(check, bodies.scene,
                   {.view = orthographic({0, 0, 0}, {0, 0, -1}, 0.5, 5),
                    .size = channel == 1 ? 16u : 32u,
                    .spp = 1024,
                    .channel = channel});
}

Primitive slab(float near, float far) { return shapes::box({-1, -1, -far}, {1, 1, -near}); }

void slab_of_dispersive_glass(Check& check) {
    // Every wavelength by D4, weighed by what it adds to blue, where T is farthest from that of the d line:
    // the picture must tell the two apart.
    for (const char* name : {"SF10", "cubo"}) {
        const Dispersion law = *find_glass(name);
        constexpr int parts = 50;
        double expected = 0;
        for (int i = 0; i + 1 < spectral_rows; ++i)
            for (int k = 0; k < parts; ++k) {
                const double t = (k + 0.5) / parts, n = law.index(wavelength_of_row(i) + spectral_step * t);
                const double response = glm::mix(d65_response(i), d65_response(i + 1), t).z;
                expected += response * 2 * n / (n * n + 1) * spectral_step / parts;
            }
        Material m = glass(static_cast<float>(law.index(line_d)));
        m.dispersion = law;
        Builder b;
        b.add(slab(0, 1), m);
        const Measured found = through(check, b, 2);
        expect_closed_form(check, name, found, expected, 2e-5);
        const double n = m.ior, without = 2 * n / (n * n + 1);
        if (check.level > CheckLevel::quick)  // less work has more noise
            check.holds(std::abs(found.mean - without) > 0.5 * std::abs(expected - without) &&
                            std::abs(expected - without) > 1.5 * t_limit * found.standard_error,
                        name, " is no farther from glass without dispersion than the noise: ", found.mean,
                        " and ", without, " within ", found.standard_error);
    }
}

/// What a pile of clear or absorbing layers at right angles lets through, all reflections between them added.
class Pile {
  public:
    void face(double from, double to) {
        const double r = std::pow((to - from) / (to + from), 2);
        const double bounce = 1 / (1 - back_ * r);
        back_ = r + (1 - r) * (1 - r) * back_ * bounce;
        through_ *= (1 - r) * bounce;
    }
    void layer(double absorption, double thickness) {
        const double tau = std::exp(-absorption * thickness);
        through_ *= tau;
        back_ *= tau * tau;
    }
    double through() const { return through_; }

  private:
    double through_ = 1, back_ = 0;  ///< back_: what comes from beyond and is reflected back there
};

void priorities(Check& check) {
    // Water from 1 to 2 overlaps glass from 0 to 1.5. Both absorb, so that it matters which of them is there.
    const double glass_sigma = 0.2, water_sigma = 1.5;
    const auto body = [](float index, double sigma, unsigned priority) {
        Material m = glass(index);
        m.attenuation_distance = 1;
        m.attenuation_colour = vec3(static_cast<float>(std::exp(-sigma)));
        m.priority = priority;
        return m;
    };
    for (const unsigned glass_priority : {0u, 2u})
        for (const bool glass_in_front : {true, false}) {
            const double glass_end = glass_priority > 1 ? 1.5 : 1.0;
            Pile pile;
            pile.face(1, 1.5);
            pile.layer(glass_sigma, glass_end);
            pile.face(1.5, 1.333);
            pile.layer(water_sigma, 2 - glass_end);
            pile.face(1.333, 1);
            const Material g = body(1.5f, glass_sigma, glass_priority), w = body(1.333f, water_sigma, 1);
            Builder b;
            b.add(glass_in_front ? slab(0, 1.5f) : slab(0.5f, 2), g);
            b.add(glass_in_front ? slab(1, 2) : slab(0, 1), w);
            expect_closed_form(check,
                               std::string(glass_priority > 1 ? "glass" : "water") + " prevails, " +
                                   (glass_in_front ? "glass" : "water") + " in front",
                               through(check, b), pile.through(), 2e-5);
        }
}

void surfaces_within_are_hidden(Check& check) {
    // A tinted ball of low priority within a clear one of high priority leaves no trace.
    Material outer = glass(1.5f), inner = glass(1.8f, 0.5f);
    outer.priority = 1;
    inner.base_colour = {0.1f, 0.1f, 0.1f, 1};
    inner.transmission = 0.5f;
    Builder b;
    b.add(slab(0, 2), outer).add(slab(0.5f, 1.5f), inner);
    expect_closed_form(check, "T", through(check, b), 2 * 1.5 / (1.5 * 1.5 + 1), 2e-5);
}

}  // namespace

void add_spectral_pictures(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"D4e", "slab of dispersive glass", quick, slab_of_dispersive_glass},
                     {"C24b", "bodies that overlap, by priority", standard, priorities},
                     {"C24c", "surfaces within a body of priority", standard, surfaces_within_are_hidden},
                 });
}

}  // namespace triad
