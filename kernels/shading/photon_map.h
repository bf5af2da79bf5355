/* The photon map (Jensen 1996, "Global Illumination using Photon Maps"): photons in the buckets of a hash
 * grid, gathered around a point with a shrinking radius (Knaus and Zwicker 2011, "Progressive Photon Mapping:
 * A Probabilistic Approach"). Sums are in fixed point: the order of the photons in a bucket, which no device
 * promises, changes no bit. */
#ifndef TRIAD_SHADING_PHOTON_MAP_H
#define TRIAD_SHADING_PHOTON_MAP_H

#include "common/film.h"
#include "shading/vertex_bsdf.h"

/* Photons whose surface is turned further from the point's than this do not lie on it: cosine. */
#define PHOTON_SAME_SURFACE 0.9f
/* Nor do those that lie higher above it than this, in radii. */
#define PHOTON_SAME_HEIGHT 0.25f
/* Wavelengths are kept in 16 bits; 0 stands for all of them together. */
#define PHOTON_WAVELENGTH_STEP ((SPECTRUM_ROWS - 1) * SPECTRUM_STEP / 65534.0f)

/* A unit vector in 2 * `bits` bits: octahedral (Cigolle et al. 2014, "A Survey of Efficient Representations
 * for Independent Unit Vectors"). */
TRIAD_FUNCTION uint photon_pack_direction(Vec3 d, uint bits) {
    const float scale = 1.0f / (fabs(d.x) + fabs(d.y) + fabs(d.z));
    float x = d.x * scale, y = d.y * scale;
    if (d.z < 0.0f) {
        const float folded = copysign(1.0f - fabs(y), x);
        y = copysign(1.0f - fabs(x), y);
        x = folded;
    }
    const float most = (float)((1u << bits) - 1u);
    return (uint)fma(fma(x, 0.5f, 0.5f), most, 0.5f) | (uint)fma(fma(y, 0.5f, 0.5f), most, 0.5f) << bits;
}
TRIAD_FUNCTION Vec3 photon_unpack_direction(uint packed, uint bits) {
    const uint most = (1u << bits) - 1u;
    const float scale = 2.0f / (float)most;
    float x = fma((float)(packed & most), scale, -1.0f),
          y = fma((float)((packed >> bits) & most), scale, -1.0f);
    const float z = 1.0f - fabs(x) - fabs(y);
    if (z < 0.0f) {
        const float unfolded = copysign(1.0f - fabs(y), x);
        y = copysign(1.0f - fabs(x), y);
        x = unfolded;
    }
    return vec3_normalize(vec3_make(x, y, z));
}

/* Edges of a photon's way, as they are kept: more are as many. */
#define PHOTON_EDGES 127u
#define PHOTON_BY_MIRRORS_AND_GLASS 128u

/* from: the direction that it came from; normal: of the surface, on that side; edges of its way; caustic: by
 * mirrors and glass alone, at least one; wavelength in nm or 0. */
TRIAD_FUNCTION Photon photon_make(Vec3 position, Vec3 power, Vec3 from, Vec3 normal, uint edges, int caustic,
                                  float wavelength) {
    Photon p;
    p.position[0] = position.x, p.position[1] = position.y, p.position[2] = position.z;
    p.power[0] = power.x, p.power[1] = power.y, p.power[2] = power.z;
    p.direction = photon_pack_direction(from, 12u) << 8 | (caustic ? PHOTON_BY_MIRRORS_AND_GLASS : 0u) |
                  math_min_uint(edges, PHOTON_EDGES);
    p.normal = photon_pack_direction(normal, 8u) << 16;
    if (wavelength > 0.0f)
        p.normal |= (uint)(fma(
            math_clamp(wavelength - SPECTRUM_FIRST, 0.0f, (float)(SPECTRUM_ROWS - 1) * SPECTRUM_STEP),
            1.0f / PHOTON_WAVELENGTH_STEP, 1.5f));
    return p;
}
TRIAD_FUNCTION Vec3 photon_from(const Photon* p) { return photon_unpack_direction(p->direction >> 8, 12u); }
TRIAD_FUNCTION Vec3 photon_normal(const Photon* p) { return photon_unpack_direction(p->normal >> 16, 8u); }
TRIAD_FUNCTION uint photon_edges(const Photon* p) { return p->direction & PHOTON_EDGES; }
TRIAD_FUNCTION int photon_is_caustic(const Photon* p) {
    return (p->direction & PHOTON_BY_MIRRORS_AND_GLASS) != 0u;
}
TRIAD_FUNCTION float photon_wavelength(const Photon* p) {
    const uint step = p->normal & 0xffffu;
    return step == 0u ? 0.0f : fma((float)(step - 1u), PHOTON_WAVELENGTH_STEP, SPECTRUM_FIRST);
}

/* ---- The grid ---- */

/* Within +-2^30, whatever x is: loops over cells can count beyond. */
TRIAD_FUNCTION int photon_cell_along(float x) {
    return math_clamp_int(convert_int_sat(floor(x)), -0x40000000, 0x40000000);
}
TRIAD_FUNCTION IVec3 photon_cell(const PhotonMap* map, Vec3 p) {
    const Vec3 cell = vec3_scale(p, map->cells_per_unit);
    return ivec3_make(photon_cell_along(cell.x), photon_cell_along(cell.y), photon_cell_along(cell.z));
}
/* The bucket of a cell. The eight cells of any 2 x 2 x 2 block have eight buckets: the low bits tell them
 * apart, and none is searched twice. The hash is Teschner et al.'s (2003). */
