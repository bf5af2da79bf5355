/* Photons. What the camera sees directly of what they bring is splatted to the film; where paths meet it
 * later, they gather it from a map (photon/map.cl, shading/photon_map.h). Paths themselves leave this light
 * out (path/emission.h). One work-item is one photon. Photons read textures as they are: what one brings is
 * seen by many samples. */
#undef TRIAD_TEXTURE_LEVELS
#define TRIAD_TEXTURE_LEVELS 0
#include "common/language.h"

#include "path/photon.h"

TRIAD_FUNCTION_WHOLE void trace_photon(SCENE_PARAMETERS PARAMETERS(TRACE_PHOTONS_LIST), size_t item) {
    if (item >= photon_count) return;
    const Scene scene = SCENE_FROM_PARAMETERS;
    /* the halves of the film take turns as in sample_name() */
    const uint bins = frame->bins[0] * frame->bins[1];
    const ulong sample = ((ulong)sample_high << 32) | sample_low, round = sample / bins;
    const uint half_index = (uint)(round & 1ul);
    const ulong index =
        ((round >> 1) * bins + sample % bins) * photon_frame->count + first_photon + (uint)item;
    const SplatFilm film = {sums, half_sums, tiles, first_pixel, pixels, half_index};
    Tally tally = tally_start();
    PhotonState photon = photon_start(&scene, photon_frame, photon_lights, casters, index, half_index);
    if (vec3_largest_abs(photon.source.power) > 0.0f)
        while (photon_edge(&scene, photon_frame, &film, share, &photon, &tally)) {
        }
#if TRIAD_GATHER
    if (frame->photon_map) {
        for (uint c = 0u; c < 3u; ++c) photon.kept.power[c] *= (float)photon.landings;
        landed[first_photon + item] = photon.kept;
    }
#else
    (void)landed;
#endif
    tally_add(counters, &tally);
}

/* Traces photons of a sample of the picture, for a piece of the film and for the map. */
kernel void trace_photons(SCENE_PARAMETERS PARAMETERS(TRACE_PHOTONS_LIST)) {
    trace_photon(SCENE_ARGUMENTS ARGUMENTS(TRACE_PHOTONS_LIST), get_global_id(0));
}
