#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "pack/pack.h"

namespace triad {
namespace {

/// Share of the picks that all lights with any power get alike: a weak light outshines the others where it is
/// close, or alone in its cone, and noise grows with one over the rarity of its picks.
constexpr double even_share = 0.2;

/// As many lights with a place are picked by their power alone; a tree pays for more.
constexpr std::size_t few_lights = 16;

/// What lights are weighed by: all channels alike, as the error of a picture counts them.
double average(const vec3& c) { return (std::abs(double(c.x)) + std::abs(c.y) + std::abs(c.z)) / 3.0; }

double largest(const vec3& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

/// Mean of an emission texture over its whole image: a guess of what a triangle sees of it, good enough to
/// pick lights by.
double texture_average(const Scene& scene, const std::optional<TextureUse>& use) {
    if (!use) return 1.0;
    const Image& image = scene.images[scene.textures[use->texture].image];
    const std::size_t texels = std::size_t(image.width) * image.height;
    const double top = image.bits == 16 ? 65535.0 : 255.0;
    double sum = 0;
    for (std::size_t i = 0; i < texels; ++i) {
        vec3 c;
        for (int k = 0; k < 3; ++k) {
            const std::size_t at = i * 4 + k;
            const double v = image.bits == 16
                                 ? reinterpret_cast<const std::uint16_t*>(image.texels.data())[at]
                                 : image.texels[at];
            c[k] = static_cast<float>(srgb_decode(v / top));
        }
        sum += average(c);
    }
    return texels ? sum / static_cast<double>(texels) : 0.0;
}

/// Triangles that the tree holds; exact duplicates are not in it and must not shine either.
std::vector<bool> drawn(const PackedScene& packed) {
    std::vector<bool> in_tree(packed.triangles.size());
    for (const dev::TriangleBlock& b : packed.bvh.blocks)
        for (std::uint32_t p : b.primitive)
            if (p != TRIAD_NONE) in_tree[p] = true;
    return in_tree;
}

struct Picker {
    PackedScene& packed;
    std::vector<double> power;
    double brightest = 0;  ///< radiance that the film should have room for

    void add(dev::Light light, double flux) {
        packed.lights.push_back(light);
        power.push_back(std::isfinite(flux) ? std::max(flux, 0.0) : 0.0);
    }
};

void add_triangles(const Scene& scene, Picker& picker) {
    PackedScene& packed = picker.packed;
    std::vector<bool> in_tree;
    for (dev::Geometry& g : packed.geometries) {
        const Material& m = scene.materials[g.material];
        if (m.emission == vec3(0.0f) || m.unlit) continue;
        if (in_tree.empty()) in_tree = drawn(packed);
        const LightColour colour = light_colour(*packed.surfaces, m.emission_spectrum);
        const double radiance =
            average(m.emission * colour.seen) * texture_average(scene, m.emission_texture);
        picker.brightest = std::max(picker.brightest, largest(m.emission * colour.seen));
        g.first_light = static_cast<std::uint32_t>(packed.lights.size());
        const std::size_t geometry = static_cast<std::size_t>(&g - packed.geometries.data());
        for (std::size_t i = g.first_triangle;
             i < packed.triangles.size() && packed.triangles[i].geometry == geometry; ++i) {
            const BvhTriangle& t =
                *std::lower_bound(packed.emitters.begin(), packed.emitters.end(), i,
                                  [](const BvhTriangle& b, std::size_t p) { return b.primitive < p; });
            auto corner = [&](int c) { return dvec3(t.corner[c]); };
            const dvec3 e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
            dev::Light light{};
            light.type = LIGHT_TRIANGLE;
            light.primitive = static_cast<std::uint32_t>(i);
            const double area = 0.5 * glm::length(glm::cross(e1, e2));
            light.area = static_cast<float>(area);
            to_floats(light.position, corner(0));
            to_floats(light.edge1, e1);
            to_floats(light.edge2, e2);
            to_floats(light.axis, area > 0 ? glm::normalize(glm::cross(e1, e2)) : dvec3(0, 1, 0));
            to_floats(light.colour, dvec3(m.emission * colour.tint));
            light.flags = (m.double_sided ? MATERIAL_DOUBLE_SIDED : 0u) | colour.index
                                                                              << LIGHT_SPECTRUM_SHIFT;
            picker.add(light, in_tree[i] ? pi * area * radiance * (m.double_sided ? 2.0 : 1.0) : 0.0);
        }
    }
}

void add_punctual(const Scene& scene, Picker& picker) {
    const double radius = std::max(picker.packed.bounds.radius(), 1e-30);
    for (const PunctualLight& l : scene.lights) {
        dev::Light light{};
        to_floats(light.position, l.position - picker.packed.origin);
        to_floats(light.axis, l.direction);
        const LightColour colour = light_colour(*picker.packed.surfaces, l.spectrum);
        to_floats(light.colour, dvec3(l.colour * colour.tint));
        light.flags = colour.index << LIGHT_SPECTRUM_SHIFT;
        light.range = l.range;
        const double intensity = average(l.colour * colour.seen);
        if (l.type == PunctualLight::Type::directional) {
            light.type = LIGHT_DIRECTIONAL;
            picker.brightest = std::max(picker.brightest, intensity / pi);
            picker.add(light, intensity * pi * radius * radius);
            continue;
        }
        picker.brightest = std::max(picker.brightest, intensity / (pi * radius * radius));
        if (l.type == PunctualLight::Type::point) {
            light.type = LIGHT_POINT;
            picker.add(light, 4.0 * pi * intensity);
            continue;
        }
        light.type = LIGHT_SPOT;  // KHR_lights_punctual: attenuation = saturate(cos * scale + offset)^2
        const double outer = std::cos(double(l.outer_cone));
        const double scale = 1.0 / std::max(0.001, std::cos(double(l.inner_cone)) - outer);
        light.cone_scale = static_cast<float>(scale);
        light.cone_offset = static_cast<float>(-outer * scale);
        picker.add(light, 2.0 * pi * (1.0 - outer) * intensity);
    }
}

/// Powers with even_share of their total spread over all that are not zero.
std::vector<double> picked_weights(std::vector<double> power) {
    double total = 0, shining = 0;
    for (double p : power) total += p, shining += p > 0 ? 1.0 : 0.0;
    for (double& p : power)
        if (p > 0) p = (1.0 - even_share) * p + even_share * total / shining;
    return power;
}

/// Sets what light sampling picks by: a tree for many lights, which is one interval among those of the
/// others.
void pick_lights(Picker& picker) {
    PackedScene& packed = picker.packed;
    std::vector<double> weights = picked_weights(picker.power);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < weights.size(); ++i)
        packed.lights[i].pick = total > 0 ? float(weights[i] / total) : 0.0f;
    std::size_t first = weights.size();
    std::vector<bool> in_tree(weights.size(), false);
    std::size_t placed = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) placed += weights[i] > 0 && has_place(packed.lights[i]);
    if (placed > few_lights) {
        packed.light_tree = light_tree(packed.lights, picker.power);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if (packed.light_tree.trails[i] == TRIAD_NONE) continue;
            in_tree[i] = true;
            if (first == weights.size())
                first = i;
            else
                weights[first] += std::exchange(weights[i], 0.0);
        }
    }
    const std::vector<std::uint32_t> cdf = integer_cdf(weights);
    packed.light_shape = cdf_shape(weights.size());
    packed.light_cdf.resize(packed.light_shape.size);
    write_cdf_tree(packed.light_shape, cdf, packed.light_cdf.data());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        dev::Light& l = packed.lights[i];
        if (!in_tree[i]) l.pick = static_cast<float>((cdf[i + 1] - cdf[i]) / 4294967296.0);
        l.inverse_pick = l.pick > 0 ? 1 / l.pick : LIGHT_UNPICKED;
    }
    if (first < weights.size()) {
        // The tree's interval in halves: what is over of the borders goes to the neighbours.
        packed.light_tree.first_share = (cdf[first] + 1) / 2;
        packed.light_tree.shares = cdf[first + 1] / 2 - packed.light_tree.first_share;
    }
}

}  // namespace

