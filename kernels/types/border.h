/* What every part of types.h is written in. */
#ifndef TRIAD_TYPES_BORDER_H
#define TRIAD_TYPES_BORDER_H

#ifdef __OPENCL_C_VERSION__
#define TRIAD_TYPES_BEGIN
#define TRIAD_TYPES_END
#define TRIAD_SIZE(type, bytes) typedef char type##_has_##bytes##_bytes[sizeof(type) == (bytes) ? 1 : -1]
#else
#include <cstdint>
/* triad::Material is the scene's, triad::dev::Material the kernels' */
#define TRIAD_TYPES_BEGIN namespace triad::dev {
#define TRIAD_TYPES_END }
#define TRIAD_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type " has " #bytes " bytes")
namespace triad::dev {
using uint = std::uint32_t;
using ushort = std::uint16_t;
}  // namespace triad::dev
#endif

#define TRIAD_NONE 0xffffffffu /* no index: no texture, no attribute, no primitive */

#endif
