#include "bench/feature_scenes.h"

#include <cmath>
#include <map>

#include "scene/shapes.h"
#include "scene/tangents.h"
#include "scene/view.h"

namespace triad {
namespace {

enum MaterialName : std::size_t {
    floor_material,
    wall_material,
    ring_material,
    rock_material,
    lamp_material
};

Material lambert(const vec4& colour) {
    Material m;
    m.base_colour = colour;
    m.metallic = 0.0f;
    m.roughness = 0.5f;
    m.specular = 0.0f;
    return m;
}

void place(Scene& scene, Primitive shape, std::size_t material, const std::vector<dvec3>& positions) {
    shape.material = material;
    const std::size_t mesh = scene.meshes.size();
    scene.meshes.push_back({"", {std::move(shape)}});
    for (const dvec3& at : positions) {
        MeshInstance instance;
        instance.mesh = mesh;
        instance.to_world[3] = dvec4(at, 1.0);
        scene.instances.push_back(instance);
    }
}

/// Three walls and a floor without a ceiling, a rock and five rings, all after Lambert, under an even sky.
FeatureScene plain(unsigned size) {
    FeatureScene s;
    s.scene.materials = {lambert({0.7f, 0.7f, 0.7f, 1.0f}), lambert({0.6f, 0.5f, 0.4f, 1.0f}),
                         lambert({0.3f, 0.5f, 0.7f, 1.0f}), lambert({0.5f, 0.6f, 0.4f, 1.0f}),
                         lambert({0.2f, 0.2f, 0.2f, 1.0f})};
    place(s.scene, shapes::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8, 8), floor_material, {dvec3(0.0)});
    place(s.scene, shapes::quad({-2, 0, -2}, {4, 0, 0}, {0, 2, 0}, 8, 4), wall_material, {dvec3(0.0)});
    place(s.scene, shapes::quad({-2, 0, 2}, {0, 0, -4}, {0, 2, 0}, 8, 4), wall_material, {dvec3(0.0)});
    place(s.scene, shapes::quad({2, 0, -2}, {0, 0, 4}, {0, 2, 0}, 8, 4), wall_material, {dvec3(0.0)});
    place(s.scene, shapes::displaced_sphere({0.0f, 0.55f, 0.0f}, 0.5f, 128, 64, 0.2f, 4.0f, 1), rock_material,
          {dvec3(0.0)});
    place(s.scene, shapes::torus(vec3(0.0f), 0.35f, 0.12f, 64, 24), ring_material,
          {{-1.2, 0.12, 0.9}, {1.2, 0.12, 0.9}, {-1.2, 0.12, -0.9}, {1.2, 0.12, -0.9}, {0.0, 1.4, 0.0}});
    place(s.scene, shapes::quad({-0.5f, 1.9f, -1.5f}, {1, 0, 0}, {0, 0, 1}), lamp_material, {dvec3(0.0)});
    s.scene.sky = vec3(0.5f);
    s.settings.width = s.settings.height = size;
    s.settings.view = look_at({0.0, 1.6, 4.4}, {0.0, 0.6, 0.0}, 0.8, 1.0);
    return s;
}

/// A texture of 256 x 256 texels; texel(x, y) gives its RGB bytes.
template <class Texel>
TextureUse add_texture(Scene& scene, Texel&& texel) {
    Image image;
    image.width = image.height = 256;
    for (unsigned y = 0; y < image.height; ++y)
        for (unsigned x = 0; x < image.width; ++x) {
            const std::array<std::uint8_t, 3> rgb = texel(x, y);
            image.texels.insert(image.texels.end(), {rgb[0], rgb[1], rgb[2], 255});
        }
    scene.images.push_back(std::move(image));
    Texture texture;
    texture.image = scene.images.size() - 1;
    scene.textures.push_back(texture);
    TextureUse use;
    use.texture = scene.textures.size() - 1;
    return use;
}

void use_textures(FeatureScene& s) {
    const TextureUse checks = add_texture(s.scene, [](unsigned x, unsigned y) {
        const std::uint8_t shade = ((x ^ y) & 32u) ? 230 : 140;
        return std::array<std::uint8_t, 3>{shade, shade, std::uint8_t(255 - x / 4)};
    });
    for (const std::size_t m : {floor_material, wall_material})
        s.scene.materials[m].base_colour_texture = checks;
    s.settings.texture_levels = false;
}

void use_normal_maps(FeatureScene& s) {
    const TextureUse waves = add_texture(s.scene, [](unsigned x, unsigned y) {
        const double tilt_x = 0.3 * std::sin(x * 0.2), tilt_y = 0.3 * std::sin(y * 0.2);
        const auto byte = [](double v) { return std::uint8_t(std::lround((v + 1.0) * 127.5)); };
        return std::array<std::uint8_t, 3>{byte(tilt_x), byte(tilt_y), 255};
    });
    for (const std::size_t m : {floor_material, wall_material}) s.scene.materials[m].normal_texture = waves;
}

void use_vertex_colours(FeatureScene& s) {
    for (Mesh& mesh : s.scene.meshes)
        for (Primitive& p : mesh.primitives)
            for (const vec3& at : p.positions) p.colours.push_back({0.5f + 0.5f * std::sin(at.x), 1, 1, 1});
}

void use_environment_map(FeatureScene& s) {
    EnvironmentMap map{512, 256, {}};
    for (unsigned y = 0; y < map.height; ++y)
        for (unsigned x = 0; x < map.width; ++x)
            for (int c = 0; c < 3; ++c)
                map.rgb.push_back(0.4f + 0.3f * std::sin(0.05f * float(x + 40 * c)) +
                                  (y == 60 && x == 300 ? 500.0f : 0.0f));
    s.scene.environment = std::move(map);
}

void use_specular(FeatureScene& s) {
    for (Material& m : s.scene.materials) m.specular = 1.0f;
}

void use_glass(FeatureScene& s) {
    use_specular(s);
    Material& ring = s.scene.materials[ring_material];
    ring.transmission = ring.thickness = 1.0f;
    ring.roughness = 0.1f;
}

/// Floor and walls, brushed: they alone have UVs, along which tangents run.
void use_anisotropy(FeatureScene& s) {
    for (const std::size_t m : {floor_material, wall_material})
        s.scene.materials[m].anisotropy = Anisotropy{.strength = 0.8f, .rotation = 0.5f};
    for (Mesh& mesh : s.scene.meshes)
        for (Primitive& p : mesh.primitives)
            if (s.scene.materials[p.material].anisotropy) generate_tangents(p, p.uvs[0]);
}

/// From where nothing is near.
constexpr double lamp_afar = 1.5;

void raise_lamp(FeatureScene& s, double height) { s.scene.instances.back().to_world[3].y += height; }

void add_point_lights(FeatureScene& s, int count) {
    for (int i = 0; i < count; ++i) {
        PunctualLight light;
        light.position = {0.5 - 0.1 * double(s.scene.lights.size()), 1.8, 1.0};
        light.colour = vec3(3.0f);
        s.scene.lights.push_back(light);
    }
}

using Use = void (*)(FeatureScene&);

/// How a scene uses a feature, and what it must use already.
struct Recipe {
    Use use;
    Use before = nullptr;
};

const std::map<std::string, Recipe>& recipes() {
    static const std::map<std::string, Recipe> all = {
        {"INSTANCES", {[](FeatureScene& s) { s.settings.flatten_below = 0; }}},
        {"ALPHA_TEST", {[](FeatureScene& s) {
             s.scene.materials[ring_material].alpha_mode = AlphaMode::blend;
             s.scene.materials[ring_material].base_colour.a = 0.5f;
         }}},
        {"TEXTURES", {use_textures}},
        {"TEXTURE_LEVELS", {[](FeatureScene& s) { s.settings.texture_levels = true; }, use_textures}},
        {"NORMAL_MAPS", {use_normal_maps, use_textures}},
        {"VERTEX_COLOURS", {use_vertex_colours}},
        {"SPECULAR", {use_specular}},
        {"TRANSMISSION", {use_glass, use_specular}},
        {"DISPERSION",
         {[](FeatureScene& s) { s.scene.materials[ring_material].dispersion = find_glass("N-BK7"); },
          use_glass}},
        {"LIGHT_SPECTRA",
         {[](FeatureScene& s) { s.scene.materials[lamp_material].emission_spectrum = LightSpectrum{}; },
          [](FeatureScene& s) {
              use_glass(s);
              s.scene.materials[ring_material].dispersion = find_glass("N-BK7");
              s.scene.materials[lamp_material].emission = vec3(5.0f);
          }}},
        {"PRIORITIES", {[](FeatureScene& s) { s.scene.materials[ring_material].priority = 1; }, use_glass}},
        {"CLEARCOAT", {[](FeatureScene& s) {
             s.scene.materials[rock_material].clearcoat = Clearcoat{.factor = 1.0f, .roughness = 0.2f};
         }}},
        {"SHEEN", {[](FeatureScene& s) {
             s.scene.materials[rock_material].sheen = Sheen{.colour = vec3(0.8f), .roughness = 0.5f};
         }}},
        {"ANISOTROPY", {use_anisotropy, use_specular}},
        {"IRIDESCENCE",
         {[](FeatureScene& s) { s.scene.materials[ring_material].iridescence = Iridescence{.factor = 1.0f}; },
          use_specular}},
        {"DIFFUSE_TRANSMISSION", {[](FeatureScene& s) {
             s.scene.materials[ring_material].diffuse_transmission =
                 DiffuseTransmission{.factor = 0.5f, .colour = vec3(0.8f, 0.6f, 0.4f)};
         }}},
        {"UNLIT", {[](FeatureScene& s) { s.scene.materials[rock_material].unlit = true; }}},
        {"TRIANGLE_LIGHTS",
         {[](FeatureScene& s) { s.scene.materials[lamp_material].emission = vec3(5.0f); },
          [](FeatureScene& s) { raise_lamp(s, lamp_afar); }}},
        {"NEAR_LIGHTS",
         {[](FeatureScene& s) { raise_lamp(s, -lamp_afar); },
          [](FeatureScene& s) {
              raise_lamp(s, lamp_afar);
              s.scene.materials[lamp_material].emission = vec3(5.0f);
          }}},
        {"PUNCTUAL_LIGHTS", {[](FeatureScene& s) { add_point_lights(s, 1); }}},
        {"ENVIRONMENT_MAP", {use_environment_map}},
        {"LIGHT_TREE",
         {[](FeatureScene& s) { add_point_lights(s, 1); }, [](FeatureScene& s) { add_point_lights(s, 16); }}},
        {"LENS", {[](FeatureScene& s) {
             s.settings.view.lens_radius = 0.03;
             s.settings.view.focus_distance = 4.4;
         }}},
        {"INDEPENDENT_SAMPLES", {[](FeatureScene& s) { s.settings.independent = true; }}},
        {"PHOTONS",
         {[](FeatureScene& s) { s.settings.integrator = Integrator::light; },
          [](FeatureScene& s) {
              use_specular(s);
              s.scene.materials[ring_material].roughness = 0.0f;
              s.scene.materials[lamp_material].emission = vec3(5.0f);
          }}},
        {"GATHER",
         {[](FeatureScene& s) { s.settings.integrator = Integrator::photons; },
          [](FeatureScene& s) {
              use_specular(s);
              s.settings.integrator = Integrator::light;
              s.scene.materials[ring_material].roughness = 0.0f;
              s.scene.materials[lamp_material].emission = vec3(5.0f);
          }}},
        {"RAY_STARTS", {[](FeatureScene& s) { s.settings.ray_start = RayStart::centre; }}},
        {"BINS", {[](FeatureScene& s) { s.settings.bins_x = s.settings.bins_y = 2; }}},
    };
    return all;
}

}  // namespace

std::vector<FeatureCase> feature_cases(unsigned size) {
    std::vector<FeatureCase> cases;
    for (const FeatureOption& feature : feature_options()) {
        const Recipe& recipe = recipes().at(feature.name);
        FeatureCase c{feature, plain(size), {}};
        if (recipe.before) recipe.before(c.without);
        c.with = c.without;
        recipe.use(c.with);
        validate(c.without.scene);
        validate(c.with.scene);
        cases.push_back(std::move(c));
    }
    return cases;
}

}  // namespace triad
