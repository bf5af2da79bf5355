#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/limits.h"
#include "scene/scene.h"

namespace triad {
namespace {

[[noreturn]] void fail(const std::string& sentence) { throw Error(Exit::scene, sentence); }

void require(bool condition, const std::string& what, const char* why) {
    if (!condition) fail(what + " " + why + ".");
}

std::string label(const char* kind, std::size_t i, const std::string& name) {
    return std::string(kind) + " " + std::to_string(i) + (name.empty() ? "" : " '" + name + "'");
}

template <class Vector>
bool is_finite(const Vector& v) {
    for (int k = 0; k < Vector::length(); ++k)
        if (!std::isfinite(v[k])) return false;
    return true;
}

bool is_finite(const dmat4& m) {
    return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]) && is_finite(m[3]);
}

template <class Vector>
bool all_finite(const std::vector<Vector>& list) {
    return std::all_of(list.begin(), list.end(), [](const Vector& v) { return is_finite(v); });
}

/// False for what is no number, too.
template <class Vector>
bool within(const Vector& v, double limit) {
    for (int k = 0; k < Vector::length(); ++k)
        if (!(std::abs(double(v[k])) <= limit)) return false;
    return true;
}

using limits::text_of;

const std::string too_far = "has a coordinate beyond " + text_of(limits::coordinate) +
                            ", too large for the products of lengths that floats hold; scale the scene down";
const std::string too_large =
    " beyond " + text_of(limits::squared) + ", which float cannot square; give a smaller one";
const std::string no_brightness = "has a radiance or intensity that is negative, no number, or beyond " +
                                  text_of(limits::brightness) + "; scale all light down";

template <class Vector>
void require_near(const Vector& position, const std::string& what) {
    require(within(position, limits::coordinate), what, too_far.c_str());
}

void require_brightness(const vec3& v, const std::string& what) {
    require(v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f && within(v, limits::brightness), what,
            no_brightness.c_str());
}

bool in_unit(float x) { return x >= 0.0f && x <= 1.0f; }
bool at_least_zero(const vec3& v) { return is_finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f; }

void check_images(const Scene& scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        const Image& image = scene.images[i];
        const std::string what = label("Image", i, image.name);
        require(image.width > 0 && image.height > 0, what, "has no pixels");
        require(image.bits == 8 || image.bits == 16, what, "has neither 8 nor 16 bits per channel");
        require(image.texels.size() == std::uint64_t(image.width) * image.height * 4 * (image.bits / 8), what,
                "has a number of bytes that does not fit its size");
    }
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        require(scene.textures[i].image < scene.images.size(), label("Texture", i, ""), "has no image");
    if (const auto& map = scene.environment) {
        require(map->width > 0 && map->height > 0 &&
                    map->rgb.size() == std::uint64_t(map->width) * map->height * 3,
                "The environment map", "has a number of texels that does not fit its size");
        require(std::all_of(map->rgb.begin(), map->rgb.end(),
                            [](float x) { return x >= 0.0f && x <= limits::brightness; }),
                "The environment map", no_brightness.c_str());
    }
    require_brightness(scene.sky, "The sky");
}

bool is_factor(float x) { return x > 0.0f && x <= 1.0f; }
bool in_unit(const vec3& v) { return in_unit(v.x) && in_unit(v.y) && in_unit(v.z); }

/// The extensions that are there: each must do something.
void check_extensions(const Material& m, const std::string& what) {
    if (const auto& c = m.clearcoat) {
        require(is_factor(c->factor) && in_unit(c->roughness), what,
                "has a clearcoat of 0, or a factor or roughness of it outside 0 to 1");
        require(std::abs(c->normal_scale) <= limits::squared, what,
                ("has a normal scale of its clearcoat that is no number, or" + too_large).c_str());
    }
    if (const auto& s = m.sheen)
        require(in_unit(s->colour) && s->colour != vec3(0.0f) && in_unit(s->roughness), what,
                "has a black sheen, or a colour or roughness of it outside 0 to 1");
    if (const auto& a = m.anisotropy)
        require(is_factor(a->strength) && std::isfinite(a->rotation), what,
                "has an anisotropy of 0 or outside 0 to 1, or a rotation of it that is no number");
    if (const auto& i = m.iridescence) {
        require(is_factor(i->factor), what, "has an iridescence of 0 or outside 0 to 1");
        require(i->ior >= 1.0f && i->ior <= limits::squared, what,
                ("has an index of refraction of its iridescent film below 1, or" + too_large).c_str());
        require(i->thickness_minimum >= 0.0f && i->thickness_maximum >= 0.0f &&
                    std::max(i->thickness_minimum, i->thickness_maximum) <= limits::squared,
                what, ("has a thickness of its iridescent film that is negative, or" + too_large).c_str());
    }
    if (const auto& d = m.diffuse_transmission)
        require(is_factor(d->factor) && in_unit(d->colour), what,
                "has a diffuse transmission of 0, or a factor or colour of it outside 0 to 1");
}

