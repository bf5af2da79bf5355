#include "scene/builtin_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel_for.h"
#include "scene/shapes.h"

namespace triad {
namespace {

/// PCG hash of three numbers, to [0, 1).
double random_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ z * 0xc2b2ae3du;
    h = h * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28) + 4)) ^ h) * 277803737u;
    return ((h >> 22) ^ h) / 4294967296.0;
}

std::uint8_t encode_srgb(double linear) {
    const double v = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

/// Chips of stone in plaster, tileable: a chip is what lies near enough to the middle of its Voronoi cell, in
/// two sizes.
Image terrazzo(unsigned side) {
    const dvec3 plaster(0.60, 0.57, 0.53);
    const dvec3 chips[] = {{0.36, 0.34, 0.33}, {0.80, 0.77, 0.72}, {0.14, 0.15, 0.17},
                           {0.52, 0.30, 0.21}, {0.70, 0.54, 0.36}, {0.30, 0.36, 0.35}};
    Image image{"terrazzo", side, side, 8, std::vector<std::uint8_t>(std::size_t(side) * side * 4, 255)};
    struct Layer {
        unsigned cells;
        double share, reach;
        std::uint32_t salt;
        std::vector<dvec2> middles;  // of its cells, from their corners
    };
    Layer layers[] = {{34, 0.55, 0.30, 11, {}}, {12, 0.62, 0.33, 5, {}}};
    for (Layer& layer : layers)
        for (unsigned id = 0; id < layer.cells * layer.cells; ++id)
            layer.middles.push_back(0.15 +
                                    0.7 * dvec2(random_of(id, 1, layer.salt), random_of(id, 2, layer.salt)));
    const auto colour_at = [&](unsigned x, unsigned y) {
        dvec3 colour = plaster * (0.97 + 0.06 * random_of(x / 2, y / 2, 77));
        for (const Layer& layer : layers) {
            const dvec2 p = dvec2(x + 0.5, y + 0.5) * (double(layer.cells) / side);
            const ivec2 cell(glm::floor(p));
            double nearest = 81, second = 81;  // squares
            unsigned who = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const ivec2 c = cell + ivec2(i, j);
                    const unsigned id =
                        (c.y + layer.cells) % layer.cells * layer.cells + (c.x + layer.cells) % layer.cells;
                    const dvec2 off = p - (dvec2(c) + layer.middles[id]);
                    const double d = glm::dot(off, off);
                    if (d < nearest)
                        second = nearest, nearest = d, who = id;
                    else
                        second = std::min(second, d);
                }
            nearest = std::sqrt(nearest), second = std::sqrt(second);
            const double size = layer.reach * (0.55 + 0.9 * random_of(who, 3, layer.salt));
            if (random_of(who, 4, layer.salt) > layer.share || second - nearest < 0.16 || nearest > size)
                continue;
            const auto kind = static_cast<std::size_t>(random_of(who, 5, layer.salt) * std::size(chips));
            colour = chips[kind] * (0.85 + 0.3 * random_of(who, 6, layer.salt));
        }
        return colour;
    };
    parallel_for(side, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (unsigned x = 0; x < side; ++x) {
                const dvec3 colour = colour_at(x, unsigned(y));
                for (int c = 0; c < 3; ++c) image.texels[(y * side + x) * 4 + c] = encode_srgb(colour[c]);
            }
    });
    return image;
}

/// A studio: a dim room, warm at one side and cool at the other, brighter above.
EnvironmentMap studio() {
    EnvironmentMap map{128, 64, std::vector<float>(128 * 64 * 3)};
    for (unsigned y = 0; y < map.height; ++y) {
        for (unsigned x = 0; x < map.width; ++x) {
            const double up = std::cos(pi * (y + 0.5) / map.height),
                         phi = 2 * pi * ((x + 0.5) / map.width - 0.5);
            const double side = std::cos(phi) * std::sqrt(1 - up * up);  // towards +x
            const double grey = up > 0 ? 0.16 + 0.34 * up * up : 0.16 + 0.10 * up;
            const dvec3 tint = glm::mix(dvec3(1.10, 0.98, 0.86), dvec3(0.84, 0.98, 1.14), 0.5 + 0.5 * side);
            for (int c = 0; c < 3; ++c)
                map.rgb[(std::size_t(y) * map.width + x) * 3 + c] = static_cast<float>(grey * tint[c]);
        }
    }
    return map;
}

Material dielectric(const char* name, const vec3& colour, float roughness) {
    Material m;
    m.name = name, m.base_colour = vec4(colour, 1), m.metallic = 0, m.roughness = roughness;
    return m;
}

Material metal(const char* name, const vec3& colour, float roughness) {
    Material m;
    m.name = name, m.base_colour = vec4(colour, 1), m.roughness = roughness;
    return m;
}

/// Clear glass that keeps `colour` of white light after `distance`.
Material glass(const char* name, const vec3& colour, float distance) {
    Material m;
    m.name = name, m.metallic = 0, m.roughness = 0, m.transmission = 1, m.thickness = 1;
    m.attenuation_colour = colour, m.attenuation_distance = distance;
    return m;
}

class Builder {
  public:
    Scene scene;

    std::size_t add(Material material) {
        scene.materials.push_back(std::move(material));
        return scene.materials.size() - 1;
    }

