/* THE list of what kernels take: the parameters of kernels and the host's structs of arguments are both made
 * of these lists, in this order.
 *
 *   FIRST(type, name)   an array that kernels read; it begins the scene, so no comma comes before it
 *   ARRAY(type, name)   another
 *   OWNED(type, name)   an array whose elements have one work-item each that writes them
 *   SHARED(type, name)  an array that any work-item adds to
 *   VALUE(type, name)   one number
 */
#ifndef TRIAD_ARGUMENTS_H
#define TRIAD_ARGUMENTS_H

/* The scene: what every kernel that shades begins with. */
#define SCENE_LIST(FIRST, ARRAY)                                                                             \
    FIRST(Frame, frame) /* one: everything of the picture that is no array */                                \
    ARRAY(BvhNode, nodes)                                                                                    \
    ARRAY(TriangleBlock, blocks)                                                                             \
    ARRAY(Instance, instances)                                                                               \
    ARRAY(Triangle, triangles)                                                                               \
    ARRAY(Geometry, geometries)                                                                              \
    ARRAY(float, normals)  /* [3] for each vertex that has one */                                            \
    ARRAY(float, tangents) /* [4] */                                                                         \
    ARRAY(float, uvs)      /* [2] */                                                                         \
    ARRAY(float, colours)  /* [4] */                                                                         \
    ARRAY(Material, materials)                                                                               \
    ARRAY(MaterialExtensions, extensions) /* of the materials that have any */                               \
    ARRAY(TextureUse, texture_uses)                                                                          \
    ARRAY(Texture, textures)                                                                                 \
    ARRAY(uint, texels)                                                                                      \
    ARRAY(float, srgb)           /* decoded value of every byte of an sRGB texel */                          \
    ARRAY(float, albedo)         /* directional-albedo tables of shading/bsdf.h */                           \
    ARRAY(float, film_responses) /* of thin films; FILM_ROWS [3], where there are any */                     \
    ARRAY(Light, lights)                                                                                     \
    ARRAY(uint, light_cdf) /* tree of shape frame->lights */                                                 \
    ARRAY(LightNode, light_nodes)                                                                            \
    ARRAY(uint,                                                                                              \
          light_trails)     /* of Lights: which child the way from the root takes, bits 3 k up at depth k */ \
    ARRAY(uint, env_texels) /* ENVIRONMENT_RGBE or ENVIRONMENT_FLOAT */                                      \
    ARRAY(uint, env_rows)   /* tree of shape environment.rows */                                             \
    ARRAY(ushort, env_columns) /* trees of shape environment.columns; FACINGS x FACINGS tables of shares */  \
    ARRAY(float, env_cosines)  /* height + 1: of the polar angle of the rows' borders */                     \
    ARRAY(Spectrum, spectrum)                                                                                \
    ARRAY(float, indices)    /* tables of (n, its change to the next row), SPECTRUM_ROWS */                  \
    ARRAY(float, ray_filter) /* tables of shape frame->ray_filter */                                         \
    ARRAY(PhotonMap, photon_map)                                                                             \
    ARRAY(Photon, photons)   /* bucket by bucket */                                                          \
    ARRAY(uint, photon_ends) /* of the buckets */

/* path/mega.cl, after the scene: the film, of which sums and half_sums hold the pixels from first_pixel on,
 * and the work: tiles work[first_work, first_work + work_count), whose samples count from first_sample. */
#define TRACE_PATHS_LIST(ARRAY, OWNED, SHARED, VALUE) \
    OWNED(long, sums)                                 \
    OWNED(long, half_sums)                            \
    OWNED(uint, samples)                              \
    SHARED(uint, counters)                            \
    ARRAY(TileWork, work)                             \
    VALUE(uint, first_work)                           \
    VALUE(uint, work_count)                           \
    VALUE(uint, first_sample_low)                     \
    VALUE(uint, first_sample_high)                    \
    VALUE(uint, first_pixel)

/* path/wave.cl and wave_stages.cl: what trace_paths takes, and pool_count pools of paths
 * (path/wave_stages.h), each with a part of every array. */
