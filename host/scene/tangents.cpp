#include "scene/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace triad {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

class TangentSpace {
  public:
    TangentSpace(const Primitive& primitive, const std::vector<vec2>& uvs)
        : primitive_(primitive), uvs_(uvs) {
        weld();
        for (std::size_t f = 0; f < primitive.triangles.size(); ++f) faces_.push_back(make_face(f));
        find_neighbours();
    }

    /// A tangent per corner, corner 3 f + k of triangle f.
    std::vector<vec4> corners() {
        std::vector<vec4> result(3 * faces_.size(), vec4(0.0f));
        assigned_.assign(3 * faces_.size(), 0);
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (faces_[f].is_degenerate || faces_[f].any_group) continue;
            for (int k = 0; k < 3; ++k) {
                if (assigned_[3 * f + k]) continue;
                const std::vector<std::uint32_t> group = grow_group(3 * f + k);
                const vec4 tangent = evaluate(group, faces_[f].preserves_orientation);
                for (const std::uint32_t corner : group) result[corner] = tangent;
            }
        }
        fill_rest(result);
        return result;
    }

  private:
    struct Face {
        vec3 tangent{0.0f};  ///< dP/du, unit, turned so that orientation is taken out
        bool preserves_orientation = false;
        bool any_group = true;       ///< no tangent of its own: joins whatever group meets it
        bool is_degenerate = false;  ///< two corners at one position
        bool is_oriented_by_group = false;
    };

    std::uint32_t vertex(std::uint32_t corner) const {
        return primitive_.triangles[corner / 3][int(corner % 3)];
    }
    static std::uint32_t next(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    static std::uint32_t previous(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

    std::array<float, 8> key(std::uint32_t v) const {
        const vec3 &p = primitive_.positions[v], &n = primitive_.normals[v];
        // Adding 0 makes one zero of two.
        return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f,       n.x + 0.0f,
                n.y + 0.0f, n.z + 0.0f, uvs_[v].x + 0.0f, uvs_[v].y + 0.0f};
    }

    /// welded_[v]: the first of the vertices that agree with v in position, normal and uv.
    void weld() {
        const std::size_t count = primitive_.positions.size();
        std::vector<std::array<float, 8>> keys(count);
        for (std::uint32_t v = 0; v < count; ++v) {
            keys[v] = key(v);
            if (!std::all_of(keys[v].begin(), keys[v].end(), [](float x) { return std::isfinite(x); }))
                keys[v] = {};  // such triangles are not drawn; a NaN would break the order below
        }
        std::vector<std::uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
        });
        welded_.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            welded_[order[i]] =
                i > 0 && keys[order[i]] == keys[order[i - 1]] ? welded_[order[i - 1]] : order[i];
    }

    Face make_face(std::size_t f) const {
        const uvec3& t = primitive_.triangles[f];
        const vec3 &p0 = primitive_.positions[t.x], &p1 = primitive_.positions[t.y],
                   &p2 = primitive_.positions[t.z];
        Face face;
        face.is_degenerate = p0 == p1 || p1 == p2 || p2 == p0;
        // v runs up in the paper.
        const dvec2 t21 = dvec2(uvs_[t.y].x - uvs_[t.x].x, uvs_[t.x].y - uvs_[t.y].y);
        const dvec2 t31 = dvec2(uvs_[t.z].x - uvs_[t.x].x, uvs_[t.x].y - uvs_[t.z].y);
        const dvec3 d1 = dvec3(p1) - dvec3(p0), d2 = dvec3(p2) - dvec3(p0);
        const double area = t21.x * t31.y - t21.y * t31.x;
        face.preserves_orientation = area > 0.0;
        const dvec3 os = t31.y * d1 - t21.y * d2, ot = t21.x * d2 - t31.x * d1;
        const double length_s = glm::length(os), length_t = glm::length(ot);
        if (std::abs(area) > 1e-30 && length_s > 1e-30 && length_t > 1e-30 &&
            std::isfinite(length_s * length_t)) {
            face.tangent = vec3(os * ((area > 0.0 ? 1.0 : -1.0) / length_s));
            face.any_group = false;
        }
        return face;
    }

    /// neighbours_[c]: the corner whose edge to its next corner is that of c, run the other way.
    void find_neighbours() {
        struct Edge {
            std::uint32_t from, to, corner;
        };
        std::vector<Edge> edges;
        for (std::uint32_t corner = 0; corner < 3 * faces_.size(); ++corner)
            if (!faces_[corner / 3].is_degenerate)
                edges.push_back({welded_[vertex(corner)], welded_[vertex(next(corner))], corner});
        const auto undirected = [](const Edge& e) { return std::minmax(e.from, e.to); };
        std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
            const auto ka = undirected(a), kb = undirected(b);
            return ka != kb ? ka < kb : a.corner < b.corner;
        });
        neighbours_.assign(3 * faces_.size(), none);
        for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
            for (end = begin + 1; end < edges.size() && undirected(edges[end]) == undirected(edges[begin]);)
                ++end;
            // Where more than two triangles meet, the first that fit are paired.
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t j = i + 1; j < end && neighbours_[edges[i].corner] == none; ++j)
                    if (edges[j].from == edges[i].to && neighbours_[edges[j].corner] == none)
                        neighbours_[edges[i].corner] = edges[j].corner,
                        neighbours_[edges[j].corner] = edges[i].corner;
        }
    }

    /// The corners around one welded vertex that share a tangent with this one.
    std::vector<std::uint32_t> grow_group(std::uint32_t first) {
        const bool orientation = faces_[first / 3].preserves_orientation;
        const std::uint32_t center = welded_[vertex(first)];
        std::vector<std::uint32_t> group{first};
        assigned_[first] = 1;
        const auto reach = [&](std::uint32_t edge) {
            if (edge == none) return;
            const std::uint32_t other = neighbours_[edge];
            if (other == none) return;
            // The edge has the vertex at one of its two ends.
            const std::uint32_t corner = welded_[vertex(other)] == center ? other : next(other);
            Face& face = faces_[corner / 3];
            if (face.any_group && !face.is_oriented_by_group) {
                face.preserves_orientation = orientation;
                face.is_oriented_by_group = true;
            }
            if (assigned_[corner] || face.preserves_orientation != orientation) return;
            assigned_[corner] = 1;
            group.push_back(corner);
        };
        for (std::size_t i = 0; i < group.size(); ++i) {
            const std::uint32_t corner = group[i];
            reach(corner);
            reach(previous(corner));
        }
        return group;
    }

    vec4 evaluate(const std::vector<std::uint32_t>& group, bool orientation) const {
        const dvec3 n = primitive_.normals[vertex(group[0])];
        const auto project = [&](const dvec3& x) {
            const dvec3 p = x - n * glm::dot(n, x);
            const double length = glm::length(p);
            return length > 1e-30 ? p / length : dvec3(0.0);
        };
        dvec3 sum(0.0);
        for (const std::uint32_t corner : group) {
            const Face& face = faces_[corner / 3];
            if (face.any_group) continue;
            const dvec3 p = primitive_.positions[vertex(corner)];
            const dvec3 e1 = project(dvec3(primitive_.positions[vertex(previous(corner))]) - p);
            const dvec3 e2 = project(dvec3(primitive_.positions[vertex(next(corner))]) - p);
            const double angle = std::acos(std::clamp(glm::dot(e1, e2), -1.0, 1.0));
            sum += angle * project(dvec3(face.tangent));
        }
        const double length = glm::length(sum);
        const float sign = orientation ? 1.0f : -1.0f;
        if (!(length > 1e-30)) return vec4(any_tangent(n), sign);
        return vec4(vec3(sum / length), sign);
    }

    /// Some unit vector at right angles to n.
    static vec3 any_tangent(const dvec3& n) {
        const dvec3 axis = std::abs(n.x) < 0.9 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
        return vec3(glm::normalize(axis - n * glm::dot(n, axis)));
    }

    /// Corners in no group take the tangent of a corner at the same welded vertex, or any.
    void fill_rest(std::vector<vec4>& tangents) const {
        std::vector<std::uint32_t> donor(primitive_.positions.size(), none);
        for (std::uint32_t corner = 0; corner < tangents.size(); ++corner)
            if (assigned_[corner] && donor[welded_[vertex(corner)]] == none)
                donor[welded_[vertex(corner)]] = corner;
        for (std::uint32_t corner = 0; corner < tangents.size(); ++corner) {
            if (assigned_[corner]) continue;
            const std::uint32_t from = donor[welded_[vertex(corner)]];
            tangents[corner] =
                from != none ? tangents[from] : vec4(any_tangent(primitive_.normals[vertex(corner)]), 1.0f);
        }
    }

    const Primitive& primitive_;
    const std::vector<vec2>& uvs_;
    std::vector<std::uint32_t> welded_, neighbours_;
    std::vector<Face> faces_;
    std::vector<std::uint8_t> assigned_;
};

