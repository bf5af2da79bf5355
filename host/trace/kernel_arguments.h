#pragma once
/// The arguments of kernels, as kernels/arguments.h lists them: set by name, and of the types that kernels
/// take.
#include "device/device.h"
#include "kernels/arguments.h"
#include "kernels/types.h"

namespace triad {
namespace dev {

static_assert(sizeof(long) == 8, "the kernels' long");

#define TRIAD_ARRAY(type, name) DeviceArray<type> name;
#define TRIAD_VALUE(type, name) type name;

/// An array that is not needed may be empty.
struct SceneArguments {
    SCENE_LIST(TRIAD_ARRAY, TRIAD_ARRAY)
};
struct TracePathsArguments {
    TRACE_PATHS_LIST(TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_VALUE)
};
struct RecordPathsArguments {
    RECORD_PATHS_LIST(TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_VALUE)
};
struct TraceFeaturesArguments {
    TRACE_FEATURES_LIST(TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_VALUE)
};
struct TracePhotonsArguments {
    TRACE_PHOTONS_LIST(TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_VALUE)
};

#undef TRIAD_ARRAY
#undef TRIAD_VALUE

}  // namespace dev

/// In the order in which kernels take them.
#define TRIAD_ADD(type, name) .add(a.name)
inline Arguments arguments_of(const dev::SceneArguments& a) {
    return Arguments() SCENE_LIST(TRIAD_ADD, TRIAD_ADD);
}
inline Arguments arguments_of(const dev::TracePathsArguments& a) {
    return Arguments() TRACE_PATHS_LIST(TRIAD_ADD, TRIAD_ADD, TRIAD_ADD, TRIAD_ADD);
}
inline Arguments arguments_of(const dev::RecordPathsArguments& a) {
    return Arguments() RECORD_PATHS_LIST(TRIAD_ADD, TRIAD_ADD, TRIAD_ADD, TRIAD_ADD);
}
inline Arguments arguments_of(const dev::TraceFeaturesArguments& a) {
    return Arguments() TRACE_FEATURES_LIST(TRIAD_ADD, TRIAD_ADD, TRIAD_ADD, TRIAD_ADD);
}
inline Arguments arguments_of(const dev::TracePhotonsArguments& a) {
    return Arguments() TRACE_PHOTONS_LIST(TRIAD_ADD, TRIAD_ADD, TRIAD_ADD, TRIAD_ADD);
}
#undef TRIAD_ADD

}  // namespace triad
