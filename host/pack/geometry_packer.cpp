#include "pack/geometry_packer.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "pack/refine.h"

namespace triad {
namespace {

std::uint32_t index32(std::size_t value) {
    if (value >= BVH_INDEX)
        throw Error(Exit::memory, "The scene has more vertices or triangles (" + std::to_string(value) +
                                      ") than 30-bit indices reach; split it or use instances.");
    return static_cast<std::uint32_t>(value);
}

void append(AlignedVector<float>& out, const vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); }

std::vector<dvec3> transformed(const Primitive& p, const dmat4& m) {
    std::vector<dvec3> position;
    position.reserve(p.positions.size());
    for (const vec3& v : p.positions) position.push_back(transform_point(m, dvec3(v)));
    return position;
}

}  // namespace

GeometryPacker::GeometryPacker(const Scene& scene, PackedScene& out, const std::optional<dvec3>& eye)
    : scene_(scene),
      out_(out),
      eye_(eye),
      reach_(glm::max(glm::abs(out.bounds.lo), glm::abs(out.bounds.hi))) {}

void GeometryPacker::add_placed(const Mesh& mesh, const dmat4& to_world, std::vector<BvhTriangle>& tree) {
    for (const Primitive& p : mesh.primitives) {
        std::vector<dvec3> position = transformed(p, to_world);
        const double reach = std::max({reach_.x, reach_.y, reach_.z});
        if (!eye_ || !needs_refining(p, position, *eye_, reach)) {
            add(p, share(p), position, to_world, tree);
            continue;
        }
        Primitive refined = p;
        refine(refined, position, *eye_, reach);
        detail("cut triangles that are large beside their distance to the eye: " +
               std::to_string(p.triangles.size()) + " became " + std::to_string(refined.triangles.size()));
        add(refined, store(refined), position, to_world, tree);
    }
}

void GeometryPacker::add_shared(const Mesh& mesh, std::vector<BvhTriangle>& tree) {
    for (const Primitive& p : mesh.primitives) add(p, share(p), transformed(p, dmat4(1.0)), dmat4(1.0), tree);
}

GeometryPacker::Shared GeometryPacker::store(const Primitive& p) {
    Shared at{{TRIAD_NONE, TRIAD_NONE}, TRIAD_NONE};
    for (int set = 0; set < 2; ++set)
        if (!p.uvs[set].empty()) {
            at.uv[set] = index32(out_.uvs.size() / 2);
            reserve_more(out_.uvs, 2 * p.uvs[set].size());
            for (const vec2& uv : p.uvs[set]) out_.uvs.insert(out_.uvs.end(), {uv.x, uv.y});
        }
    if (!p.colours.empty()) {
        at.colour = index32(out_.colours.size() / 4);
        reserve_more(out_.colours, 4 * p.colours.size());
        for (const vec4& c : p.colours) out_.colours.insert(out_.colours.end(), {c.x, c.y, c.z, c.w});
    }
    return at;
}

GeometryPacker::Shared GeometryPacker::share(const Primitive& p) {
    const auto it = shared_.find(&p);
    return it != shared_.end() ? it->second : shared_.emplace(&p, store(p)).first->second;
}

void GeometryPacker::add(const Primitive& p, const Shared& shared, const std::vector<dvec3>& position,
                         const dmat4& m, std::vector<BvhTriangle>& tree) {
    const dmat3 linear(m);
    const bool mirrored = glm::determinant(linear) < 0.0;
    dev::Geometry g{};
    g.first_triangle = index32(out_.triangles.size());
    g.material = static_cast<std::uint32_t>(p.material);
    g.normal = p.normals.empty() ? TRIAD_NONE : index32(out_.normals.size() / 3);
    g.tangent = p.tangents.empty() ? TRIAD_NONE : index32(out_.tangents.size() / 4);
    g.uv[0] = shared.uv[0], g.uv[1] = shared.uv[1];
    g.colour = shared.colour;
    g.first_light = TRIAD_NONE;
    g.touching = TRIAD_NONE;

    const dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
    reserve_more(out_.normals, 3 * p.normals.size());
    reserve_more(out_.tangents, 4 * p.tangents.size());
    for (const vec3& n : p.normals) append(out_.normals, vec3(glm::normalize(normal_matrix * dvec3(n))));
    for (const vec4& t : p.tangents) {
        append(out_.tangents, vec3(glm::normalize(linear * dvec3(vec3(t)))));
        out_.tangents.push_back(mirrored ? -t.w : t.w);
    }
    const Material& material = scene_.materials[p.material];
    const std::uint32_t geometry = index32(out_.geometries.size());
    for (const uvec3& t : p.triangles) {
        // Mirroring turns the winding around; swapping two corners keeps the front the front.
        const std::uint32_t corner[3] = {t.x, mirrored ? t.z : t.y, mirrored ? t.y : t.z};
        BvhTriangle b;
        for (int c = 0; c < 3; ++c) b.corner[c] = vec3(position[corner[c]]);
        b.primitive = index32(out_.triangles.size());
        b.geometry = geometry;
        b.opaque = material.alpha_mode == AlphaMode::opaque;
        tree.push_back(b);
        out_.triangles.push_back({{corner[0], corner[1], corner[2]}, geometry});
    }
    out_.geometries.push_back(g);
}

}  // namespace triad
