#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "base/colour.h"
#include "base/error.h"
#include "pack/pack.h"
#include "pack/texture_levels.h"
#include "scene/image_reduce.h"

namespace triad {

namespace {

/// What a texture holds.
enum class TextureOf {
    values,  ///< linear: a mean would be the value of another material
    colours,
    averaged_colours  ///< where a mean of them may stand for many
};

class TexturePacker {
  public:
    TexturePacker(const Scene& scene, PackedSurfaces& out, bool with_levels) : scene_(scene), out_(out) {
        // All at once: a large vector that grew would lie beside its copy.
        std::uint64_t bytes = with_levels ? level_bytes(scene) : 0;
        for (const Image& image : scene.images) bytes += image.texels.size();
        out_.texels.reserve(bytes / sizeof(std::uint32_t));
    }

    std::uint32_t use(const std::optional<TextureUse>& use, TextureOf what = TextureOf::values) {
        if (!use) return TRIAD_NONE;
        dev::TextureUse u{};
        u.texture = texture(use->texture, what);
        u.uv_set = use->uv_set;
        std::copy(use->transform.begin(), use->transform.end(), u.m);
        out_.texture_uses.push_back(u);
        return static_cast<std::uint32_t>(out_.texture_uses.size() - 1);
    }

  private:
    const Scene& scene_;
    PackedSurfaces& out_;
    std::map<std::pair<std::size_t, TextureOf>, std::uint32_t> textures_;
    std::map<std::pair<std::size_t, bool>, std::uint32_t>
        images_;                                               // 8-bit texels are shared by both encodings
    std::map<std::size_t, std::vector<dev::Texture>> levels_;  // of images; of any sampler

    std::uint32_t texture(std::size_t index, TextureOf what) {
        auto [it, fresh] =
            textures_.try_emplace({index, what}, static_cast<std::uint32_t>(out_.textures.size()));
        if (!fresh) return it->second;
        const Texture& t = scene_.textures[index];
        const Image& image = scene_.images[t.image];
        const bool srgb = what != TextureOf::values;
        std::vector<dev::Texture> pyramid{shape(image, first_texel(t.image, srgb), srgb)};
        if (what == TextureOf::averaged_colours) {
            const std::vector<dev::Texture>& levels = levels_of(t.image);
            pyramid.front().levels = static_cast<std::uint32_t>(levels.size());
            pyramid.insert(pyramid.end(), levels.begin(), levels.end());
        }
        auto wrap = [](Wrap w) {
            return w == Wrap::repeat ? WRAP_REPEAT : w == Wrap::mirror ? WRAP_MIRROR : WRAP_CLAMP;
        };
        for (dev::Texture& d : pyramid) {
            d.wrap_u = wrap(t.wrap_u);
            d.wrap_v = wrap(t.wrap_v);
            d.linear = t.linear;
            out_.textures.push_back(d);
        }
        return it->second;
    }

    static dev::Texture shape(const Image& image, std::uint32_t first_texel, bool srgb) {
        dev::Texture d{};
        d.width = image.width;
        d.height = image.height;
        d.first_texel = first_texel;
        d.format = image.bits == 16 ? TEXTURE_RGBA16 : srgb ? TEXTURE_RGBA8_SRGB : TEXTURE_RGBA8;
        return d;
    }

    const std::vector<dev::Texture>& levels_of(std::size_t index) {
        auto [it, fresh] = levels_.try_emplace(index);
        if (!fresh) return it->second;
        const Image& image = scene_.images[index];
        Image level;  // of 16 bits, so that rounding does not add up from one to the next
        for (const uvec2& size : level_sizes(image)) {
            const unsigned side = std::max(size.x, size.y);
            level =
                it->second.empty() ? with_bits(reduced(image, side, true), 16) : reduced(level, side, true);
            const Image stored = with_bits(level, image.bits);
            it->second.push_back(shape(stored, add_texels(stored, true), true));
        }
        return it->second;
    }

    std::uint32_t first_texel(std::size_t index, bool srgb) {
        const Image& image = scene_.images[index];
        const bool decode = image.bits == 16 && srgb;
        auto [it, fresh] = images_.try_emplace({index, decode});
        if (fresh) it->second = add_texels(image, srgb);
        return it->second;
    }

