#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "base/colour.h"
#include "base/error.h"
#include "pack/pack.h"

namespace triad {

namespace {

class TexturePacker {
  public:
    TexturePacker(const Scene& scene, PackedSurfaces& out) : scene_(scene), out_(out) {}

    std::uint32_t use(const std::optional<TextureUse>& use, bool srgb) {
        if (!use) return TRIAD_NONE;
        dev::TextureUse u{};
        u.texture = texture(use->texture, srgb);
        u.uv_set = use->uv_set;
        std::copy(use->transform.begin(), use->transform.end(), u.m);
        out_.texture_uses.push_back(u);
        return static_cast<std::uint32_t>(out_.texture_uses.size() - 1);
    }

  private:
    const Scene& scene_;
    PackedSurfaces& out_;
    std::map<std::pair<std::size_t, bool>, std::uint32_t> textures_;
    std::map<std::pair<std::size_t, bool>, std::uint32_t>
        images_;  // 8-bit texels are shared by both encodings

    std::uint32_t texture(std::size_t index, bool srgb) {
        auto [it, fresh] =
            textures_.try_emplace({index, srgb}, static_cast<std::uint32_t>(out_.textures.size()));
        if (!fresh) return it->second;
        const Texture& t = scene_.textures[index];
        const Image& image = scene_.images[t.image];
        auto wrap = [](Wrap w) {
            return w == Wrap::repeat ? WRAP_REPEAT : w == Wrap::mirror ? WRAP_MIRROR : WRAP_CLAMP;
        };
        dev::Texture d{};
        d.width = image.width;
        d.height = image.height;
        d.first_texel = texels(t.image, srgb);
        d.format = image.bits == 16 ? TEXTURE_RGBA16 : srgb ? TEXTURE_RGBA8_SRGB : TEXTURE_RGBA8;
        d.wrap_u = wrap(t.wrap_u);
        d.wrap_v = wrap(t.wrap_v);
        d.linear = t.linear;
        out_.textures.push_back(d);
        return it->second;
    }

    std::uint32_t texels(std::size_t index, bool srgb) {
        const Image& image = scene_.images[index];
        if (out_.texels.size() + image.texels.size() / 4 >= TRIAD_NONE)
            throw Error(Exit::memory, "The textures have more than 2^32 texels; use smaller images.");
        const bool decode = image.bits == 16 && srgb;
        auto [it, fresh] =
            images_.try_emplace({index, decode}, static_cast<std::uint32_t>(out_.texels.size()));
        if (!fresh) return it->second;
        const std::size_t first = out_.texels.size();
        out_.texels.resize(first + image.texels.size() / 4);
        std::memcpy(out_.texels.data() + first, image.texels.data(), image.texels.size());
        if (decode) {  // 16-bit texels have no table in the kernel; 16 linear bits keep what 16 encoded bits
                       // show
            auto* values = reinterpret_cast<std::uint16_t*>(out_.texels.data() + first);
            for (std::size_t i = 0; i < image.texels.size() / 2; ++i)
                if (i % 4 != 3)
                    values[i] =
                        static_cast<std::uint16_t>(std::lround(srgb_decode(values[i] / 65535.0) * 65535.0));
        }
        return it->second;
    }
};

/// The blocks of a material that has any: one that it lacks does nothing and uses no texture.
dev::MaterialExtensions extensions_of(const Material& m, TexturePacker& textures) {
    const Clearcoat c = m.clearcoat.value_or(Clearcoat{});
    const Sheen s = m.sheen.value_or(Sheen{});
    const Anisotropy a = m.anisotropy.value_or(Anisotropy{});
    const Iridescence i = m.iridescence.value_or(Iridescence{});
    const DiffuseTransmission d = m.diffuse_transmission.value_or(DiffuseTransmission{});
    dev::MaterialExtensions e{};
    e.clearcoat = {c.factor,
                   c.roughness,
                   c.normal_scale,
                   textures.use(c.texture, false),
                   textures.use(c.roughness_texture, false),
                   textures.use(c.normal_texture, false)};
    e.sheen = {{s.colour.x, s.colour.y, s.colour.z},
               s.roughness,
               textures.use(s.colour_texture, true),
               textures.use(s.roughness_texture, false)};
    e.anisotropy = {a.strength, {std::cos(a.rotation), std::sin(a.rotation)}, textures.use(a.texture, false)};
    e.iridescence = {i.factor,
                     i.ior,
                     i.thickness_minimum,
                     i.thickness_maximum,
                     textures.use(i.texture, false),
                     textures.use(i.thickness_texture, false)};
    e.diffuse_transmission = {d.factor,
                              {d.colour.x, d.colour.y, d.colour.z},
                              textures.use(d.texture, false),
                              textures.use(d.colour_texture, true)};
    return e;
}

}  // namespace

void pack_materials(const Scene& scene, PackedSurfaces& surfaces) {
    TexturePacker textures(scene, surfaces);
    for (const Material& m : scene.materials) {
        dev::Material d{};
        for (int c = 0; c < 4; ++c) d.base_colour[c] = m.base_colour[c];
        for (int c = 0; c < 3; ++c) {
            d.emission[c] = m.emission[c];
            d.specular_colour[c] = m.specular_colour[c];
            // Beer-Lambert: what is left after attenuation_distance is attenuation_colour. A colour of zero
            // would need an infinite coefficient; 1e-6 is black.
            d.absorption[c] =
                std::isinf(m.attenuation_distance)
                    ? 0.0f
                    : static_cast<float>(-std::log(std::max(double(m.attenuation_colour[c]), 1e-6)) /
                                         m.attenuation_distance);
        }
        d.alpha_cutoff = m.alpha_cutoff;
        d.metallic = m.metallic;
        d.roughness = m.roughness;
        d.ior = m.ior;
        d.normal_scale = m.normal_scale;
        d.specular = m.specular;
        d.transmission = m.transmission;
        d.flags = (m.double_sided ? MATERIAL_DOUBLE_SIDED : 0u) |
                  (m.alpha_mode == AlphaMode::mask ? MATERIAL_ALPHA_MASK : 0u) |
                  (m.alpha_mode == AlphaMode::blend ? MATERIAL_ALPHA_BLEND : 0u) |
                  (is_solid(m) ? MATERIAL_SOLID : 0u) | (m.unlit ? MATERIAL_UNLIT : 0u);
        d.base_colour_use = textures.use(m.base_colour_texture, true);
        d.metallic_roughness_use = textures.use(m.metallic_roughness_texture, false);
        d.normal_use = textures.use(m.normal_texture, false);
        d.emission_use = textures.use(m.emission_texture, true);
        d.specular_use = textures.use(m.specular_texture, false);
        d.specular_colour_use = textures.use(m.specular_colour_texture, true);
        d.transmission_use = textures.use(m.transmission_texture, false);
        d.dispersion = TRIAD_NONE;
        d.priority = m.priority;
        d.extensions = TRIAD_NONE;
        if (m.clearcoat || m.sheen || m.anisotropy || m.iridescence || m.diffuse_transmission) {
            d.extensions = std::uint32_t(surfaces.extensions.size());
            surfaces.extensions.push_back(extensions_of(m, textures));
        }
        surfaces.materials.push_back(d);
    }
}

}  // namespace triad
