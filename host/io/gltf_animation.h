#pragma once
/// Animations, sampled at one moment.
#include <string>
#include <vector>

#include "io/gltf_file.h"

namespace triad::gltf {

/// The animation of that name or index; empty: the first; -1 for "none" and where the file has none. Throws
/// Error(usage) that lists those there are.
int choose_animation(const File& file, const std::string& choice);

/// Seconds from 0 to the last of the animation's key frames.
double length_of(File& file, int animation);

/// All nodes that the animation (-1: none) moves, at `seconds`; before and after its key frames a channel
/// stays at the first and last. Channels that mean nothing here are left out with a warning. Throws
/// Error(scene) that names the animation.
Pose pose_at(File& file, int animation, double seconds);

enum class Interpolation { step, linear, cubic };

/// `values` at `time`, `width` numbers for every key; cubic ones have three sets of them: in-tangents,
/// values, out-tangents. A quaternion (`spherical`) goes the short way round and comes out at unit length.
/// `times` rise and are not empty.
std::vector<double> interpolate(const std::vector<float>& times, const std::vector<float>& values,
                                std::size_t width, double time, Interpolation interpolation, bool spherical);

}  // namespace triad::gltf