/// Appends a copy of vertex v and returns its index.
std::uint32_t duplicate(Primitive& p, std::uint32_t v) {
    const auto again = [v](auto& attribute) {
        if (attribute.empty()) return;
        const auto value = attribute[v];  // a copy: push_back may move the array
        attribute.push_back(value);
    };
    again(p.positions), again(p.normals), again(p.tangents), again(p.uvs[0]), again(p.uvs[1]),
        again(p.colours);
    return std::uint32_t(p.positions.size() - 1);
}

}  // namespace

void make_flat(Primitive& primitive) {
    Primitive flat;
    flat.material = primitive.material;
    const auto gather = [&](auto& to, const auto& from) {
        if (from.empty()) return;
        to.reserve(3 * primitive.triangles.size());
        for (const uvec3& t : primitive.triangles)
            for (int k = 0; k < 3; ++k) to.push_back(from[t[k]]);
    };
    gather(flat.positions, primitive.positions);
    gather(flat.uvs[0], primitive.uvs[0]);
    gather(flat.uvs[1], primitive.uvs[1]);
    gather(flat.colours, primitive.colours);
    for (std::uint32_t i = 0; i < primitive.triangles.size(); ++i) {
        const dvec3 a = flat.positions[3 * i], b = flat.positions[3 * i + 1], c = flat.positions[3 * i + 2];
        const dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        const vec3 normal = length > 0.0 && std::isfinite(length) ? vec3(n / length) : vec3(0.0f, 0.0f, 1.0f);
        flat.normals.insert(flat.normals.end(), 3, normal);
        flat.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    primitive = std::move(flat);
}

void generate_tangents(Primitive& primitive, const std::vector<vec2>& uvs) {
    const std::vector<vec4> corners = TangentSpace(primitive, uvs).corners();
    const std::uint32_t originals = std::uint32_t(primitive.positions.size());
    primitive.tangents.assign(originals, vec4(0.0f));
    // twin[v]: the next vertex made from the same original. Few have more than two.
    std::vector<std::uint32_t> twin(originals, none);
    for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
        std::uint32_t& index = primitive.triangles[corner / 3][int(corner % 3)];
        for (std::uint32_t v = index;; v = twin[v]) {
            if (primitive.tangents[v] == vec4(0.0f)) primitive.tangents[v] = corners[corner];
            index = v;
            if (primitive.tangents[v] == corners[corner]) break;
            if (twin[v] == none) {
                index = duplicate(primitive, v);
                primitive.tangents[index] = corners[corner];
                twin[v] = index;
                twin.push_back(none);
                break;
            }
        }
    }
    for (std::uint32_t v = 0; v < originals; ++v)  // vertices of no triangle
        if (primitive.tangents[v] == vec4(0.0f)) primitive.tangents[v] = vec4(1.0f, 0.0f, 0.0f, 1.0f);
}

}  // namespace triad
