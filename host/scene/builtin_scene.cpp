#include "scene/builtin_scene.h"

#include <algorithm>
#include <array>
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

using Texel = std::array<std::uint8_t, 4>;

Texel encode_srgb(const dvec3& linear) {
    Texel texel{0, 0, 0, 255};
    for (int c = 0; c < 3; ++c) {
        const double v =
            linear[c] <= 0.0031308 ? 12.92 * linear[c] : 1.055 * std::pow(linear[c], 1 / 2.4) - 0.055;
        texel[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
    }
    return texel;
}

/// Chips of stone: a chip is what lies near enough to the middle of its Voronoi cell. Tileable.
class Chips {
  public:
    Chips(unsigned cells, double share, double reach, std::uint32_t salt) : cells_(cells) {
        const dvec3 stones[] = {{0.36, 0.34, 0.33}, {0.80, 0.77, 0.72}, {0.14, 0.15, 0.17},
                                {0.52, 0.30, 0.21}, {0.70, 0.54, 0.36}, {0.30, 0.36, 0.35}};
        chips_.reserve((cells + 2) * (cells + 2));
        for (unsigned y = 0; y < cells + 2; ++y)
            for (unsigned x = 0; x < cells + 2; ++x) {
                const unsigned id = (y + cells - 1) % cells * cells + (x + cells - 1) % cells;
                const auto random = [&](unsigned which) { return random_of(id, which, salt); };
                const auto kind = static_cast<std::size_t>(random(5) * std::size(stones));
                chips_.push_back({dvec2(x, y) - 1.0 + (0.15 + 0.7 * dvec2(random(1), random(2))),
                                  random(4) > share ? -1 : reach * (0.55 + 0.9 * random(3)),
                                  encode_srgb(stones[kind] * (0.85 + 0.3 * random(6)))});
            }
    }
    /// What lies at a point of [0, 1)^2, or null.
    const Texel* at(const dvec2& point) const {
        const dvec2 p = point * double(cells_);
        const ivec2 cell(glm::floor(p));
        double nearest = 81, second = 81;  // squares
        const Chip* chip = nullptr;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const Chip& one = chips_[std::size_t(cell.y + j) * (cells_ + 2) + std::size_t(cell.x + i)];
                const dvec2 off = p - one.middle;
                const double d = glm::dot(off, off);
                if (d < nearest)
                    second = nearest, nearest = d, chip = &one;
                else
                    second = std::min(second, d);
            }
        nearest = std::sqrt(nearest), second = std::sqrt(second);
        return second - nearest < 0.16 || nearest > chip->reach ? nullptr : &chip->texel;
    }

  private:
    struct Chip {
        dvec2 middle;  // in cells
        double reach;  // below 0: the cell is empty
        Texel texel;
    };
    unsigned cells_;
    std::vector<Chip> chips_;  // with a border of one cell, which repeats the other side
};

/// Chips of two sizes in plaster.
Image terrazzo(unsigned side) {
    const Chips large(12, 0.62, 0.33, 5), small(34, 0.55, 0.30, 11);
    Image image{"terrazzo", side, side, 8, std::vector<std::uint8_t>(std::size_t(side) * side * 4)};
    parallel_for(side / 2, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            for (unsigned i = 0; i < side / 2; ++i) {
                const Texel plaster =
                    encode_srgb(dvec3(0.60, 0.57, 0.53) * (0.97 + 0.06 * random_of(i, std::uint32_t(k), 77)));
                for (unsigned part = 0; part < 4; ++part) {
                    const std::size_t x = 2 * i + part % 2, y = 2 * k + part / 2;
                    const dvec2 point = dvec2(x + 0.5, y + 0.5) / double(side);
                    const Texel* texel = large.at(point);
                    if (!texel) texel = small.at(point);
                    if (!texel) texel = &plaster;
                    std::copy(texel->begin(), texel->end(), image.texels.begin() + 4 * (y * side + x));
                }
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
