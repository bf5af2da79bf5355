/// Between key frames (glTF 2.0, appendix C).
#include <algorithm>

#include "io/gltf_animation.h"

namespace triad::gltf {
namespace {

dquat quaternion(const std::vector<double>& v) { return dquat(v[3], v[0], v[1], v[2]); }

std::vector<double> numbers(const dquat& q) { return {q.x, q.y, q.z, q.w}; }

}  // namespace

std::vector<double> interpolate(const std::vector<float>& times, const std::vector<float>& values,
                                std::size_t width, double time, Interpolation interpolation, bool spherical) {
    const bool cubic = interpolation == Interpolation::cubic;
    /// part: of a cubic key, 0 in-tangent, 1 value, 2 out-tangent
    const auto at = [&](std::size_t key, std::size_t part) {
        const auto first = values.begin() + std::ptrdiff_t((cubic ? 3 * key + part : key) * width);
        return std::vector<double>(first, first + std::ptrdiff_t(width));
    };
    const auto unit = [&](std::vector<double> v) {
        return spherical ? numbers(glm::normalize(quaternion(v))) : v;
    };
    const std::size_t after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (after == 0) return unit(at(0, 1));
    if (after == times.size()) return unit(at(after - 1, 1));
    const std::size_t before = after - 1;
    if (interpolation == Interpolation::step) return unit(at(before, 1));
    const double duration = double(times[after]) - double(times[before]),
                 t = (time - double(times[before])) / duration;
    std::vector<double> a = at(before, 1), b = at(after, 1);
    if (!cubic && spherical)
        return numbers(
            glm::normalize(glm::slerp(glm::normalize(quaternion(a)), glm::normalize(quaternion(b)), t)));
    if (!cubic) {
        for (std::size_t i = 0; i < width; ++i) a[i] += t * (b[i] - a[i]);
        return a;
    }
    const std::vector<double> out = at(before, 2), in = at(after, 0);
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < width; ++i)
        a[i] = (2 * t3 - 3 * t2 + 1) * a[i] + duration * (t3 - 2 * t2 + t) * out[i] +
               (3 * t2 - 2 * t3) * b[i] + duration * (t3 - t2) * in[i];
    return unit(std::move(a));
}

}  // namespace triad::gltf
