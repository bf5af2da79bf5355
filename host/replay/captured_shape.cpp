#include "replay/captured_shape.h"

namespace triad {

BvhFormat captured_format(const Recording& work) {
    for (const Recording::Source& source : work.sources)
        if (const auto format = source.options.find("TRIAD_BVH4"); format != source.options.end())
            return format->second == "1" ? BvhFormat::bvh4 : BvhFormat::bvh8;
    return BvhFormat::bvh8;
}

PathDriverKind captured_driver(const Recording& work) {
    for (const Recording::Source& source : work.sources) {
        if (source.path.starts_with("path/wave_stages")) return PathDriverKind::wave_stages;
        if (source.path.starts_with("path/wave")) return PathDriverKind::wave;
    }
    return PathDriverKind::mega;
}

}  // namespace triad
