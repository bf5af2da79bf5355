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
#define TRIAD_ARGUMENTS(LIST) LIST(TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_ARRAY, TRIAD_VALUE)

/// An array that is not needed may be empty.
struct SceneArguments {
    SCENE_LIST(TRIAD_ARRAY, TRIAD_ARRAY)
};
// clang-format off
struct TracePathsArguments { TRIAD_ARGUMENTS(TRACE_PATHS_LIST) };
struct TraceWaveArguments { TRIAD_ARGUMENTS(TRACE_WAVE_LIST) };
struct RecordPathsArguments { TRIAD_ARGUMENTS(RECORD_PATHS_LIST) };
struct CountWorkArguments { TRIAD_ARGUMENTS(COUNT_WORK_LIST) };
struct TraceFeaturesArguments { TRIAD_ARGUMENTS(TRACE_FEATURES_LIST) };
struct TracePhotonsArguments { TRIAD_ARGUMENTS(TRACE_PHOTONS_LIST) };
// clang-format on

#undef TRIAD_ARGUMENTS
#undef TRIAD_ARRAY
#undef TRIAD_VALUE

}  // namespace dev

/// In the order in which kernels take them.
#define TRIAD_ADD(type, name) .add(a.name)
#define TRIAD_ARGUMENTS_OF(LIST) Arguments() LIST(TRIAD_ADD, TRIAD_ADD, TRIAD_ADD, TRIAD_ADD)
inline Arguments arguments_of(const dev::SceneArguments& a) {
    return Arguments() SCENE_LIST(TRIAD_ADD, TRIAD_ADD);
}
// clang-format off
inline Arguments arguments_of(const dev::TracePathsArguments& a) { return TRIAD_ARGUMENTS_OF(TRACE_PATHS_LIST); }
inline Arguments arguments_of(const dev::TraceWaveArguments& a) { return TRIAD_ARGUMENTS_OF(TRACE_WAVE_LIST); }
inline Arguments arguments_of(const dev::RecordPathsArguments& a) { return TRIAD_ARGUMENTS_OF(RECORD_PATHS_LIST); }
inline Arguments arguments_of(const dev::CountWorkArguments& a) { return TRIAD_ARGUMENTS_OF(COUNT_WORK_LIST); }
inline Arguments arguments_of(const dev::TraceFeaturesArguments& a) { return TRIAD_ARGUMENTS_OF(TRACE_FEATURES_LIST); }
inline Arguments arguments_of(const dev::TracePhotonsArguments& a) { return TRIAD_ARGUMENTS_OF(TRACE_PHOTONS_LIST); }
// clang-format on
#undef TRIAD_ARGUMENTS_OF
#undef TRIAD_ADD

}  // namespace triad
