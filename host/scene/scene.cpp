#include "scene/scene.h"

#include "base/hash.h"

namespace triad {
namespace {

// Members are hashed one by one, never whole structs: padding bytes are not content.
template <class T>
requires std::is_arithmetic_v<T>
void put(Hash& h, const T& value) { h.add_value(value); }
void put(Hash& h, const std::string& text) { h.add(text); }

template <int N, class T, glm::qualifier Q>
void put(Hash& h, const glm::vec<N, T, Q>& v) {
    h.add(&v, sizeof v);
}
void put(Hash& h, const dmat4& m) { h.add(&m, sizeof m); }

template <class T>
void put_array(Hash& h, const std::vector<T>& list) {
    h.add_value(list.size());
    h.add(list.data(), list.size() * sizeof(T));
}

void put(Hash& h, const std::optional<TextureUse>& use) {
    h.add_value(std::uint8_t(use.has_value()));
    if (!use) return;
    h.add_value(use->texture).add_value(use->uv_set).add(use->transform.data(), sizeof use->transform);
}

void put(Hash& h, const std::optional<Dispersion>& d) {
    if (!d) return;  // scenes without keep the names they had
    h.add_value(int(d->law)).add_value(d->a);
    h.add(d->b.data(), sizeof d->b).add(d->c.data(), sizeof d->c);
}

void put(Hash& h, const std::optional<LightSpectrum>& s) {
    if (!s) return;  // as with dispersion
    h.add_value(int(s->law)).add_value(s->temperature).add_value(s->lines.size());
    for (const LightSpectrum::Line& line : s->lines) h.add_value(line.nanometres).add_value(line.power);
}

template <class... Members>
void put_all(Hash& h, const Members&... members) {
    (put(h, members), ...);
}

void put(Hash& h, const Clearcoat& c) {
    put_all(h, c.factor, c.roughness, c.normal_scale, c.texture, c.roughness_texture, c.normal_texture);
}
void put(Hash& h, const Sheen& s) {
    put_all(h, s.colour, s.roughness, s.colour_texture, s.roughness_texture);
}
void put(Hash& h, const Anisotropy& a) { put_all(h, a.strength, a.rotation, a.texture); }
void put(Hash& h, const Iridescence& i) {
    put_all(h, i.factor, i.ior, i.thickness_minimum, i.thickness_maximum, i.texture, i.thickness_texture);
}
void put(Hash& h, const DiffuseTransmission& d) {
    put_all(h, d.factor, d.colour, d.texture, d.colour_texture);
}

/// Nothing where there is no such extension: hashes of scenes without it are what they were before.
template <class Extension>
void put_named(Hash& h, const char* name, const std::optional<Extension>& e) {
    if (!e) return;
    h.add(name);
    put(h, *e);
}

void put(Hash& h, const Material& m) {
    put_all(h, m.base_colour, m.metallic, m.roughness, m.emission, m.normal_scale, int(m.alpha_mode),
            m.alpha_cutoff, std::uint8_t(m.double_sided), std::uint8_t(m.unlit), m.ior, m.specular,
            m.specular_colour, m.transmission, m.thickness, m.attenuation_colour, m.attenuation_distance,
            m.base_colour_texture, m.metallic_roughness_texture, m.normal_texture, m.emission_texture,
            m.specular_texture, m.specular_colour_texture, m.transmission_texture, m.dispersion,
            m.emission_spectrum);
    if (m.priority != 0) put(h, m.priority);
    put_named(h, "clearcoat", m.clearcoat);
    put_named(h, "sheen", m.sheen);
    put_named(h, "anisotropy", m.anisotropy);
    put_named(h, "iridescence", m.iridescence);
    put_named(h, "diffuse transmission", m.diffuse_transmission);
}

void put(Hash& h, const Mesh& mesh) {
    h.add_value(mesh.primitives.size());
    for (const Primitive& p : mesh.primitives) {
        put_array(h, p.positions);
        put_array(h, p.normals);
        put_array(h, p.tangents);
        put_array(h, p.uvs[0]);
        put_array(h, p.uvs[1]);
        put_array(h, p.colours);
        put_array(h, p.triangles);
        if (!p.strokes.empty()) put_array(h, p.strokes);
        h.add_value(p.material);
    }
}

}  // namespace

std::uint64_t bytes_of(const Primitive& p) {
    return sizeof(vec3) * (p.positions.size() + p.normals.size()) +
           sizeof(vec4) * (p.tangents.size() + p.colours.size()) +
           sizeof(vec2) * (p.uvs[0].size() + p.uvs[1].size()) + sizeof(uvec3) * p.triangles.size() +
           sizeof(uvec2) * p.strokes.size();
}

std::uint64_t bytes_of(const Scene& scene) {
    std::uint64_t bytes = sizeof(MeshInstance) * scene.instances.size() + sizeof(Mesh) * scene.meshes.size() +
                          sizeof(Material) * scene.materials.size();
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) bytes += sizeof(Primitive) + bytes_of(p);
    for (const Image& image : scene.images) bytes += image.texels.size();
    if (scene.environment) bytes += sizeof(float) * scene.environment->rgb.size();
    return bytes;
}