TRIAD_FUNCTION uint photon_bucket(const PhotonMap* map, IVec3 cell) {
    const uint hash =
        (uint)(cell.x >> 1) * 73856093u ^ (uint)(cell.y >> 1) * 19349663u ^ (uint)(cell.z >> 1) * 83492791u;
    const uint within = ((uint)cell.z & 1u) << 2 | ((uint)cell.y & 1u) << 1 | ((uint)cell.x & 1u);
    return (hash << 3 | within) & map->bucket_mask;
}

/* ---- What paths find in it: photons carry RGB or one wavelength, as they do ---- */

#define PATH_GATHERS (TRIAD_GATHER && !TRIAD_HERO)
#if PATH_GATHERS

/* Which photons are gathered. */
#define PHOTON_ANY 0u
#define PHOTON_CAUSTIC 1u
#define PHOTON_INDIRECT 2u /* that were reflected or refracted at all */

typedef struct PhotonQuery {
    Vec3 position, normal; /* of the surface, on the side of the path */
    uint most_edges;       /* of a photon's way; 0: no limit */
    uint which;
    float radius;     /* at most the map's */
    float wavelength; /* of the path, in nm; 0: all together */
} PhotonQuery;

/* What a photon adds to the radiance towards the path, in units of the film; its share of the kernel is
 * Epanechnikov's. */
TRIAD_FUNCTION void photon_add(const Scene* scene, const PhotonMap* map, const PhotonQuery* query,
                               const VertexBsdf* v, global const Photon* stored, long* sums) {
    const Vec3 off = vec3_sub(VEC3_OF(stored->position), query->position);
    const float distance2 = vec3_dot(off, off) * (1.0f / (query->radius * query->radius));
    if (!(distance2 < 1.0f)) return;
    const Photon photon = *stored;
    const Vec3 normal = photon_normal(&photon);
    if (!(fabs(vec3_dot(normal, query->normal)) > PHOTON_SAME_SURFACE &&
          fabs(vec3_dot(off, query->normal)) < PHOTON_SAME_HEIGHT * query->radius))
        return;
    if (query->which != PHOTON_ANY &&
        !(query->which == PHOTON_CAUSTIC ? photon_is_caustic(&photon) : photon_edges(&photon) > 1u))
        return;
    if (query->most_edges != 0u && photon_edges(&photon) > query->most_edges) return;
#if TRIAD_DISPERSION
    const float wavelength = photon_wavelength(&photon);
    const int narrow = wavelength > 0.0f && query->wavelength > 0.0f;
    if (narrow && !(fabs(wavelength - query->wavelength) < map->wavelengths)) return;
#endif
    const Vec3 wi = frame_to_local(&v->frame, photon_from(&photon));
    const float lit = vec3_dot(normal, query->normal) > 0.0f ? 1.0f : -1.0f;
    if (!(wi.z * lit > 0.0f)) return; /* light must not go through by the shading normal */
    float pdf;
    const Vec3 f = bsdf_eval(&v->bsdf, v->wo, wi, &pdf);
    Vec3 power = vec3_scale(VEC3_OF(stored->power),
                            fma(-2.0f, distance2, 2.0f) / (MATH_PI * math_square(query->radius)));
#if TRIAD_DISPERSION
    if (narrow)
        power = vec3_scale(power, 0.5f / map->wavelengths);
    else if (wavelength > 0.0f)
        power = vec3_mul(power, spectrum_filter(scene->spectrum, wavelength));
#endif
    const Vec3 value = vec3_mul(f, power);
    if (!film_is_finite(vec3_with(value, 0.0f))) return;
    uint saturated = 0u;
    sums[0] = add_sat(sums[0], film_fixed(value.x, scene->frame->quanta, &saturated));
    sums[1] = add_sat(sums[1], film_fixed(value.y, scene->frame->quanta, &saturated));
    sums[2] = add_sat(sums[2], film_fixed(value.z, scene->frame->quanta, &saturated));
}

/* Radiance that the photons around a point send along the path. */
TRIAD_FUNCTION Vec3 photon_gather(const Scene* scene, const PhotonQuery* query, const VertexBsdf* v) {
    const PhotonMap map = *scene->photon_map;
    const Vec3 reach = vec3_splat(query->radius);
    /* two cells along each axis at most, where float no longer tells cells apart too */
    const IVec3 low = photon_cell(&map, vec3_sub(query->position, reach)),
                last = photon_cell(&map, vec3_add(query->position, reach));
    const uint along_x = last.x > low.x, along_y = last.y > low.y, along_z = last.z > low.z;
    const uint cells = along_z << 2 | along_y << 1 | along_x; /* a bit for each axis that has a second cell */
    long sums[3] = {0, 0, 0};
    for (uint cell = 0u; cell < 8u; ++cell) {
        if (cell & ~cells) continue;
        const uint bucket = photon_bucket(
            &map,
            ivec3_make(low.x + (int)(cell & 1u), low.y + (int)(cell >> 1 & 1u), low.z + (int)(cell >> 2)));
        const uint end = scene->photon_ends[bucket];
        for (uint i = bucket == 0u ? 0u : scene->photon_ends[bucket - 1u]; i < end; ++i)
            photon_add(scene, &map, query, v, scene->photons + i, sums);
    }
    return vec3_scale(vec3_make((float)sums[0], (float)sums[1], (float)sums[2]), 1.0f / scene->frame->quanta);
}

#endif
#endif