void check_material(const Scene& scene, const Material& m, const std::string& what) {
    for (int k = 0; k < 4; ++k) require(in_unit(m.base_colour[k]), what, "has a base colour outside 0 to 1");
    require(in_unit(m.metallic) && in_unit(m.roughness), what,
            "has a metallic or roughness factor outside 0 to 1");
    require_brightness(m.emission, what);
    require(std::abs(m.normal_scale) <= limits::squared, what,
            ("has a normal scale that is no number, or" + too_large).c_str());
    require(std::isfinite(m.alpha_cutoff), what, "has an alpha cutoff that is no number");
    require(m.ior == 0.0f || (m.ior >= 1.0f && std::isfinite(m.ior)), what,
            "has an index of refraction below 1");
    require(!m.dispersion || (m.ior >= 1.0f && m.dispersion->is_sane()), what,
            "has a dispersion that gives an index of refraction outside 1 to 10 at some visible wavelength");
    require(!m.emission_spectrum || m.emission_spectrum->is_sane(), what,
            "has a spectrum without visible power, or of an absurd temperature");
    require(m.priority <= most_priority, what, "has a priority above 255");
    require(in_unit(m.specular) && at_least_zero(m.specular_colour), what,
            "has a specular factor out of range");
    require(in_unit(m.transmission), what, "has a transmission outside 0 to 1");
    require(m.thickness >= 0.0f && std::isfinite(m.thickness), what,
            "has a thickness that is negative or no number");
    require(
        at_least_zero(m.attenuation_colour) && glm::all(glm::lessThanEqual(m.attenuation_colour, vec3(1.0f))),
        what, "has an attenuation colour outside 0 to 1");
    require(m.attenuation_distance >= 1.0 / limits::squared, what,
            ("has an attenuation distance that is no number, or below " + text_of(1.0 / limits::squared))
                .c_str());
    check_extensions(m, what);
    for (const TextureUse* use : texture_uses_of(m)) {
        require(use->texture < scene.textures.size(), what, "uses a texture that does not exist");
        require(use->uv_set < 2, what, "uses a UV set beyond 1");
        require(std::all_of(use->transform.begin(), use->transform.end(),
                            [](float x) { return std::isfinite(x); }),
                what, "has a texture transform with elements that are no numbers");
    }
}

/// Removes triangles without area or with non-finite corners; returns how many.
std::size_t drop_undrawable(Primitive& p) {
    const auto is_undrawable = [&](const uvec3& t) {
        const dvec3 a = p.positions[t.x], b = p.positions[t.y], c = p.positions[t.z];
        const dvec3 n = glm::cross(b - a, c - a);
        return !is_finite(a) || !is_finite(b) || !is_finite(c) || n == dvec3(0.0);
    };
    const std::size_t dropped =
        std::erase_if(p.triangles, is_undrawable) + std::erase_if(p.strokes, [&](const uvec2& s) {
            return !is_finite(p.positions[s.x]) || !is_finite(p.positions[s.y]);
        });
    for (vec3& position : p.positions)  // what is left of them belongs to no triangle
        if (!is_finite(position)) position = vec3(0.0f);
    return dropped;
}

