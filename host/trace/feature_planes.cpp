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
    Buffer planes[4];
    for (int i = 0; i < 4; ++i) planes[i] = device.allocate(pixels * (i == 3 ? 1 : 3) * sizeof(float));
    Arguments arguments = tracer.arguments();
    for (const Buffer& b : planes) arguments.add(b);
    const std::size_t items = tile_count(frame.crop[2], frame.crop[3]) * FILM_TILE_PIXELS;
    const std::size_t chunk =
        std::clamp<std::size_t>((std::size_t(1) << 20) / samples / FILM_TILE_PIXELS, 1, largest_launch) *
        FILM_TILE_PIXELS;
    for (std::size_t pixel = 0; pixel < items; pixel += chunk) {
        const std::size_t count = std::min(chunk, items - pixel);
        device.run(trace_features,
                   Arguments()
                       .add(arguments)
                       .add(std::uint32_t(pixel))
                       .add(std::uint32_t(count))
                       .add(std::uint32_t(samples)),
                   count);
        device.finish();
    }
    FeaturePlanes out{device.download<float>(planes[0]), device.download<float>(planes[1]),
                      device.download<float>(planes[2]), device.download<float>(planes[3])};
    const dvec3& origin = tracer.scene().packed().origin;
    for (std::size_t i = 0; i < pixels * 3; ++i)
        out.position[i] = static_cast<float>(out.position[i] + origin[static_cast<int>(i % 3)]);
    return out;
}

}  // namespace triad
