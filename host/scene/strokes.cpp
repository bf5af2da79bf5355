#include "scene/strokes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace triad {
namespace {

constexpr int most_splits = 12;            // of one line: each halves it
constexpr double uneven = 1.1;             // a line is split where its width is that far from even
constexpr double least_slant = 0.1;        // of the view; what is beside or behind the eye is seen in mirrors
constexpr double pixels_of_hexagon = 4.0;  // wider caps get more corners

/// A vertex on a stroke, in the world.
struct Point {
    dvec3 position;
    dvec3 normal;
    dvec2 uv[2];
    dvec4 colour;
};

Point middle(const Point& a, const Point& b) {
    return {0.5 * (a.position + b.position),
            0.5 * (a.normal + b.normal),
            {0.5 * (a.uv[0] + b.uv[0]), 0.5 * (a.uv[1] + b.uv[1])},
            0.5 * (a.colour + b.colour)};
}

/// One primitive's strokes on one instance, as triangles around `centre`.
class Pen {
  public:
    Pen(const Primitive& source, const dmat4& to_world, const View& view, unsigned height, double pixels,
        const dvec3& centre)
        : source_(source),
          to_world_(to_world),
          normals_(glm::transpose(glm::inverse(dmat3(to_world)))),
          view_(view),
          half_(0.5 * pixels * 2.0 * view.extent.y / height),
          corners_(std::clamp(int(6 * pixels / pixels_of_hexagon), 6, 32)),
          centre_(centre) {
        out_.material = source.material;
    }

    Primitive draw() {
        std::set<std::uint32_t> caps;
        for (const uvec2& stroke : source_.strokes) {
            caps.insert({stroke.x, stroke.y});
            if (stroke.x != stroke.y) ribbon(point(stroke.x), point(stroke.y), most_splits);
        }
        for (const std::uint32_t vertex : caps) cap(point(vertex));
        return std::move(out_);
    }

  private:
    Point point(std::uint32_t i) const {
        Point p{transform_point(to_world_, dvec3(source_.positions[i])), dvec3(0.0), {}, dvec4(1.0)};
        if (!source_.normals.empty()) p.normal = normals_ * dvec3(source_.normals[i]);
        for (int set = 0; set < 2; ++set)
            if (!source_.uvs[set].empty()) p.uv[set] = dvec2(source_.uvs[set][i]);
        if (!source_.colours.empty()) p.colour = dvec4(source_.colours[i]);
        return p;
    }

    /// Half the width of a stroke here, in the world.
    double half_width(const dvec3& p) const {
        if (view_.orthographic) return half_;
        const dvec3 way = p - view_.eye;
        return half_ * std::max(glm::dot(way, view_.forward), least_slant * glm::length(way));
    }

    /// Unit, from p to the eye.
    dvec3 to_eye(const dvec3& p) const {
        const dvec3 way = view_.orthographic ? -view_.forward : view_.eye - p;
        const double length = glm::length(way);
        return length > 0.0 ? way / length : -view_.forward;
    }

    std::uint32_t add(const Point& p, const dvec3& position) {
        const dvec3 facing = to_eye(p.position);
        out_.positions.emplace_back(position + half_width(p.position) * facing - centre_);
        if (!source_.normals.empty()) {
            const double length = glm::length(p.normal);
            dvec3 normal = length > 0.0 ? p.normal / length : facing;
            if (glm::dot(normal, facing) < 0.0) normal = -normal;
            out_.normals.emplace_back(glm::normalize(vec3(normal)));
        }
        for (int set = 0; set < 2; ++set)
            if (!source_.uvs[set].empty()) out_.uvs[set].emplace_back(p.uv[set]);
        if (!source_.colours.empty()) out_.colours.emplace_back(p.colour);
        return std::uint32_t(out_.positions.size() - 1);
    }

