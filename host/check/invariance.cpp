// A picture is a function of scene, settings and samples: not of how the work was cut, scheduled, placed or
// specialised.
#include <algorithm>

#include "check/cases.h"
#include "check/picture.h"
#include "kernels/types.h"

namespace triad {
namespace {

using namespace picture_case;

void expect_same_bytes(Check& check, const Film& a, const Film& b, const std::string& what) {
    std::size_t different = 0;
    check.equal(a.sums.size(), b.sums.size(), what, ": size");
    for (std::size_t i = 0; i < std::min(a.sums.size(), b.sums.size()); ++i)
        different += a.sums[i] != b.sums[i];
    check.at_most(double(different), 0, "different sums, ", what);
    check.equal(a.half_sums, b.half_sums, what, ": half sums");
    check.equal(a.samples, b.samples, what, ": samples");
    check.equal(a.counters, b.counters, what, ": counters");
}

/// The varied scene's settings at the level's size.
RenderSettings settings_of(const Check& check) {
    RenderSettings s = varied_settings();
    if (check.level == CheckLevel::tiny) s.width = 8, s.height = 6;
    return s;
}

Film picture(Check& check, const Scene& scene, const RenderSettings& settings,
             const std::vector<SampleRange>& ranges) {
    return render(check.device, scene, settings, ranges, features_at(check.level));
}

void ranges_in_any_order(Check& check) {
    const Scene scene = varied_scene();
    const RenderSettings settings = settings_of(check);
    const Film whole = picture(check, scene, settings, {{0, 12}});
    expect_same_bytes(check, whole, picture(check, scene, settings, {{7, 12}, {0, 3}, {3, 7}}),
                      "three ranges");
    const Film parts[] = {picture(check, scene, settings, {{5, 12}}),
                          picture(check, scene, settings, {{0, 1}}),
                          picture(check, scene, settings, {{1, 5}})};
    expect_same_bytes(check, whole, merge(parts), "three films merged");
}

void no_nan(Check& check) {
    const Film film = picture(check, varied_scene(), settings_of(check), {{0, 16}});
    check.at_most(double(film.counters[COUNTER_NOT_FINITE]), 0, "samples that are not finite");
    check.at_most(double(film.counters[COUNTER_SATURATED]), 0, "samples that saturate");
    check.above(film.counters[COUNTER_RAYS], 16 * film.pixels(), "rays");
}

void every_work_group_size(Check& check) {
    const Scene scene = varied_scene();
    Device& device = check.device;
    const std::size_t before = device.preferred_local();
    const Film whole = picture(check, scene, settings_of(check), {{0, 3}});
    for (std::size_t local : {1, 8, 64, 256}) {
        if (local > device.info().max_work_group) continue;
        device.set_preferred_local(local);
        expect_same_bytes(check, whole, picture(check, scene, settings_of(check), {{0, 3}}),
                          "local size " + std::to_string(local));
    }
    device.set_preferred_local(before);
}

void specialised_or_general(Check& check) {
    // Scenes that lack one thing each; the specialised program against the general one.
    std::vector<std::pair<std::string, Scene>> scenes{{"varied", varied_scene()}};
    Scene plain = varied_scene();
    for (Material& m : plain.materials) m = lambert(0.5f);
    plain.lights.clear();
    plain.environment.reset();
    plain.sky = vec3(1.0f);
    scenes.push_back({"lambert under a sky", plain});
    Scene mapped = plain;
    mapped.environment = varied_scene().environment;
    check.holds(mapped.environment.has_value(), "a scene has a map");
    scenes.push_back({"a map alone", mapped});
    Scene opaque = varied_scene();
    for (Material& m : opaque.materials) m.transmission = 0, m.alpha_mode = AlphaMode::opaque;
    scenes.push_back({"no transmission, no alpha", opaque});
    for (auto& [name, scene] : scenes)
        expect_same_bytes(check, render(check.device, scene, settings_of(check), {{0, 2}}),
                          render(check.device, scene, settings_of(check), {{0, 2}}, Features{}), name);
}

void translation(Check& check) {
    const Scene scene = varied_scene();
    Scene moved = scene;
    RenderSettings settings = settings_of(check);
    const dvec3 by(1048576.0, -1048576.0, 1048576.0);
    for (MeshInstance& i : moved.instances) i.to_world = glm::translate(dmat4(1.0), by) * i.to_world;
    for (PunctualLight& l : moved.lights) l.position += by;
    // The eye must be as exact as the rest: its digits below 2^-32 are gone once it is far away.
    for (int c = 0; c < 3; ++c)
        settings.view.eye[c] = std::ldexp(std::round(std::ldexp(settings.view.eye[c], 24)), -24);
    RenderSettings moved_settings = settings;
    moved_settings.view.eye += by;
    expect_same_bytes(check, picture(check, scene, settings, {{0, 2}}),
                      picture(check, moved, moved_settings, {{0, 2}}), "moved by 2^20");
}

void scaling(Check& check) {
    const Scene scene = varied_scene();
    const Film whole = picture(check, scene, settings_of(check), {{0, 2}});
    for (int k : {-20, -7, 1, 20}) {
        const double s = std::ldexp(1.0, k);
        Scene scaled = scene;
        for (Mesh& m : scaled.meshes)
            for (Primitive& p : m.primitives)
                for (vec3& v : p.positions) v *= static_cast<float>(s);
        for (PunctualLight& l : scaled.lights) l.position *= s, l.colour *= static_cast<float>(s * s);
        for (Material& m : scaled.materials) m.attenuation_distance *= static_cast<float>(s);
        RenderSettings settings = settings_of(check);
        settings.view.eye *= s;
        settings.view.focus_distance *= s;
        expect_same_bytes(check, whole, picture(check, scaled, settings, {{0, 2}}), "2^" + std::to_string(k));
    }
}

void duplicates(Check& check) {
    // C7 and C3: coincident faces, in one mesh and across instances, neither shadow nor shine twice.
    const Scene scene = varied_scene();
    Scene twice = scene;
    for (std::size_t i = 0, n = scene.instances.size(); i < n; ++i)
        twice.instances.push_back(scene.instances[i]);
    expect_same_bytes(check, picture(check, scene, settings_of(check), {{0, 4}}),
                      picture(check, twice, settings_of(check), {{0, 4}}), "everything twice");
}

void beyond_32_bits(Check& check) {
    // Samples on both sides of 2^32 are what they are in one run or two, and no others again.
    const std::uint64_t at = std::uint64_t(1) << 32;
    const Scene scene = varied_scene();
    const RenderSettings settings = settings_of(check);
    const Film whole = picture(check, scene, settings, {{at - 8, at + 8}});
    const Film parts[] = {picture(check, scene, settings, {{at - 8, at}}),
                          picture(check, scene, settings, {{at, at + 8}})};
    expect_same_bytes(check, whole, merge(parts), "resumed at 2^32");
    check.holds(parts[1].sums != picture(check, scene, settings, {{0, 8}}).sums, "samples repeat after 2^32");
}

}  // namespace

void add_invariance(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {
                                  {"C4", "moving everything by 2^20 changes no bit", quick, translation},
                                  {"C5b", "scaling pictures by 2^k changes no bit", standard, scaling},
                                  {"C7c", "duplicates of everything change no bit", standard, duplicates},
                                  {"C21b", "pictures beyond 2^32 samples", standard, beyond_32_bits},
                                  {"C23", "no NaN in a scene with everything", quick, no_nan},
                                  {"R2", "ranges of samples in any order", standard, ranges_in_any_order},
                                  {"R3", "every work-group size", standard, every_work_group_size},
                                  {"R4", "specialised and general program", standard, specialised_or_general},
                              });
}

}  // namespace triad
