#include "scene/environment_maps.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_for.h"

namespace triad {
namespace {

constexpr unsigned least_columns = 256;
constexpr unsigned harmonic_columns = 128;  // three bands change slowly
constexpr unsigned samples = 2;             // of a texel of a cube's map, in each direction

/// What a face looks along, and which ways its columns and its rows run.
struct Face {
    dvec3 forward, right, down;
};
const Face faces[6] = {
    {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},  {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
};

/// A place on a face; its middle is (0, 0), its edges are at -1 and 1.
struct OnFace {
    std::size_t face;
    double right, down;
};

OnFace project(const dvec3& d) {
    const dvec3 size = glm::abs(d);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t face = std::size_t(2 * axis + (d[axis] < 0.0 ? 1 : 0));
    return {face, glm::dot(d, faces[face].right) / size[axis], glm::dot(d, faces[face].down) / size[axis]};
}

const float* texel(const CubeMap& cube, std::size_t face, long x, long y) {
    const long n = long(cube.size);
    if (x < 0 || y < 0 || x >= n || y >= n) {  // beyond an edge: on the face that is there
        const Face& f = faces[face];
        const OnFace at = project(f.forward + (2.0 * (double(x) + 0.5) / double(n) - 1.0) * f.right +
                                  (2.0 * (double(y) + 0.5) / double(n) - 1.0) * f.down);
        const auto nearest = [n](double t) {
            return std::clamp(long(std::floor(0.5 * (t + 1.0) * double(n))), 0l, n - 1);
        };
        face = at.face, x = nearest(at.right), y = nearest(at.down);
    }
    return cube.faces[face].data() + 3 * std::size_t(y * n + x);
}

dvec3 bilinear(const CubeMap& cube, const dvec3& direction) {
    const OnFace at = project(direction);
    const double x = 0.5 * (at.right + 1.0) * cube.size - 0.5, y = 0.5 * (at.down + 1.0) * cube.size - 0.5;
    const long x0 = long(std::floor(x)), y0 = long(std::floor(y)), n = long(cube.size);
    const bool inside = x0 >= 0 && y0 >= 0 && x0 + 1 < n && y0 + 1 < n;
    const float* corner = inside ? cube.faces[at.face].data() + 3 * (y0 * n + x0) : nullptr;
    dvec3 sum(0.0);
    for (long k = 0; k < 4; ++k) {
        const long right = k & 1, down = k >> 1;
        const double ax = x - double(x0), ay = y - double(y0);
        const double weight = (right ? ax : 1.0 - ax) * (down ? ay : 1.0 - ay);
        const float* t =
            inside ? corner + 3 * (down * n + right) : texel(cube, at.face, x0 + right, y0 + down);
        sum += weight * dvec3(t[0], t[1], t[2]);
    }
    return sum;
}

/// A map of what `radiance` says of a direction, as the mean of n x n places in every texel.
template <class Radiance>
EnvironmentMap map_of(unsigned columns, unsigned n, const dquat& rotation, const Radiance& radiance) {
    EnvironmentMap map{columns, columns / 2, {}};
    map.rgb.resize(std::size_t(map.width) * map.height * 3);
    const dmat3 to_light = glm::transpose(glm::mat3_cast(rotation));
    std::vector<dvec2> around(std::size_t(map.width) * n);  // the cosine and the sine of each place's angle
    for (std::size_t i = 0; i < around.size(); ++i) {
        const double phi = 2 * pi * ((double(i) + 0.5) / double(around.size()) - 0.5);
        around[i] = {std::cos(phi), std::sin(phi)};
    }
    parallel_for(map.height, 4, [&](std::size_t begin, std::size_t end) {
        std::vector<dvec3> sums(map.width);
        for (std::size_t row = begin; row < end; ++row) {
            sums.assign(map.width, dvec3(0.0));
            for (unsigned k = 0; k < n; ++k) {
                const double theta = pi * (double(row) + (k + 0.5) / n) / map.height;
                const double sine = std::sin(theta), cosine = std::cos(theta);
                for (std::size_t i = 0; i < around.size(); ++i)
                    sums[i / n] += radiance(to_light * dvec3(sine * around[i].x, cosine, sine * around[i].y));
            }
            for (std::size_t column = 0; column < map.width; ++column)
                to_floats(map.rgb.data() + 3 * (row * map.width + column), sums[column] / double(n * n));
        }
    });
    return map;
}

}  // namespace

unsigned columns_for(unsigned cube_size) {
    return std::clamp(4 * std::min(cube_size, most_columns), least_columns, most_columns);
}

EnvironmentMap environment_of(const CubeMap& cube, const dquat& rotation) {
    return map_of(columns_for(cube.size), samples, rotation,
                  [&](const dvec3& d) { return bilinear(cube, d); });
}

EnvironmentMap environment_of(const IrradianceHarmonics& irradiance, const dquat& rotation) {
    // A surface averages its hemisphere with the cosine: that multiplies the bands by these.
    constexpr double of_band[] = {pi, 2 * pi / 3, pi / 4};
    return map_of(harmonic_columns, 1, rotation, [&](const dvec3& d) {
        const double y[9] = {0.282094792,
                             0.488602512 * d.y,
                             0.488602512 * d.z,
                             0.488602512 * d.x,
                             1.092548431 * d.x * d.y,
                             1.092548431 * d.y * d.z,
                             0.315391565 * (3 * d.z * d.z - 1),
                             1.092548431 * d.x * d.z,
                             0.546274215 * (d.x * d.x - d.y * d.y)};
        dvec3 sum(0.0);
        for (int i = 0; i < 9; ++i) sum += y[i] / of_band[i == 0 ? 0 : i < 4 ? 1 : 2] * irradiance[i];
        return glm::max(sum, dvec3(0.0));
    });
}

}  // namespace triad