#define TRACE_WAVE_LIST(ARRAY, OWNED, SHARED, VALUE)                                              \
    TRACE_PATHS_LIST(ARRAY, OWNED, SHARED, VALUE)                                                 \
    OWNED(uint, states)      /* a plane of WAVE_* */                                              \
    OWNED(uint, pixels)      /* a plane: of a slot, counted over the tiles of the work */         \
    OWNED(uint, taken)       /* a plane: samples that this pixel has had */                       \
    OWNED(uint, rays)        /* a plane, of wave_stages.cl: traced for a slot, not yet counted */ \
    OWNED(uint, paths)       /* POOL_PATH_PLANES */                                               \
    OWNED(uint, hits)        /* POOL_HIT_PLANES */                                                \
    OWNED(uint, pending)     /* POOL_LIGHT_PLANES */                                              \
    OWNED(float, films)      /* POOL_FILM_WORDS for each slot, of wave_stages.cl */               \
    SHARED(uint, next_pixel) /* of the work: slots take one after the other; idle slots */        \
    VALUE(uint, pool_count)

/* path/record.cl: samples [first_sample, first_sample + sample_count) of the pixel (x, y) of the crop. */
#define RECORD_PATHS_LIST(ARRAY, OWNED, SHARED, VALUE)       \
    OWNED(PathRecord, records)                               \
    OWNED(PathVertex, vertices) /* PATH_VERTICES for each */ \
    VALUE(uint, x)                                           \
    VALUE(uint, y)                                           \
    VALUE(uint, first_sample_low)                            \
    VALUE(uint, first_sample_high)                           \
    VALUE(uint, sample_count)

/* path/count.cl: samples [0, sample_count) of the pixels [first_pixel, first_pixel + pixel_count) of the
 * crop, row by row. */
#define COUNT_WORK_LIST(ARRAY, OWNED, SHARED, VALUE) \
    OWNED(PixelWork, work)                           \
    OWNED(EdgeWork, edges) /* [WORK_EDGES] */        \
    VALUE(uint, first_pixel)                         \
    VALUE(uint, pixel_count)                         \
    VALUE(uint, sample_count)

/* path/features.cl: planes of the pixels [first_pixel, first_pixel + pixel_count), in the order of tiles,
 * from samples [0, sample_count). */
#define TRACE_FEATURES_LIST(ARRAY, OWNED, SHARED, VALUE) \
    OWNED(float, albedos)        /* [3] */               \
    OWNED(float, normal_means)   /* [3], world */        \
    OWNED(float, position_means) /* [3], rebased */      \
    OWNED(float, depths)         /* along the view */    \
    VALUE(uint, first_pixel)                             \
    VALUE(uint, pixel_count)                             \
    VALUE(uint, sample_count)

/* path/photons.cl: photons [first_photon, first_photon + photon_count) of a sample of the picture. */
#define TRACE_PHOTONS_LIST(ARRAY, OWNED, SHARED, VALUE)                                                     \
    SHARED(uint, sums) /* of the film, as pairs */                                                          \
    SHARED(uint, half_sums)                                                                                 \
    SHARED(uint, counters)                                                                                  \
    ARRAY(PhotonFrame, photon_frame)                                                                        \
    ARRAY(uint, photon_lights) /* tree of shape photon_frame->lights */                                     \
    ARRAY(Caster, casters)                                                                                  \
    VALUE(uint, sample_low)                                                                                 \
    VALUE(uint, sample_high)                                                                                \
    VALUE(uint, first_photon)                                                                               \
    VALUE(uint, photon_count)                                                                               \
    VALUE(float, share)   /* 1 / the photons that are traced for the sample */                              \
    OWNED(Photon, landed) /* a place for each photon of the sample, or null; no edges: it landed nowhere */ \
    ARRAY(uint, tiles)    /* 1 for those that get the sample which the photons belong to */                 \
    VALUE(uint, first_pixel)                                                                                \
    VALUE(uint, pixels) /* of the piece of the film that begins with first_pixel */

#endif