    void place(const char* name, Primitive shape, std::size_t material, const dmat4& to_world = dmat4(1)) {
        shape.material = material;
        scene.meshes.push_back({name, {std::move(shape)}});
        scene.instances.push_back({name, scene.meshes.size() - 1, to_world});
    }
};

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1), dvec3(x, y, z)); }
dmat4 turned(double degrees, const dvec3& axis) { return glm::rotate(dmat4(1), degrees * pi / 180, axis); }

void add_room(Builder& b) {
    b.scene.images.push_back(terrazzo(1024));
    b.scene.textures.push_back({0});
    Material floor = dielectric("terrazzo", vec3(1), 0.22f);
    floor.base_colour_texture = TextureUse{0};
    b.place("floor", shapes::quad({-6, 0, 5}, {12, 0, 0}, {0, 0, -9}), b.add(floor));
    // Texels are square on the floor: 1.5 m a tile.
    for (vec2& uv : b.scene.meshes.back().primitives[0].uvs[0]) uv *= vec2(8, 6);
    b.place("wall", shapes::quad({-8, 0, -4}, {16, 0, 0}, {0, 6, 0}),
            b.add(dielectric("wall", vec3(0.42f, 0.45f, 0.49f), 0.9f)));
}

void add_lights(Builder& b) {
    auto light = [&](const char* name, const vec3& radiance, const dvec3& centre, const dvec3& target,
                     double width, double height) {
        const dvec3 forward = glm::normalize(target - centre),
                    u = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
        const dvec3 v = glm::cross(u, forward);
        Material m = dielectric(name, vec3(0), 1);
        m.emission = radiance;
        // cross(v, u) is forward: the panel shines at its target.
        b.place(name,
                shapes::quad(vec3(centre - 0.5 * width * u - 0.5 * height * v), vec3(height * v),
                             vec3(width * u)),
                b.add(m));
    };
    light("key light", vec3(9.0f, 8.6f, 8.0f), {-2.6, 3.6, 1.2}, {0, 0.4, -0.2}, 2.2, 1.6);
    light("rim light", vec3(7.0f, 7.6f, 8.6f), {2.6, 2.3, -2.3}, {0, 0.5, -0.2}, 0.7, 2.2);
    light("fill light", vec3(1.6f, 1.6f, 1.7f), {3.2, 1.6, 2.6}, {0, 0.5, 0}, 1.6, 1.6);
}

void add_bodies(Builder& b) {
    const std::size_t red = b.add(glass("red glass", {0.92f, 0.035f, 0.03f}, 0.22f));
    const std::size_t green = b.add(glass("green glass", {0.06f, 0.80f, 0.16f}, 0.22f));
    const std::size_t blue = b.add(glass("blue glass", {0.04f, 0.16f, 0.93f}, 0.22f));
    const std::size_t clear = b.add(glass("clear glass", {0.86f, 0.97f, 0.94f}, 0.5f));
    const std::size_t gold = b.add(metal("gold", {1.0f, 0.77f, 0.34f}, 0.04f));
    const std::size_t copper = b.add(metal("brushed copper", {0.96f, 0.64f, 0.54f}, 0.32f));
    const std::size_t chrome = b.add(metal("chrome", {0.86f, 0.87f, 0.88f}, 0.03f));

    // The triad: three upright bars, one pixel of a display.
    const Primitive bar = shapes::rounded_box({0.17, 0.66, 0.13}, 0.05, 8);
    const double base =
        0.66 + 0.001;  // bodies stand a millimetre above the floor, as glass needs air under it
    b.place("red bar", bar, red, at(-0.44, base, -0.30) * turned(8, {0, 1, 0}));
    b.place("green bar", bar, green, at(0.0, base, -0.36));
    b.place("blue bar", bar, blue, at(0.44, base, -0.30) * turned(-8, {0, 1, 0}));

    b.place("gold sphere", shapes::lat_long_sphere(vec3(0), 0.19f, 128, 64), gold, at(-0.62, 0.191, 0.28));
    b.place("clear sphere", shapes::lat_long_sphere(vec3(0), 0.15f, 128, 64), clear, at(0.10, 0.151, 0.42));
    b.place("copper sphere", shapes::lat_long_sphere(vec3(0), 0.10f, 96, 48), copper, at(-0.25, 0.101, 0.58));
    b.place("chrome ring", shapes::torus(vec3(0), 0.20f, 0.055f, 120, 40), chrome, at(0.60, 0.056, 0.30));
    b.place("copper ring", shapes::torus(vec3(0), 0.11f, 0.032f, 96, 32), copper,
            at(0.60, 0.056 + 0.19, 0.30) * turned(64, {1, 0, 0.35}));
    b.place("chrome sphere", shapes::lat_long_sphere(vec3(0), 0.065f, 80, 40), chrome, at(0.33, 0.066, 0.68));
}

}  // namespace

Scene builtin_scene() {
    Builder b;
    b.scene.name = "built-in";
    add_room(b);
    add_lights(b);
    add_bodies(b);
    b.scene.environment = studio();
    SceneCamera camera;
    camera.name = "camera";
    camera.yfov = 26 * pi / 180;
    camera.aspect = 16.0 / 9;
    camera.to_world =
        glm::inverse(glm::lookAt(dvec3(0.25, 1.15, 3.9), dvec3(0.0, 0.50, 0.0), dvec3(0, 1, 0)));
    b.scene.cameras.push_back(camera);
    return b.scene;
}

}  // namespace triad
