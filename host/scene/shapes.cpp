#include "scene/shapes.h"

#include <algorithm>
#include <cmath>

namespace triad::shapes {
namespace {

/// Two triangles for every cell of a grid of vertices, (columns + 1) x (rows + 1), row by row.
void add_grid(Primitive& shape, unsigned columns, unsigned rows) {
    const auto vertex = [&](unsigned column, unsigned row) { return row * (columns + 1) + column; };
    for (unsigned r = 0; r < rows; ++r)
        for (unsigned c = 0; c < columns; ++c) {
            shape.triangles.emplace_back(vertex(c, r), vertex(c + 1, r), vertex(c + 1, r + 1));
            shape.triangles.emplace_back(vertex(c, r), vertex(c + 1, r + 1), vertex(c, r + 1));
        }
}

std::uint32_t hash(std::uint32_t x) {  // lowbias32, Wellons 2018
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Calls radius(unit direction) for every vertex of a closed lat-long mesh.
template <class Radius>
Primitive closed_surface(const vec3& centre, unsigned meridians, unsigned parallels, const Radius& radius) {
    Primitive shape;
    const auto add = [&](double theta, double phi) {
        const vec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta),
                             -std::sin(theta) * std::sin(phi));
        shape.positions.push_back(centre + radius(direction) * direction);
        shape.normals.push_back(direction);
    };
    const unsigned rings = parallels - 1;
    add(0.0, 0.0);
    for (unsigned r = 1; r <= rings; ++r)
        for (unsigned m = 0; m < meridians; ++m) add(pi * r / parallels, 2 * pi * m / meridians);
    add(pi, 0.0);
    const auto last = unsigned(shape.positions.size() - 1);
    const auto vertex = [&](unsigned ring, unsigned m) { return 1 + ring * meridians + m % meridians; };
    for (unsigned m = 0; m < meridians; ++m) {
        shape.triangles.emplace_back(0, vertex(0, m), vertex(0, m + 1));
        for (unsigned r = 0; r + 1 < rings; ++r) {
            shape.triangles.emplace_back(vertex(r, m), vertex(r + 1, m), vertex(r + 1, m + 1));
            shape.triangles.emplace_back(vertex(r, m), vertex(r + 1, m + 1), vertex(r, m + 1));
        }
        shape.triangles.emplace_back(vertex(rings - 1, m), last, vertex(rings - 1, m + 1));
    }
    return shape;
}

}  // namespace

Primitive quad(const vec3& corner, const vec3& edge_u, const vec3& edge_v, unsigned columns, unsigned rows) {
    Primitive shape;
    const vec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
    for (unsigned r = 0; r <= rows; ++r)
        for (unsigned c = 0; c <= columns; ++c) {
            const vec2 uv(float(c) / float(columns), float(r) / float(rows));
            shape.positions.push_back(corner + uv.x * edge_u + uv.y * edge_v);
            shape.normals.push_back(normal);
            shape.uvs[0].push_back(uv);
        }
    add_grid(shape, columns, rows);
    return shape;
}

Primitive box(const vec3& lo, const vec3& hi, bool inward) {
    Primitive shape;
    const vec3 size = hi - lo;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            vec3 corner = lo, u(0.0f), v(0.0f);
            corner[axis] = high ? hi[axis] : lo[axis];
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];
            append(shape, high != inward ? quad(corner, u, v) : quad(corner, v, u));
        }
    return shape;
}

Primitive rounded_box(const dvec3& half, double radius, unsigned steps) {
    // Points of the sharp box are pulled onto the rounded one along the normal of the nearest point of the
    // inner box; tangent spacing makes equal angles of it.
    const auto coordinates = [&](double h) {
        std::vector<double> c;
        for (unsigned i = 0; i <= steps; ++i)
            c.push_back(-(h - radius) - radius * std::tan(0.25 * pi * (steps - i) / steps));
        for (unsigned i = 0; i <= steps; ++i) c.push_back(-c[steps - i]);
        return c;
    };
    const dvec3 inner = half - dvec3(radius);
    Primitive shape;
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1}) {
            const int u = sign > 0 ? (axis + 1) % 3 : (axis + 2) % 3, v = 3 - axis - u;  // u x v points out
            const std::vector<double> cu = coordinates(half[u]), cv = coordinates(half[v]);
            Primitive side;
            for (const double b : cv)
                for (const double a : cu) {
                    dvec3 sharp;
                    sharp[axis] = sign * half[axis], sharp[u] = a, sharp[v] = b;
                    const dvec3 core = glm::clamp(sharp, -inner, inner),
                                normal = glm::normalize(sharp - core);
                    side.positions.push_back(vec3(core + radius * normal));
                    side.normals.push_back(vec3(normal));
                }
            add_grid(side, unsigned(cu.size() - 1), unsigned(cv.size() - 1));
            append(shape, side);
        }
    return shape;
}

