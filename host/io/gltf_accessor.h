#pragma once
/// Accessors as plain arrays. Every size is checked against the buffer before anything is read or allocated.
#include <cstdint>
#include <string>
#include <vector>

#include "base/math.h"
#include "io/gltf_file.h"

namespace triad::gltf {

/// Which component types an accessor may have, beside 32-bit float.
enum class Integers {
    none,               ///< float only
    normalised,         ///< unsigned 8 and 16 bits, normalised
    signed_normalised,  ///< signed 8 and 16 bits, normalised
    any_normalised,     ///< 8 and 16 bits of either kind, normalised
    counts,             ///< unsigned 8 and 16 bits as they are, and no floats
    quantised,  ///< 8 and 16 bits of any kind when the file declares KHR_mesh_quantization, else float only
};

/// Elements with `components` (1, 2, 3, 4 or 16: scalars, vectors, matrices) floats each, sparse values
/// applied. Throws Error(scene) that starts with `what`.
std::vector<float> read_floats(File& file, int accessor, int components, Integers integers,
                               const std::string& what);

/// The same as vectors.
std::vector<vec2> read_vec2(File& file, int accessor, Integers integers, const std::string& what);
std::vector<vec3> read_vec3(File& file, int accessor, Integers integers, const std::string& what);
std::vector<vec4> read_vec4(File& file, int accessor, Integers integers, const std::string& what);

/// Unsigned scalars of 8, 16 or 32 bits.
std::vector<std::uint32_t> read_indices(File& file, int accessor, const std::string& what);

}  // namespace triad::gltf