bool is_solid(const Material& m) {
    return m.thickness > 0.0f && (m.transmission > 0.0f || m.diffuse_transmission);
}

namespace {

/// To which textures are added that may be there or not.
void add_uses(std::vector<const TextureUse*>& uses, const auto&... all) {
    ((all ? uses.push_back(&*all) : void()), ...);
}

}  // namespace

std::vector<const TextureUse*> colour_uses_of(const Material& m) {
    std::vector<const TextureUse*> uses;
    add_uses(uses, m.base_colour_texture, m.emission_texture, m.specular_colour_texture);
    if (m.sheen) add_uses(uses, m.sheen->colour_texture);
    if (m.diffuse_transmission) add_uses(uses, m.diffuse_transmission->colour_texture);
    return uses;
}

std::vector<const TextureUse*> texture_uses_of(const Material& m) {
    std::vector<const TextureUse*> uses = colour_uses_of(m);
    add_uses(uses, m.metallic_roughness_texture, m.normal_texture, m.specular_texture,
             m.transmission_texture);
    if (m.clearcoat)
        add_uses(uses, m.clearcoat->texture, m.clearcoat->roughness_texture, m.clearcoat->normal_texture);
    if (m.sheen) add_uses(uses, m.sheen->roughness_texture);
    if (m.anisotropy) add_uses(uses, m.anisotropy->texture);
    if (m.iridescence) add_uses(uses, m.iridescence->texture, m.iridescence->thickness_texture);
    if (m.diffuse_transmission) add_uses(uses, m.diffuse_transmission->texture);
    return uses;
}

std::string hash_of(const Scene& scene) {
    Hash h;
    h.add_value(scene.images.size());
    for (const Image& image : scene.images) {
        put_all(h, image.width, image.height, image.bits);
        put_array(h, image.texels);
    }
    h.add_value(scene.textures.size());
    for (const Texture& t : scene.textures)
        put_all(h, t.image, int(t.wrap_u), int(t.wrap_v), std::uint8_t(t.linear));
    h.add_value(scene.materials.size());
    for (const Material& m : scene.materials) put(h, m);
    h.add_value(scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) put(h, mesh);
    h.add_value(scene.instances.size());
    for (const MeshInstance& i : scene.instances) put_all(h, i.mesh, i.to_world);
    h.add_value(scene.lights.size());
    for (const PunctualLight& l : scene.lights)
        put_all(h, int(l.type), l.position, l.direction, l.colour, l.range, l.inner_cone, l.outer_cone,
                l.spectrum);
    h.add_value(scene.cameras.size());
    for (const SceneCamera& c : scene.cameras)
        put_all(h, c.name, std::uint8_t(c.orthographic), c.yfov, c.aspect, c.magnification, c.to_world);
    h.add_value(std::uint8_t(scene.environment.has_value()));
    if (scene.environment) {
        put_all(h, scene.environment->width, scene.environment->height);
        put_array(h, scene.environment->rgb);
    }
    put(h, scene.sky);
    return h.hex();
}

}  // namespace triad