Primitive lat_long_sphere(const vec3& centre, float radius, unsigned meridians, unsigned parallels) {
    return closed_surface(centre, meridians, parallels, [&](const vec3&) { return radius; });
}

Primitive displaced_sphere(const vec3& centre, float radius, unsigned meridians, unsigned parallels,
                           float amplitude, float frequency, std::uint32_t seed) {
    Primitive shape = closed_surface(centre, meridians, parallels, [&](const vec3& direction) {
        return radius * (1.0f + amplitude * value_noise(frequency * direction, seed));
    });
    shape.normals.clear();
    return shape;
}

Primitive torus(const vec3& centre, float major_radius, float minor_radius, unsigned around,
                unsigned across) {
    Primitive shape;
    for (unsigned i = 0; i < around; ++i)
        for (unsigned j = 0; j < across; ++j) {
            const double phi = 2 * pi * i / around, theta = 2 * pi * j / across;
            const vec3 outward(std::cos(phi), 0.0, -std::sin(phi));
            const vec3 normal = float(std::cos(theta)) * outward + vec3(0.0f, float(std::sin(theta)), 0.0f);
            shape.positions.push_back(centre + major_radius * outward + minor_radius * normal);
            shape.normals.push_back(normal);
        }
    const auto vertex = [&](unsigned i, unsigned j) { return (i % around) * across + j % across; };
    for (unsigned i = 0; i < around; ++i)
        for (unsigned j = 0; j < across; ++j) {
            shape.triangles.emplace_back(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
            shape.triangles.emplace_back(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
    return shape;
}

Primitive terrain(float size, float height, unsigned cells, std::uint32_t seed) {
    Primitive shape =
        quad({-0.5f * size, 0.0f, 0.5f * size}, {size, 0.0f, 0.0f}, {0.0f, 0.0f, -size}, cells, cells);
    for (vec3& p : shape.positions) {
        float sum = 0.0f, amplitude = 0.5f, frequency = 4.0f / size;
        for (unsigned octave = 0; octave < 8; ++octave, amplitude *= 0.5f, frequency *= 2.0f)
            sum += amplitude * value_noise(frequency * p, seed + octave);
        p.y = height * sum;
    }
    shape.normals.clear();
    return shape;
}

float value_noise(const vec3& p, std::uint32_t seed) {
    const vec3 cell = glm::floor(p), f = p - cell, s = f * f * (3.0f - 2.0f * f);
    const auto lattice = [&](int x, int y, int z) {
        const auto at = [](float c, int offset) { return std::uint32_t(std::int64_t(c) + offset); };
        const std::uint32_t h = hash(at(cell.x, x) + hash(at(cell.y, y) + hash(at(cell.z, z) + hash(seed))));
        return float(h >> 8) * 0x1p-23f - 1.0f;
    };
    const auto row = [&](int y, int z) { return glm::mix(lattice(0, y, z), lattice(1, y, z), s.x); };
    return glm::mix(glm::mix(row(0, 0), row(1, 0), s.y), glm::mix(row(0, 1), row(1, 1), s.y), s.z);
}

void append(Primitive& to, const Primitive& from) {
    const auto offset = unsigned(to.positions.size());
    const auto join = [&](auto& a, const auto& b) {
        if (a.size() == offset && !b.empty())
            a.insert(a.end(), b.begin(), b.end());
        else
            a.clear();
    };
    join(to.normals, from.normals);
    join(to.tangents, from.tangents);
    join(to.uvs[0], from.uvs[0]);
    join(to.uvs[1], from.uvs[1]);
    join(to.colours, from.colours);
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (const uvec3& t : from.triangles) to.triangles.push_back(t + offset);
}

}  // namespace triad::shapes
