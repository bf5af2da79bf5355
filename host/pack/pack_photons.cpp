/// Where photons are aimed, and whether they are worth it.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "pack/pack.h"

namespace triad {
namespace {

/// Largest radius of a light over its distance to a caster that paths find too seldom to go without photons.
constexpr double small_light = 0.2;
/// The same for a light that sends the casters more than this share of all directions: a lamp in a closed
/// room, whose caustics light everything else.
constexpr double near_light = 0.5, near_share = 0.05;
/// Share of the map's light in directions that are drawn this many times more often than evenly: a sun.
constexpr double sun_share = 0.1, sun_density = 1000;
/// Smallest value of a channel of an 8- or 16-bit texture; 1 without one.
double least_of(const Scene& scene, const std::optional<TextureUse>& use, unsigned channel) {
    if (!use) return 1.0;
    const Image& image = scene.images[scene.textures[use->texture].image];
    const std::size_t texels = std::size_t(image.width) * image.height;
    unsigned least = image.bits == 16 ? 65535 : 255;
    for (std::size_t i = 0; i < texels; ++i)
        least = std::min<unsigned>(least, image.bits == 16 ? reinterpret_cast<const std::uint16_t*>(
                                                                 image.texels.data())[i * 4 + channel]
                                                           : image.texels[i * 4 + channel]);
    return least / (image.bits == 16 ? 65535.0 : 255.0);
}

/// Whether light can leave the material by a delta event.
bool casts(const Scene& scene, const Material& m) {
    if (m.unlit || (m.metallic == 0 && m.specular == 0 && m.transmission == 0)) return false;
    if (m.transmission > 0 && m.thickness > 0 && std::abs(m.ior - 1.0) < double(BSDF_SAME_INDEX)) return true;
    const double roughness = m.roughness * least_of(scene, m.metallic_roughness_texture, 1);
    return roughness * roughness < double(BSDF_SMOOTH_ALPHA);
}

/// Whether it throws most of what it gets: a varnish alone is no reason for photons.
bool casts_strongly(const Material& m) { return m.transmission > 0 || m.metallic > 0.5f; }

/// Points of a part of the casters, and a sphere around them.
struct Cluster {
    std::vector<dvec3> points;  ///< three for each triangle
    dvec3 centre{0.0};
    double radius = 0;
    bool whole = false;  ///< splitting does not help

    Bounds bounds() const {
        Bounds b;
        for (const dvec3& p : points) b.add(p);
        return b;
    }

    explicit Cluster(std::vector<dvec3> p) : points(std::move(p)) {
        centre = bounds().centre();
        for (const dvec3& q : points) radius = std::max(radius, glm::length(q - centre));
    }

