/* From the film's bins to display-linear pixels: exposure, tone map, box over the bins of a pixel. */
#include "common/language.h"
#include "subpixel/tone_map.h"

/* One work-item per pixel. sums: [pixel][bin][R, G, B, alpha] in units of `quantum`; samples: per pixel, over
 * all bins; display: [pixel][R, G, B, alpha], colour associated. per_bin 1: the tone map sees each bin, 0:
 * the mean of the pixel. */
__kernel void resolve_bins(__global const long* sums, __global const uint* samples, __global float* display,
                           uint pixels, uint bins, float quantum, float exposure, uint which, uint per_bin) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel >= pixels) return;
    /* Samples are spread evenly over the bins: a bin has samples / bins of them. */
    const float count = convert_float(samples[pixel]);
    const float bin_unit = count > 0.0f ? quantum * convert_float(bins) / count : 0.0f;
    float4 total = (float4)(0.0f);
    for (uint bin = 0; bin < bins; ++bin) {
        float4 value = convert_float4(vload4((size_t)pixel * bins + bin, sums)) * bin_unit;
        value.xyz *= exposure;
        total += per_bin ? tone_map_associated(which, value) : value;
    }
    total *= 1.0f / convert_float(bins);
    if (!per_bin) total = tone_map_associated(which, total);
    vstore4(total, pixel, display);
}
