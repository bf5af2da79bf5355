#pragma once
/// Aliases over GLM. Positions and transforms of the scene are double on the host until they are rebased.
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

namespace triad {

using glm::dmat3;
using glm::dmat4;
using glm::dquat;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr double pi = 3.14159265358979323846;

/// An axis-aligned box; empty until something is added.
struct Bounds {
    dvec3 lo{std::numeric_limits<double>::infinity()};
    dvec3 hi{-std::numeric_limits<double>::infinity()};

    void add(const dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
    void add(const Bounds& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    dvec3 centre() const { return 0.5 * (lo + hi); }
    dvec3 size() const { return hi - lo; }
    double radius() const { return empty() ? 0.0 : 0.5 * glm::length(size()); }
};

inline void to_floats(float out[3], const dvec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

inline dvec3 transform_point(const dmat4& m, const dvec3& p) { return dvec3(m * dvec4(p, 1.0)); }
inline dvec3 transform_vector(const dmat4& m, const dvec3& v) { return dvec3(m * dvec4(v, 0.0)); }

}  // namespace triad