std::size_t check_primitive(const Scene& scene, Primitive& p, const std::string& what) {
    const std::size_t count = p.positions.size();
    const auto fits = [&](const auto& list) { return list.empty() || list.size() == count; };
    require(fits(p.normals) && fits(p.tangents) && fits(p.uvs[0]) && fits(p.uvs[1]) && fits(p.colours), what,
            "has attributes of different lengths");
    require(p.material < scene.materials.size(), what, "has a material that does not exist");
    require(all_finite(p.normals) && all_finite(p.tangents) && all_finite(p.uvs[0]) && all_finite(p.uvs[1]) &&
                all_finite(p.colours),
            what, "has attributes that are no numbers");
    for (const uvec3& t : p.triangles)
        require(t.x < count && t.y < count && t.z < count, what, "has a triangle corner that does not exist");
    for (const uvec2& s : p.strokes)
        require(s.x < count && s.y < count, what, "has the end of a line that does not exist");
    for (const vec3& n : p.normals)
        require(std::abs(glm::dot(n, n) - 1.0f) < 1e-3f, what, "has a normal that is not of unit length");
    for (const vec4& t : p.tangents)
        require(std::abs(glm::dot(vec3(t), vec3(t)) - 1.0f) < 1e-3f && std::abs(t.w) == 1.0f, what,
                "has a tangent that is not of unit length or without sign");
    const std::size_t dropped = drop_undrawable(p);
    for (const uvec3& t : p.triangles)
        for (int c = 0; c < 3; ++c) require_near(p.positions[t[c]], what);
    for (const uvec2& s : p.strokes)
        for (int c = 0; c < 2; ++c) require_near(p.positions[s[c]], what);
    return dropped;
}

void check_placed(const Scene& scene) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const MeshInstance& instance = scene.instances[i];
        const std::string what = label("Instance", i, instance.name);
        require(instance.mesh < scene.meshes.size(), what, "has no mesh");
        require(is_finite(instance.to_world), what, "has a transform with elements that are no numbers");
        require(glm::determinant(dmat3(instance.to_world)) != 0.0, what,
                "has a transform that cannot be inverted");
        for (int axis = 0; axis < 3; ++axis)
            require(within(instance.to_world[axis], limits::squared), what,
                    ("has a scale" + too_large).c_str());
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const PunctualLight& light = scene.lights[i];
        const std::string what = label("Light", i, light.name);
        require_brightness(light.colour, what);
        require_near(light.position, what);
        require(std::abs(glm::length(light.direction) - 1.0) < 1e-6, what,
                "has a direction that is not of unit length");
        require(light.range >= 0.0f && std::isfinite(light.range), what,
                "has a range that is negative or no number");
        require(
            light.inner_cone >= 0.0f && light.inner_cone <= light.outer_cone && light.outer_cone <= 1.5708f,
            what, "has cone angles out of order");
        require(!light.spectrum || light.spectrum->is_sane(), what,
                "has a spectrum without visible power, or of an absurd temperature");
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const SceneCamera& camera = scene.cameras[i];
        const std::string what = label("Camera", i, camera.name);
        require(is_finite(camera.to_world), what, "has a transform with elements that are no numbers");
        require_near(dvec3(camera.to_world[3]), what);
        require(camera.yfov > 0.0 && camera.yfov < pi, what, "has a field of view outside 0 to 180 degrees");
        require(camera.aspect >= 0.0 && camera.aspect <= 1e6, what,
                "has an aspect ratio that is negative or beyond a million");
        require(camera.magnification.x > 0.0 && camera.magnification.y > 0.0 &&
                    within(camera.magnification, limits::coordinate),
                what,
                ("has a magnification (xmag, ymag) that is not positive, or beyond " +
                 text_of(limits::coordinate) + "; scale the scene down")
                    .c_str());
    }
}

/// Removes primitives without triangles, and instances of meshes without primitives. Meshes keep their
/// places.
void drop_empty(Scene& scene) {
    for (Mesh& mesh : scene.meshes)
        std::erase_if(mesh.primitives,
                      [](const Primitive& p) { return p.triangles.empty() && p.strokes.empty(); });
    std::erase_if(scene.instances,
                  [&](const MeshInstance& i) { return scene.meshes[i.mesh].primitives.empty(); });
}

}  // namespace

std::size_t validate(Scene& scene) {
    check_images(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        check_material(scene, scene.materials[i], label("Material", i, scene.materials[i].name));
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        for (std::size_t k = 0; k < scene.meshes[i].primitives.size(); ++k)
            dropped +=
                check_primitive(scene, scene.meshes[i].primitives[k],
                                label("Mesh", i, scene.meshes[i].name) + ", primitive " + std::to_string(k));
    check_placed(scene);
    drop_empty(scene);
    if (const Bounds bounds = bounds_of(scene); !bounds.empty()) {
        require_near(bounds.lo, "The scene, placed,");
        require_near(bounds.hi, "The scene, placed,");
    }
    return dropped;
}

}  // namespace triad