void pack_lights(const Scene& scene, PackedScene& packed) {
    Picker picker{packed, {}, 0.0};
    add_triangles(scene, picker);
    add_punctual(scene, picker);
    const dev::Environment& e = packed.environment;
    if (e.width != 0) {
        // Flux through the disc that the scene shows to a direction; the mean radiance is in colour
        // (pack_environment).
        const double mean = average({e.colour[0], e.colour[1], e.colour[2]});
        const double radius = packed.bounds.radius();
        picker.brightest = std::max(picker.brightest, mean);
        if (mean > 0) {
            packed.environment.light = static_cast<std::uint32_t>(packed.lights.size());
            dev::Light light{};
            light.type = LIGHT_ENVIRONMENT;
            picker.add(light, 4.0 * pi * mean * pi * radius * radius);
        }
    } else {
        picker.brightest =
            std::max({picker.brightest, double(e.colour[0]), double(e.colour[1]), double(e.colour[2])});
    }
    pick_lights(picker);
    const bool any = std::any_of(picker.power.begin(), picker.power.end(), [](double p) { return p > 0; });
    if (!any) {  // a scene whose lights have no power is black: nothing to sample
        packed.lights.clear();
        packed.environment.light = TRIAD_NONE;
        for (dev::Geometry& g : packed.geometries) g.first_light = TRIAD_NONE;
    }
    for (const Material& m : scene.materials)
        if (m.unlit) picker.brightest = std::max(picker.brightest, 1.0);
    // The quantum is 2^-34 of the brightest light: half a billion samples of it fit into 63 bits, and
    // rounding is far below float. It depends on scene and settings alone, so that partial films merge.
    const double brightest = picker.brightest > 0 ? picker.brightest : 1.0;
    packed.quanta_log2 = std::clamp(34 - static_cast<int>(std::ceil(std::log2(brightest))), -60, 60);
}

}  // namespace triad
