// The tree over many lights: what it picks, with which probability, and that nothing of the light is lost.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/pack.h"

namespace triad {
namespace {

using namespace picture_case;

struct Spread {
    const char* name;
    std::size_t lights;
    double powers, sizes;  ///< decades that intensities, and distances from the middle, are spread over
};
const Spread spreads[] = {
    {"alike", 700, 0, 0}, {"powers of twelve decades", 300, 12, 0}, {"sizes of twelve decades", 300, 0, 12}};

/// Point and spot lights above a floor, some at one place.
Scene scene_with(const Spread& spread) {
    std::mt19937 bits(7);
    const auto even = [&] { return std::uniform_real_distribution<double>(0, 1)(bits); };
    Builder b;
    b.add(shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), lambert(0.5f));
    for (std::size_t i = 0; i < spread.lights; ++i) {
        PunctualLight l;
        const double size = std::pow(10, -spread.sizes * even());
        l.position = i % 10 == 9 ? b.scene.lights.back().position
                                 : size * dvec3(6 * even() - 3, 0.1 + 3 * even(), 6 * even() - 3);
        l.colour = vec3(float(std::pow(10, spread.powers * (even() - 0.5)) * size * size));
        if (i % 3 == 2) {
            l.type = PunctualLight::Type::spot;
            l.direction = glm::normalize(dvec3(even() - 0.5, -even(), even() - 0.5));
            l.inner_cone = 0.2f, l.outer_cone = 0.3f + float(even());
        }
        b.scene.lights.push_back(l);
    }
    validate(b.scene);
    return b.scene;
}

/// A point on the floor, and one above it that takes light from everywhere; in units of the scene's.
const char* const receivers[] = {"{vec3_make(0.3f, 0.0f, -0.2f), vec3_make(0.0f, 1.0f, 0.0f)}",
                                 "{vec3_make(-0.1f, 1.2f, 0.4f), vec3_splat(0.0f)}"};

/// draw_lights() with pick (uniform bits) and receiver.
std::vector<std::array<float, 4>> draw(Check& check, const PackedScene& packed, const std::string& receiver,
                                       const std::string& body, std::size_t count) {
    const dvec3 o = packed.origin;
    const std::string origin =
        std::to_string(o.x) + "f, " + std::to_string(o.y) + "f, " + std::to_string(o.z) + "f";
    return draw_lights(check, packed,
                       R"(
    const uint pick = u.set[2].x;
    Receiver receiver = )" +
                           receiver + R"(;
    receiver.position = vec3_sub(receiver.position, vec3_make()" +
                           origin + R"());
)" + body,
                       count);
}

void picks_have_their_probability(Check& check) {
    for (const Spread& spread : spreads)
        for (const char* receiver : receivers) {
            const PackedScene packed = pack(scene_with(spread), RenderSettings{});
            const std::size_t lights = packed.lights.size(), count = check.count(1 << 18);
            const auto said = draw(check, packed, receiver, R"(
    w = vec4_splat(light_tree_probability(&scene, &receiver, i));
)",
                                   lights);
            const auto drawn = draw(check, packed, receiver, R"(
    const LightPick picked = light_pick(&scene, receiver, pick);
    w = vec4_make(picked.light != TRIAD_NONE ? (float)picked.light : -1.0f, picked.probability, picked.within, 0.0f);
)",
                                    count);
            double total = 0;
            for (const auto& p : said) total += p[0];
            check.at_most(total, 1 + 2e-4, "sum of the probabilities, ", spread.name);
            // The last is a way that ends without a light: bounds promised more than there was.
            std::vector<double> counts(lights + 1), expected(lights + 1), within(16);
            for (const auto& d : drawn) {
                check.holds(d[0] >= -1 && d[0] < float(lights), "light ", d[0], ", ", spread.name);
                if (d[0] == -1) counts[lights] += 1;
                if (!(d[0] >= 0 && d[0] < float(lights))) continue;
                const std::size_t i = std::size_t(d[0]);
                counts[i] += 1;
                check.holds(d[2] >= 0 && d[2] < 1, "where in the light's share: ", d[2]);
                if (d[2] >= 0 && d[2] < 1) within[std::size_t(d[2] * 16)] += 1;
                check.also_at_most(std::abs(d[1] / said[i][0] - 1), 1e-5, "probability of a pick, ",
                                   spread.name);
            }
            for (std::size_t i = 0; i < lights; ++i) expected[i] = double(said[i][0]) * double(count);
            expected[lights] = std::max(1 - total, 0.0) * double(count);
            check.at_most(chi_square_z(counts, expected), chi_square_limit, "chi-square of picks, ",
                          spread.name);
            const double picked = std::accumulate(within.begin(), within.end(), 0.0);
            check.at_most(chi_square_z(within, std::vector<double>(16, picked / 16)), chi_square_limit,
                          "chi-square of places in the lights' shares, ", spread.name);
        }
}

/// Irradiance of the floor at the first receiver against the sum over all lights.
void nothing_is_lost(Check& check) {
    for (const Spread& spread : spreads) {
        const Scene scene = scene_with(spread);
        const PackedScene packed = pack(scene, RenderSettings{});
        const dvec3 p(0.3, 0, -0.2);
        double truth = 0;
        for (const PunctualLight& l : scene.lights) {
            const dvec3 d = l.position - p;
            const double distance = glm::length(d), cosine = d.y / distance;
            double cone = 1;
            if (l.type == PunctualLight::Type::spot) {
                const double outer = std::cos(double(l.outer_cone)), inner = std::cos(double(l.inner_cone));
                cone = std::clamp((glm::dot(-d / distance, l.direction) - outer) / (inner - outer), 0.0, 1.0);
            }
            truth += l.colour.x * cone * cone * std::max(cosine, 0.0) / (distance * distance);
        }
        const std::size_t count = check.count(1 << 18);
        const auto drawn = draw(check, packed, receivers[0], R"(
    LightSample sample;
    const int any = light_sample(&scene, receiver, uvec2_make(pick, 0u), &sample);
    w = vec4_splat(any ? sample.weight.x * math_max(sample.direction.y, 0.0f) : 0.0f);
)",
                                count);
        double sum = 0, square = 0;
        for (const auto& d : drawn) sum += d[0], square += double(d[0]) * d[0];
        const double mean = sum / double(count),
                     deviation =
                         std::sqrt(std::max(square / double(count) - mean * mean, 0.0) / double(count));
        check.near(mean / truth, 1.0, 5 * deviation / truth + 1e-4, "irradiance of all lights, ",
                   spread.name);
        // Importances are bounds, not values: the noise says how good they are.
        check.also_at_most(deviation * std::sqrt(double(count)) / truth, 4.0, "noise of a pick, ",
                           spread.name);
    }
}

}  // namespace

void add_light_tree(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {{"S7", "picks of the light tree", standard, picks_have_their_probability},
                               {"S8", "irradiance of many lights by the tree", standard, nothing_is_lost}});
}

}  // namespace triad
