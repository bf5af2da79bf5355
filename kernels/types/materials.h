/* Textures, materials, and the tables that shading looks up. Part of types.h. */
#ifndef TRIAD_TYPES_MATERIALS_H
#define TRIAD_TYPES_MATERIALS_H

#include "types/border.h"

TRIAD_TYPES_BEGIN

/* ---- Textures and materials ---- */

#define TEXTURE_RGBA8 0u      /* one uint per texel, R in the low byte */
#define TEXTURE_RGBA8_SRGB 1u /* the same, RGB decoded with the sRGB curve */
#define TEXTURE_RGBA16 2u     /* two uints per texel, unsigned normalised */

#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u

/* One image with one sampler. Row 0 is the top row, (u, v) = (0, 0) its upper left corner, as in glTF. The
 * `levels` textures after it are the same picture, each with half as many texels along its longer side: means
 * of what they cover, down to a single one. */
typedef struct Texture {
    uint width, height;
    uint first_texel; /* index into the texel array, in uints */
    uint format;
    uint wrap_u, wrap_v;
    uint linear; /* 1 bilinear, 0 nearest */
    uint levels; /* 0: none */
} Texture;
TRIAD_SIZE(Texture, 32);

/* A use of a texture: which UV set, and KHR_texture_transform as u' = m[0] u + m[1] v + m[2], v' = m[3] u +
 * ... */
typedef struct TextureUse {
    uint texture;
    uint uv_set;
    float m[6];
} TextureUse;
TRIAD_SIZE(TextureUse, 32);

#define MATERIAL_DOUBLE_SIDED 1u /* emits on both sides */
#define MATERIAL_ALPHA_MASK 2u
#define MATERIAL_ALPHA_BLEND 4u
#define MATERIAL_SOLID                                                                               \
    8u /* KHR_materials_volume with thickness > 0: a closed body that absorbs, and refracts where it \
          transmits */
#define MATERIAL_UNLIT 16u

/* Below this roughness squared a surface is a mirror: float directions cannot resolve it. */
#define BSDF_SMOOTH_ALPHA 1e-3f
/* A body whose index differs from 1 by less is taken as smooth: its roughness would blur what is behind by
 * less than alpha / 100, and half vectors lose their meaning. */
#define BSDF_SAME_INDEX 1e-2f

/* glTF metallic-roughness with KHR ior, specular, transmission, volume, emissive_strength, unlit.
 * The *_use members index the TextureUse array or are TRIAD_NONE. Factors multiply textures, as the
 * extensions say. */
typedef struct Material {
    float base_colour[4];
    float emission[3]; /* radiance, strength included */
    float alpha_cutoff;
    float metallic;
    float roughness;
    float ior; /* 0: Fresnel is 1 everywhere (KHR_materials_ior) */
    float normal_scale;
    float specular_colour[3];
    float specular;
    float absorption[3]; /* sigma_a of the body, per scene unit of the instance's world scale */
    float transmission;
    uint flags;
    uint base_colour_use;
    uint metallic_roughness_use;
    uint normal_use;
    uint emission_use;
    uint specular_use;
    uint specular_colour_use;
    uint transmission_use;
    uint dispersion; /* of a solid body: its table of indices, or TRIAD_NONE */
    uint priority;   /* of a solid body among others that overlap it */
    uint extensions; /* index of its MaterialExtensions, or TRIAD_NONE */
    uint unused;
} Material;
TRIAD_SIZE(Material, 128);

/* What some materials have besides: a block for each extension, which is read only where its option of
 * features.h is on. A block with a factor (strength, colour) of 0 does nothing. *_use as in Material. */

/* KHR_materials_clearcoat: a varnish of index 1.5 over everything else. */
typedef struct ClearcoatBlock {
    float factor, roughness, normal_scale;
    uint factor_use, roughness_use, normal_use; /* R; G */
} ClearcoatBlock;
TRIAD_SIZE(ClearcoatBlock, 24);

/* KHR_materials_sheen. */
typedef struct SheenBlock {
    float colour[3], roughness;
    uint colour_use, roughness_use; /* sRGB; A */
} SheenBlock;
TRIAD_SIZE(SheenBlock, 24);

/* KHR_materials_anisotropy: direction is (cos, sin) of the rotation, from the tangent towards the bitangent.
 */
typedef struct AnisotropyBlock {
    float strength, direction[2];
    uint use; /* RG: direction as [-1, 1]; B: strength */
} AnisotropyBlock;
TRIAD_SIZE(AnisotropyBlock, 16);

/* KHR_materials_iridescence: a thin film over the base, thicknesses in nm. */
typedef struct IridescenceBlock {
    float factor, ior, thickness_minimum, thickness_maximum;
    uint factor_use, thickness_use; /* R; G: from minimum to maximum (none: the maximum) */
} IridescenceBlock;
TRIAD_SIZE(IridescenceBlock, 24);

