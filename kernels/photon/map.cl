/* The hash grid of a photon map: photons are counted by bucket, the counts summed up, and the photons copied
 * to their places (counting sort), in launches whose items count from `first` on. Their order within a bucket
 * is left to chance: sums over them do not depend on it. */
#include "common/language.h"

#include "shading/photon_map.h"

TRIAD_FUNCTION uint map_bucket(const PhotonMap* map, global const Photon* photon) {
    return photon_bucket(map, photon_cell(map, VEC3_OF(photon->position)));
}

/* counts: of the buckets, zero before. */
kernel void count_photons(global const PhotonMap* map, global const Photon* landed, uint photons,
                          volatile global uint* counts, uint first) {
    const size_t item = first + get_global_id(0);
    const PhotonMap m = *map;
    if (item < photons && landed[item].direction != 0u) atomic_inc(counts + map_bucket(&m, landed + item));
}

/* What each chunk of counts adds up to. */
kernel void sum_chunks(global const uint* counts, uint chunks, global uint* sums, uint first) {
    const size_t item = first + get_global_id(0);
    if (item >= chunks) return;
    uint sum = 0u;
    for (uint i = 0u; i < MAP_CHUNK; ++i) sum += counts[item * MAP_CHUNK + i];
    sums[item] = sum;
}

/* From sums to the sum of all before. One item. */
kernel void scan_chunks(global const uint* counts, uint chunks, global uint* sums) {
    (void)counts;
    if (get_global_id(0) != 0) return;
    uint before = 0u;
    for (uint i = 0u; i < chunks; ++i) {
        const uint sum = sums[i];
        sums[i] = before;
        before += sum;
    }
}

/* From counts to where the buckets begin. */
kernel void scan_buckets(global uint* counts, uint chunks, global const uint* sums, uint first) {
    const size_t item = first + get_global_id(0);
    if (item >= chunks) return;
    uint before = sums[item];
    for (uint i = 0u; i < MAP_CHUNK; ++i) {
        const uint count = counts[item * MAP_CHUNK + i];
        counts[item * MAP_CHUNK + i] = before;
        before += count;
    }
}

/* Copies the photons to their buckets, and turns where these begin into where they end. */
kernel void sort_photons(global const PhotonMap* map, global const Photon* landed, uint photons,
                         volatile global uint* ends, global Photon* sorted, uint first) {
    const size_t item = first + get_global_id(0);
    const PhotonMap m = *map;
    if (item < photons && landed[item].direction != 0u)
        sorted[atomic_inc(ends + map_bucket(&m, landed + item))] = landed[item];
}
