// Textures: which level a mean is read from, and that means give way to the texels themselves.
#include <algorithm>

#include "base/colour.h"
#include "check/cases.h"
#include "check/picture.h"

namespace triad {
namespace {

using namespace picture_case;

constexpr std::uint8_t step = 25;  // between the values of two levels

/// An image of an odd size as a square's emission, which is scaled, turned and sheared. Every texel of a
/// level has the level's number, times `step`.
PackedScene numbered_levels() {
    Builder b;
    Material m = emitter(1.0f);
    m.emission_texture = TextureUse{.uv_set = 1, .transform = {1, -2, 0.3f, 3, 0.5f, 0}};
    b.scene.images.push_back({"numbers", 300, 201, 8, std::vector<std::uint8_t>(300 * 201 * 4)});
    b.scene.textures.push_back({});
    b.add(square(0, true), m);
    validate(b.scene);
    PackedScene packed = pack(b.scene, {});
    PackedSurfaces surfaces = *packed.surfaces;
    const dev::Texture& image = surfaces.textures.front();
    for (std::uint32_t level = 0; level <= image.levels; ++level) {
        const dev::Texture& t = surfaces.textures[level];
        std::fill_n(surfaces.texels.begin() + t.first_texel, t.width * t.height, level * step * 0x010101u);
    }
    packed.surfaces = std::make_shared<PackedSurfaces>(std::move(surfaces));
    return packed;
}

void means_come_from_their_level(Check& check) {
    // Items 0 to 63 ask for 2^(i/2 - 4 + 1/4) texels of the image, others for nothing or without end.
    const PackedScene packed = numbered_levels();
    const auto found = draw_lights(check, packed, R"(
    const Vec2 uv = random_point(u.set[0]);
    float asked = i < 64u ? exp2(0.5f * (float)i - 3.75f) : i == 64u ? INFINITY : i == 65u ? NAN : 0.0f;
    const float covered = asked / (300.0f * 201.0f * 6.5f); /* 6.5: determinant of the transform */
    w = texture_use_mean(&scene, 0u, uv, uv, vec2_make(NAN, covered), vec4_splat(1.0f));)",
                                   67);
    const auto last = packed.surfaces->textures.front().levels;
    for (std::uint32_t i = 0; i < 67; ++i) {
        const std::uint32_t level = i < 64 ? (i < 12 ? 0 : std::min((i - 12) / 4, last)) : i == 64 ? last : 0;
        check.near(found[i][0], srgb_decode(level * step / 255.0), 1e-6, "level of lookup ", i);
    }
}

void means_give_way_to_texels(Check& check) {
    // White up to column 120 of 256, black beyond; the third of four columns of pixels is black.
    constexpr unsigned size = 256, edge = 120, pixels = 4;
    Builder b;
    Material m = emitter(1.0f);
    m.emission_texture = TextureUse{};
    Image image{"half", size, size, 8, std::vector<std::uint8_t>(size * size * 4, 255)};
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        if (i / 4 % size >= edge) image.texels[i] = 0;
    b.scene.images.push_back(std::move(image));
    b.scene.textures.push_back({.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp});
    b.add(square(0, true), m);
    RenderSettings settings;
    settings.width = settings.height = pixels;
    settings.max_depth = 1;
    settings.view = orthographic({0, 0, 0}, {0, -1, 0}, 0.5, 1);
    const auto column = [&](SampleRange samples, unsigned x) {
        const Film film = render(check.device, b.scene, settings, {samples}, features_at(check.level));
        double sum = 0;
        for (unsigned y = 0; y < pixels; ++y) sum += pixel_mean(film, y * pixels + x)[1];
        return sum / pixels;
    };
    constexpr std::uint64_t late = 1 << 20;
    check.above(column({0, 1}, 2), 0.01, "what a first sample sees of a wide mean");
    check.near(column({late, late + 64}, 2), 0, 0, "late samples of black texels");
    check.near(column({late, late + 64}, 1), (edge - 64.0) / 64, 0.02, "late samples of the edge");
}

}  // namespace

void add_textures(std::vector<CheckCase>& cases) {
    cases.push_back({"I1", "levels of textures", CheckLevel::quick, means_come_from_their_level});
}

void add_texture_pictures(std::vector<CheckCase>& cases) {
    cases.push_back({"I2", "means that give way to texels", CheckLevel::standard, means_give_way_to_texels});
}

}  // namespace triad