/* KHR_materials_diffuse_transmission: share of the Lambert base that leaves on the other side. */
typedef struct DiffuseTransmissionBlock {
    float factor, colour[3];
    uint factor_use, colour_use; /* A; sRGB */
} DiffuseTransmissionBlock;
TRIAD_SIZE(DiffuseTransmissionBlock, 24);

typedef struct MaterialExtensions {
    ClearcoatBlock clearcoat;
    SheenBlock sheen;
    AnisotropyBlock anisotropy;
    IridescenceBlock iridescence;
    DiffuseTransmissionBlock diffuse_transmission;
    uint unused[4];
} MaterialExtensions;
TRIAD_SIZE(MaterialExtensions, 128);

/* Directional-albedo tables, one float array (host/pack/albedo_tables.h, kernels/shading/albedo.h). What is
 * masked changes where sqrt(mu) is about the roughness r, and most where both are small: columns are even in
 *   v = s (1 + r) / (s + r),  s = sqrt(mu),
 * which is 0 along the surface and 1 along the normal, and they depend on mu / alpha alone where both are
 * small. Two values per node: E with Fresnel factor 1, and B / E - (1 - mu)^5, where B is the same with
 * (1 - cos)^5. First GGX reflection: [r][v]. Then rough dielectric bodies: [outside, inside][index][row]
 * [column], values of albedo_glass. Nodes of the index are at even logarithms of n - 1 from
 * ALBEDO_GLASS_LEAST to ALBEDO_GLASS_MOST, and linear in n between. Rows are even in y, r = y (y + 1) / 2.
 * What leaves a body near its surface depends on how far it is refracted, too: columns are even in
 *   log(1 + mu / b) / log(1 + 1 / b),  1 / b = (1 / alpha + 1 / (n - 1)) / ALBEDO_GLASS_SCALE.
 * Then stretched GGX reflection: [r][strength][v of x][v of y] with s = sqrt(z / hypot(x, z)) and r the root
 * of alpha_x, and the same for y; the second value less that of GGX with the alpha along wo.
 * Then the white sheen lobe: [sqrt of the roughness from SHEEN_MIN_ROUGHNESS to 1][mu^(1/4) from
 * SHEEN_MIN_COSINE's to 1]. */
#define ALBEDO_SIZE 48
#define ALBEDO_GLASS_INDICES 32
#define ALBEDO_GLASS_ROUGHNESSES 32
#define ALBEDO_GLASS_COLUMNS 40
#define ALBEDO_GLASS_LEAST 0.01f
#define ALBEDO_GLASS_MOST 3.0f
#define ALBEDO_GLASS_SCALE 0.1f
#define ALBEDO_GLASS_SIDE (ALBEDO_GLASS_INDICES * ALBEDO_GLASS_ROUGHNESSES * ALBEDO_GLASS_COLUMNS * 2)
#define ALBEDO_GLASS_FIRST (ALBEDO_SIZE * ALBEDO_SIZE * 2)
#define ALBEDO_STRETCHED_FIRST (ALBEDO_GLASS_FIRST + 2 * ALBEDO_GLASS_SIDE)
#define ALBEDO_STRETCHED_ROUGHNESSES 16
#define ALBEDO_STRETCHED_STRENGTHS 16
#define ALBEDO_STRETCHED_SIZE 15
#define ALBEDO_SHEEN_FIRST                                                                \
    (ALBEDO_STRETCHED_FIRST + ALBEDO_STRETCHED_ROUGHNESSES * ALBEDO_STRETCHED_STRENGTHS * \
                                  ALBEDO_STRETCHED_SIZE * ALBEDO_STRETCHED_SIZE * 2)
#define ALBEDO_SHEEN_SIZE 32
#define ALBEDO_FLOATS (ALBEDO_SHEEN_FIRST + ALBEDO_SHEEN_SIZE * ALBEDO_SHEEN_SIZE)
/* Below it fibres would be flat. */
#define SHEEN_MIN_ROUGHNESS 0.07f
/* Of the table; closer to the horizon the lobe stays as it is here. */
#define SHEEN_MIN_COSINE 1e-3f
#define SHEEN_MIN_COSINE_ROOT 0.17782794f /* its fourth root */

/* Thin films (kernels/shading/thin_film.h): how many reflections within the film are told apart, and the
 * table of mean cosines: rows of FILM_STEP nm of optical path difference, three channels each. */
#define FILM_ORDERS 10
#define FILM_ROWS 2049
#define FILM_STEP 5.0f

TRIAD_TYPES_END

#endif