    /// The two halves by triangles along the longest axis.
    std::pair<Cluster, Cluster> split() const {
        const dvec3 size = bounds().size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::vector<std::size_t> order(points.size() / 3);
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        auto at = [&](std::size_t i) {
            return points[3 * i][axis] + points[3 * i + 1][axis] + points[3 * i + 2][axis];
        };
        std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(order.size() / 2), order.end(),
                         [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
        std::vector<dvec3> parts[2];
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                parts[i < order.size() / 2 ? 0 : 1].push_back(points[3 * order[i] + c]);
        return {Cluster(std::move(parts[0])), Cluster(std::move(parts[1]))};
    }
};

/// Spheres around what casts, few and tight: the largest is halved while that shrinks the discs they show.
std::vector<Cluster> clusters_of(const Scene& scene, const dvec3& origin, bool& strong) {
    std::vector<Cluster> clusters;
    std::vector<signed char> known(scene.materials.size(), -1);
    std::vector<dvec3> rest;  // of what there is no room for
    for (const MeshInstance& instance : scene.instances)
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            signed char& caster = known[p.material];
            if (caster < 0) caster = casts(scene, scene.materials[p.material]);
            if (!caster || p.triangles.empty()) continue;
            strong |= casts_strongly(scene.materials[p.material]);
            std::vector<dvec3> points;
            points.reserve(p.triangles.size() * 3);
            for (const uvec3& t : p.triangles)
                for (int c = 0; c < 3; ++c)
                    points.push_back(transform_point(instance.to_world, dvec3(p.positions[t[c]])) - origin);
            if (clusters.size() + 1 < PHOTON_CASTERS)
                clusters.emplace_back(std::move(points));
            else
                rest.insert(rest.end(), points.begin(), points.end());
        }
    if (!rest.empty()) clusters.emplace_back(std::move(rest));
    while (clusters.size() < PHOTON_CASTERS) {
        Cluster* largest = nullptr;
        for (Cluster& c : clusters)
            if (!c.whole && (!largest || c.radius > largest->radius)) largest = &c;
        if (!largest) break;
        largest->whole = true;
        if (largest->points.size() < 6) continue;
        auto [a, b] = largest->split();
        if (a.radius * a.radius + b.radius * b.radius > 0.8 * largest->radius * largest->radius) continue;
        *largest = std::move(a);
        clusters.push_back(std::move(b));
    }
    return clusters;
}

/// Solid angle, over 4 pi, of the spheres from a point; overlaps count twice.
double share_from(const std::vector<dev::Caster>& casters, const dvec3& p) {
    double share = 0;
    for (const dev::Caster& c : casters) {
        const dvec3 to = dvec3(c.centre[0], c.centre[1], c.centre[2]) - p;
        const double sin2 = double(c.radius) * c.radius / glm::dot(to, to);
        share += sin2 < 1 ? 0.5 * sin2 / (1 + std::sqrt(1 - sin2)) : 1.0;
    }
    return share;
}

dvec3 point_of(const dev::Light& l) {
    dvec3 p(l.position[0], l.position[1], l.position[2]);
    if (l.type == LIGHT_TRIANGLE)
        p += (dvec3(l.edge1[0], l.edge1[1], l.edge1[2]) + dvec3(l.edge2[0], l.edge2[1], l.edge2[2])) / 3.0;
    return p;
}

/// Emissive geometries, each as a whole, that are small beside their distance to the nearest caster: whose
/// radius is less than this share of it, or that of a disc of their area less than half as much (thin tubes).
std::vector<bool> small_triangle_lights(const PackedScene& packed, double share) {
    std::vector<bool> small(packed.lights.size());
    for (std::size_t g = 0; g < packed.geometries.size(); ++g) {
        const std::uint32_t first = packed.geometries[g].first_light;
        if (first == TRIAD_NONE) continue;
        std::size_t end = first;
        Bounds light;
        double area = 0;
        for (; end < packed.lights.size() && packed.lights[end].type == LIGHT_TRIANGLE &&
               packed.triangles[packed.lights[end].primitive].geometry == g;
             ++end) {
            const dev::Light& l = packed.lights[end];
            const dvec3 p(l.position[0], l.position[1], l.position[2]);
            for (const dvec3& q : {p, p + dvec3(l.edge1[0], l.edge1[1], l.edge1[2]),
                                   p + dvec3(l.edge2[0], l.edge2[1], l.edge2[2])})
                light.add(q);
            area += l.area;
        }
        const double radius = std::min(light.radius(), 2 * std::sqrt(area / pi));
        double distance = INFINITY;
        for (const dev::Caster& c : packed.casters)
            distance = std::min(
                distance,
                glm::length(dvec3(c.centre[0], c.centre[1], c.centre[2]) - light.centre()) - c.radius);
        const bool near = share_from(packed.casters, light.centre()) > near_share;
        if (radius < (near ? near_light : share) * distance)
            for (std::size_t i = first; i < end; ++i) small[i] = true;
    }
    return small;
}

/// Share of the light of the map that comes from where it is drawn far more often than evenly.
bool has_sun(const Scene& scene) {
    const EnvironmentMap& e = *scene.environment;
    double total = 0, sun = 0, weights = 0;
    std::vector<double> rows(e.height);
    auto value = [&](std::size_t i) { return double(e.rgb[3 * i]) + e.rgb[3 * i + 1] + e.rgb[3 * i + 2]; };
    for (unsigned y = 0; y < e.height; ++y) rows[y] = std::sin((y + 0.5) * pi / e.height);
    for (std::size_t i = 0; i < std::size_t(e.width) * e.height; ++i)
        total += rows[i / e.width] * value(i), weights += rows[i / e.width];
    const double mean = total / weights;
    for (std::size_t i = 0; i < std::size_t(e.width) * e.height; ++i)
        if (value(i) > sun_density * mean) sun += rows[i / e.width] * value(i);
    return sun > sun_share * total;
}

/// The classic method traces all light from its sources.
void refuse_for_map(const Scene& scene, const PackedScene& packed) {
    if (packed.lights.empty())
        throw Error(Exit::scene,
                    "--integrator photon-map: the scene has no lamp and no map to emit photons.");
    const dev::Environment& e = packed.environment;
    if (!scene.environment && (e.colour[0] > 0 || e.colour[1] > 0 || e.colour[2] > 0))
        throw Error(
            Exit::scene,
            "--integrator photon-map: a background of one colour emits no photons; give --env FILE or "
            "none.");
}

}  // namespace

void pack_photons(const Scene& scene, const RenderSettings& settings, PackedScene& packed) {
    const auto paths = [&](const std::string& why) {
        packed.casters.clear();
        for (dev::Light& l : packed.lights) l.flags &= ~std::uint32_t(LIGHT_PHOTONS);
        packed.environment.photons = 0;
        packed.integrator = "path: " + why;
    };
    const bool map = settings.integrator == Integrator::photon_map;
    if (settings.integrator == Integrator::path) return paths("as asked");
    if (settings.integrator != Integrator::automatic &&
        (settings.ray_start == RayStart::filter || settings.spectral == Spectral::full))
        throw Error(
            Exit::usage,
            "--integrator photons, light and photon-map go with neither random3 nor --spectral full: photons "
            "carry RGB or one wavelength, for whole pixels.");
    if (map) refuse_for_map(scene, packed);
    if (settings.ray_start == RayStart::filter) return paths("rays start by a pixel filter");
    if (settings.spectral == Spectral::full) return paths("photons carry RGB or one wavelength, not four");
    if (packed.lights.empty()) return paths("nothing that photons could come from");
    bool strong = false;
    for (const Cluster& c : clusters_of(scene, packed.origin, strong))
        packed.casters.push_back({{float(c.centre.x), float(c.centre.y), float(c.centre.z)},
                                  float(c.radius * (1 + 1e-5) + 1e-30)});
    const bool automatic = settings.integrator == Integrator::automatic;
    if (packed.casters.empty() && !map) return paths("nothing reflects or refracts without blur");
    if (automatic && !strong) return paths("nothing but varnish reflects without blur");

    const bool aimed = settings.aim_photons && !map;
    const bool sun = automatic && packed.environment.light != TRIAD_NONE && has_sun(scene);
    // Once photons are traced, lights of middling size are better left to them too.
    const std::vector<bool> reason = small_triangle_lights(packed, small_light),
                            small = small_triangle_lights(packed, near_light);
    const auto may_emit = [&](const dev::Light& l) {
        return l.pick > 0 && (!automatic || l.type != LIGHT_ENVIRONMENT || sun);
    };
    const auto is_reason = [&](const dev::Light& l) {
        return may_emit(l) && (!automatic || l.type != LIGHT_TRIANGLE || reason[&l - packed.lights.data()]);
    };
    packed.photons_in_doubt = std::none_of(packed.lights.begin(), packed.lights.end(), is_reason);
    std::vector<double> weights(packed.lights.size(), 0.0);
    bool any = false;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        dev::Light& l = packed.lights[i];
        if (!may_emit(l)) continue;
        if (automatic && l.type == LIGHT_TRIANGLE && !small[i] && !packed.photons_in_doubt) continue;
        const bool afar = l.type == LIGHT_DIRECTIONAL || l.type == LIGHT_ENVIRONMENT;
        weights[i] =
            l.pick * (afar || !aimed ? 1.0 : std::clamp(share_from(packed.casters, point_of(l)), 1e-6, 1.0));
        l.flags |= LIGHT_PHOTONS;
        if (l.type == LIGHT_ENVIRONMENT) packed.environment.photons = 1;
        any = true;
    }
    if (!any) return paths("no light is small enough for photons");
    packed.photon_lights_shape = cdf_shape(weights.size());
    packed.photon_lights.resize(packed.photon_lights_shape.size);
    write_cdf_tree(packed.photon_lights_shape, integer_cdf(weights), packed.photon_lights.data());
    packed.chosen = automatic ? Integrator::photons : settings.integrator;
    packed.integrator = packed.photons_in_doubt ? "photons: something casts the light of a large source"
                        : automatic             ? "photons: something casts the light of a small source"
                        : map                   ? "photon-map: as asked"
                        : settings.integrator == Integrator::light ? "light: as asked"
                                                                   : "photons: as asked";
}

}  // namespace triad
