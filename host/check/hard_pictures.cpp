// Whole pictures of what is hard: the horizon, leaks, normals that lie.
#include "check/cases.h"
#include "check/picture.h"
#include "kernels/types.h"

namespace triad {
namespace {

using namespace picture_case;

void plane_to_the_horizon(Check& check) {
    // C8: a white plane under a white sky is white up to the last grazing ray.
    Builder b;
    b.add(square(0, true, 1e6), lambert(1.0f)).sky(1.0f);
    View view = look_at({0, 1, 0}, {0, 0.999, -10}, 0.02, 1.0);
    expect_closed_form(check, "radiance", measure(check, b.scene, {.view = view, .spp = 64}), 1.0, 1e-5);
    b.add(shapes::box({-1e5f, -1, -1e5f}, {1e5f, 0.5f, 1e5f}), glass(1.5f));
    const Measured m = measure(check, b.scene, {.view = view, .spp = 64});
    check.at_most(double(m.not_finite), 0, "samples that are not finite, glass to the horizon");
}

void no_light_leaks(Check& check) {
    // C9: a lamp in a closed sphere of few faces with smooth normals; from outside it is black to the last
    // bit.
    for (unsigned meridians : {6u, 12u}) {
        Builder b;
        b.add(shapes::lat_long_sphere({0, 0, 0}, 1.0f, meridians, meridians / 2), lambert(0.8f));
        b.scene.lights.push_back({.type = PunctualLight::Type::point, .colour = vec3(100.0f)});
        const Measured m =
            measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, -0.6, -0.8}, 1.2, 3), .spp = 256});
        check.at_most(m.mean, 0, "light outside of ", meridians, " meridians");
        const Measured inside =
            measure(check, b.scene, {.view = look_at({0, 0, 0.3}, {0, 0, -1}, 1.0, 1.0), .spp = 4});
        check.above(inside.mean, 1, "light inside");
    }
}

}  // namespace

void add_hard_pictures(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {
                                  {"C8b", "a plane to the horizon", standard, plane_to_the_horizon},
                                  {"C9", "no light leaks through smooth normals", standard, no_light_leaks},
                                  {"C24", "nested dielectrics", quick, nullptr,
                                   "the path tracer keeps one body and no list of priorities"},
                              });
}

}  // namespace triad
