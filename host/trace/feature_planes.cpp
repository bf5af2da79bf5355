#include "trace/feature_planes.h"

#include <algorithm>

#include "scene/film_sets.h"

namespace triad {

FeaturePlanes feature_planes(Tracer& tracer, unsigned samples) {
    Device& device = tracer.device();
    const Kernel trace_features =
        device.build("path/features.cl", options_of(tracer.features())).kernel("trace_features");
    const dev::Frame& frame = tracer.frame();
    const std::size_t pixels = std::size_t(frame.crop[2]) * frame.crop[3];
    dev::TraceFeaturesArguments own{.albedos = device.allocate_array<float>(pixels * 3),
                                    .normal_means = device.allocate_array<float>(pixels * 3),
                                    .position_means = device.allocate_array<float>(pixels * 3),
                                    .depths = device.allocate_array<float>(pixels),
                                    .first_pixel = 0,
                                    .pixel_count = 0,
                                    .sample_count = samples};
    const std::size_t items = tile_count(frame.crop[2], frame.crop[3]) * FILM_TILE_PIXELS;
    const std::size_t chunk = std::clamp<std::size_t>((std::size_t(1) << 20) / samples / FILM_TILE_PIXELS, 1,
                                                      largest_launch_items / FILM_TILE_PIXELS) *
                              FILM_TILE_PIXELS;
    for (std::size_t pixel = 0; pixel < items; pixel += chunk) {
        own.first_pixel = std::uint32_t(pixel);
        own.pixel_count = std::uint32_t(std::min(chunk, items - pixel));
        device.run(trace_features, Arguments(tracer.arguments()).add(arguments_of(own)), own.pixel_count);
        device.finish();
    }
    FeaturePlanes out{device.download<float>(own.albedos), device.download<float>(own.normal_means),
                      device.download<float>(own.position_means), device.download<float>(own.depths)};
    const dvec3& origin = tracer.scene().packed().origin;
    for (std::size_t i = 0; i < pixels * 3; ++i)
        out.position[i] = static_cast<float>(out.position[i] + origin[static_cast<int>(i % 3)]);
    return out;
}

}  // namespace triad
