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

void nested_dielectrics(Check& check) {
    // C24: slabs of glass and water before a lamp, at right angles. 1 / T - 1 adds up R / (1 - R) over the
    // faces.
    struct Slab {
        float index, near, far, half;
    };
    struct Stack {
        const char* name;
        std::vector<Slab> slabs;
        std::vector<double> indices;
    };
    for (const Stack& stack :
         {Stack{"water within glass", {{1.5f, 0, 3, 1}, {1.333f, 1, 2, 0.9f}}, {1, 1.5, 1.333, 1.5, 1}},
          Stack{"water on glass", {{1.5f, 0, 1, 1}, {1.333f, 1, 2, 1}}, {1, 1.5, 1.333, 1}},
          Stack{
              "water and glass overlapping", {{1.5f, 0, 1.05f, 1}, {1.333f, 1, 2, 1}}, {1, 1.5, 1.333, 1}}}) {
        Builder b;
        for (const Slab& s : stack.slabs)
            b.add(shapes::box({-s.half, -s.half, -s.far}, {s.half, s.half, -s.near}), glass(s.index));
        b.add(shapes::quad({-2, -2, -4}, {4, 0, 0}, {0, 4, 0}), emitter(1.0f));
        double sum = 0;
        for (std::size_t i = 1; i < stack.indices.size(); ++i) {
            const double r = std::pow(
                (stack.indices[i] - stack.indices[i - 1]) / (stack.indices[i] + stack.indices[i - 1]), 2);
            sum += r / (1 - r);
        }
        expect_closed_form(
            check, stack.name,
            measure(check, b.scene, {.view = orthographic({0, 0, 0}, {0, 0, -1}, 0.5, 5), .spp = 128}),
            1 / (1 + sum), 1e-5);
    }
}

}  // namespace

void add_hard_pictures(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C8b", "a plane to the horizon", standard, plane_to_the_horizon},
                     {"C9", "no light leaks through smooth normals", standard, no_light_leaks},
                     {"C24", "bodies within bodies and beside them", standard, nested_dielectrics},
                 });
}

}  // namespace triad