    void cap(const Point& p) {
        const dvec3 facing = to_eye(p.position);
        const dvec3 right = glm::normalize(
            glm::cross(std::abs(glm::dot(facing, view_.up)) < 0.9 ? view_.up : view_.right, facing));
        const dvec3 up = glm::cross(facing, right);
        const double radius = half_width(p.position);
        std::uint32_t first = 0;
        for (int i = 0; i < corners_; ++i) {
            const double angle = 2.0 * pi * i / corners_;
            const std::uint32_t at =
                add(p, p.position + radius * (std::cos(angle) * right + std::sin(angle) * up));
            if (i == 0) first = at;
            if (i >= 2) out_.triangles.emplace_back(first, at - 1, at);
        }
    }

    void ribbon(const Point& a, const Point& b, int splits) {
        const double at_a = half_width(a.position), at_b = half_width(b.position);
        const Point m = middle(a, b);
        if (splits > 0 && 0.5 * (at_a + at_b) > uneven * half_width(m.position)) {
            ribbon(a, m, splits - 1);
            return ribbon(m, b, splits - 1);
        }
        // The plane of the eye and the line: all of the line's points have the same one.
        const dvec3 across = glm::cross(b.position - a.position, to_eye(m.position));
        const double length = glm::length(across);
        if (!(length > 0.0)) return;  // seen end on
        const dvec3 side = across / length;
        const std::uint32_t a0 = add(a, a.position - at_a * side);
        add(a, a.position + at_a * side);
        add(b, b.position - at_b * side);
        add(b, b.position + at_b * side);
        out_.triangles.emplace_back(a0, a0 + 1, a0 + 3);
        out_.triangles.emplace_back(a0, a0 + 3, a0 + 2);
        const auto place = [&](std::uint32_t i) { return dvec3(out_.positions[i]); };
        const dvec3 front = glm::cross(place(a0 + 1) - place(a0), place(a0 + 3) - place(a0));
        if (glm::dot(front, to_eye(m.position)) >= 0.0) return;
        for (auto t = out_.triangles.end() - 2; t != out_.triangles.end(); ++t) std::swap(t->y, t->z);
    }

    const Primitive& source_;
    const dmat4& to_world_;
    const dmat3 normals_;
    const View& view_;
    const double half_;  ///< at unit distance
    const int corners_;
    const dvec3 centre_;
    Primitive out_;
};

bool has_strokes(const Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& p) { return !p.strokes.empty(); });
}

dvec3 centre_of(const Mesh& mesh, const dmat4& to_world) {
    Bounds bounds;
    for (const Primitive& p : mesh.primitives)
        for (const uvec2& stroke : p.strokes)
            for (int end = 0; end < 2; ++end)
                bounds.add(transform_point(to_world, dvec3(p.positions[stroke[end]])));
    return bounds.centre();
}

}  // namespace

bool has_strokes(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const MeshInstance& i) { return has_strokes(scene.meshes[i.mesh]); });
}

std::vector<dvec3> ends_of_strokes(const Scene& scene) {
    std::vector<dvec3> ends;
    for (const MeshInstance& instance : scene.instances)
        for (const Primitive& p : scene.meshes[instance.mesh].primitives)
            for (const uvec2& stroke : p.strokes)
                for (int end = 0; end < (stroke.x == stroke.y ? 1 : 2); ++end)
                    ends.push_back(transform_point(instance.to_world, dvec3(p.positions[stroke[end]])));
    return ends;
}

void draw_strokes(Scene& scene, const View& view, unsigned height, double pixels) {
    scene.stroke_ends = ends_of_strokes(scene);
    const std::size_t placed = scene.instances.size();
    for (std::size_t i = 0; i < placed; ++i) {
        const MeshInstance instance = scene.instances[i];
        const Mesh& source = scene.meshes[instance.mesh];
        if (!has_strokes(source)) continue;
        const dvec3 centre = centre_of(source, instance.to_world);
        Mesh mesh{source.name, {}};
        for (const Primitive& p : source.primitives)
            if (!p.strokes.empty())
                mesh.primitives.push_back(Pen(p, instance.to_world, view, height, pixels, centre).draw());
        scene.instances.push_back(
            {instance.name, scene.meshes.size(), glm::translate(dmat4(1.0), centre), true});
        scene.meshes.push_back(std::move(mesh));
    }
    for (Mesh& mesh : scene.meshes)
        for (Primitive& p : mesh.primitives) p.strokes.clear();
}

}  // namespace triad