    std::uint32_t add_texels(const Image& image, bool srgb) {
        if (out_.texels.size() + image.texels.size() / 4 >= TRIAD_NONE)
            throw Error(Exit::memory, "The textures have more than 2^32 texels; use smaller images.");
        const std::size_t first = out_.texels.size();
        out_.texels.resize(first + image.texels.size() / 4);
        std::memcpy(out_.texels.data() + first, image.texels.data(), image.texels.size());
        if (image.bits == 16 && srgb) {  // 16-bit texels have no table in the kernel; 16 linear bits keep
                                         // what 16 encoded bits show
            auto* values = reinterpret_cast<std::uint16_t*>(out_.texels.data() + first);
            for (std::size_t i = 0; i < image.texels.size() / 2; ++i)
                if (i % 4 != 3)
                    values[i] =
                        static_cast<std::uint16_t>(std::lround(srgb_decode(values[i] / 65535.0) * 65535.0));
        }
        return static_cast<std::uint32_t>(first);
    }
};

/// The blocks of a material that has any: one that it lacks does nothing and uses no texture.
dev::MaterialExtensions extensions_of(const Material& m, TextureOf colours, TexturePacker& textures) {
    const Clearcoat c = m.clearcoat.value_or(Clearcoat{});
    const Sheen s = m.sheen.value_or(Sheen{});
    const Anisotropy a = m.anisotropy.value_or(Anisotropy{});
    const Iridescence i = m.iridescence.value_or(Iridescence{});
    const DiffuseTransmission d = m.diffuse_transmission.value_or(DiffuseTransmission{});
    dev::MaterialExtensions e{};
    e.clearcoat = {c.factor,
                   c.roughness,
                   c.normal_scale,
                   textures.use(c.texture),
                   textures.use(c.roughness_texture),
                   textures.use(c.normal_texture)};
    e.sheen = {{s.colour.x, s.colour.y, s.colour.z},
               s.roughness,
               textures.use(s.colour_texture, colours),
               textures.use(s.roughness_texture)};
    e.anisotropy = {a.strength, {std::cos(a.rotation), std::sin(a.rotation)}, textures.use(a.texture)};
    e.iridescence = {i.factor,
                     i.ior,
                     i.thickness_minimum,
                     i.thickness_maximum,
                     textures.use(i.texture),
                     textures.use(i.thickness_texture)};
    e.diffuse_transmission = {d.factor,
                              {d.colour.x, d.colour.y, d.colour.z},
                              textures.use(d.texture),
                              textures.use(d.colour_texture, colours)};
    return e;
}

}  // namespace

bool has_levels(const PackedSurfaces& surfaces) {
    return std::any_of(surfaces.textures.begin(), surfaces.textures.end(),
                       [](const dev::Texture& t) { return t.levels > 0; });
}

void pack_materials(const Scene& scene, const RenderSettings& settings, PackedSurfaces& surfaces) {
    TexturePacker textures(scene, surfaces, settings.texture_levels);
    for (const Material& m : scene.materials) {
        const TextureOf colours =
            settings.texture_levels && may_have_levels(m) ? TextureOf::averaged_colours : TextureOf::colours;
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
        d.base_colour_use = textures.use(m.base_colour_texture, colours);
        d.metallic_roughness_use = textures.use(m.metallic_roughness_texture);
        d.normal_use = textures.use(m.normal_texture);
        d.emission_use = textures.use(m.emission_texture, colours);
        d.specular_use = textures.use(m.specular_texture);
        d.specular_colour_use = textures.use(m.specular_colour_texture, colours);
        d.transmission_use = textures.use(m.transmission_texture);
        d.dispersion = TRIAD_NONE;
        d.priority = m.priority;
        d.extensions = TRIAD_NONE;
        if (m.clearcoat || m.sheen || m.anisotropy || m.iridescence || m.diffuse_transmission) {
            d.extensions = std::uint32_t(surfaces.extensions.size());
            surfaces.extensions.push_back(extensions_of(m, colours, textures));
        }
        surfaces.materials.push_back(d);
    }
}

}  // namespace triad
