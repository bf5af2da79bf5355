#include "pack/touching.h"

#include <algorithm>
#include <array>
#include <map>

namespace triad {
namespace {

/// Bodies of one kind share a face: of two that scatter, what the second absorbs begins there. Where one that
/// refracts meets one that only scatters, the face that is kept could lose what the other does.
enum class Body { none, refracts, scatters };

Body body_of(const Material& m) {
    if (!is_solid(m) || m.unlit || m.emission != vec3(0.0f)) return Body::none;
    return m.transmission > 0.0f ? Body::refracts : Body::scatters;
}

/// A triangle by its corners, whatever comes first.
struct Face {
    std::array<std::array<float, 3>, 3> corners;
    std::size_t index;  ///< into `flat`
    bool turned;        ///< the order of the corners as they were is an odd permutation of that of `corners`

    Face(const BvhTriangle& t, std::size_t i) : index(i), turned(false) {
        for (std::size_t c = 0; c < 3; ++c)
            for (int a = 0; a < 3; ++a) corners[c][std::size_t(a)] = t.corner[c][a] + 0.0f;  // -0 becomes 0
        const auto order = [&](std::size_t a, std::size_t b) {
            if (corners[b] < corners[a]) std::swap(corners[a], corners[b]), turned = !turned;
        };
        order(0, 1), order(1, 2), order(0, 1);
    }
    bool operator<(const Face& other) const {
        return corners != other.corners ? corners < other.corners : index < other.index;
    }
};

}  // namespace

void note_touching(const Scene& scene, PackedScene& packed, std::vector<BvhTriangle>& flat) {
    const auto kind = [&](const dev::Geometry& g) { return body_of(scene.materials[g.material]); };
    const auto of_body = [&](const dev::Geometry& g) { return kind(g) != Body::none; };
    const auto kind_at = [&](const Face& f) { return kind(packed.geometries[flat[f.index].geometry]); };
    if (std::count_if(packed.geometries.begin(), packed.geometries.end(), of_body) < 2) return;
    std::vector<Face> faces;
    for (std::size_t i = 0; i < flat.size(); ++i)
        if (of_body(packed.geometries[flat[i].geometry])) faces.emplace_back(flat[i], i);
    std::sort(faces.begin(), faces.end());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
        copies;  // geometry and material: the copy
    for (std::size_t i = 0, next; i < faces.size(); i = next) {
        for (next = i + 1; next < faces.size() && faces[next].corners == faces[i].corners; ++next) {
        }
        const auto facing = std::find_if(
            faces.begin() + std::ptrdiff_t(i), faces.begin() + std::ptrdiff_t(next),
            [&](const Face& f) { return f.turned != faces[i].turned && kind_at(f) == kind_at(faces[i]); });
        if (facing == faces.begin() + std::ptrdiff_t(next)) continue;
        BvhTriangle& kept = flat[faces[i].index];
        const std::uint32_t material = packed.geometries[flat[facing->index].geometry].material;
        const auto [copy, fresh] = copies.try_emplace({kept.geometry, material},
                                                      static_cast<std::uint32_t>(packed.geometries.size()));
        if (fresh) {
            packed.geometries.push_back(packed.geometries[kept.geometry]);
            packed.geometries.back().touching = material;
        }
        kept.geometry = packed.triangles[kept.primitive].geometry = copy->second;
    }
}

}  // namespace triad
