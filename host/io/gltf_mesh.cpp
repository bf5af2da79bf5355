#include "io/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "io/gltf_accessor.h"
#include "io/gltf_variants.h"
#include "scene/tangents.h"

namespace triad::gltf {
namespace {

/// Corners of the triangles that a list, strip or fan of indices means (glTF 2.0, 3.7.2.1).
std::vector<uvec3> triangles_of(const std::vector<std::uint32_t>& indices, int mode) {
    std::vector<uvec3> triangles;
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(n / 3);
        for (std::size_t i = 0; i + 2 < n; i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    } else {
        for (std::size_t i = 0; i + 2 < n; ++i)
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
    }
    return triangles;
}

/// Ends of the lines that indices mean; points are lines without length.
std::vector<uvec2> strokes_of(const std::vector<std::uint32_t>& indices, int mode) {
    std::vector<uvec2> strokes;
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_POINTS) {
        for (const std::uint32_t i : indices) strokes.emplace_back(i, i);
    } else {
        for (std::size_t i = 0; i + 1 < n; i += mode == TINYGLTF_MODE_LINE ? 2 : 1)
            strokes.emplace_back(indices[i], indices[i + 1]);
        if (mode == TINYGLTF_MODE_LINE_LOOP && n > 1) strokes.emplace_back(indices[n - 1], indices[0]);
    }
    return strokes;
}

template <class Vector>
bool is_finite(const Vector& v) {
    for (int k = 0; k < Vector::length(); ++k)
        if (!std::isfinite(v[k])) return false;
    return true;
}

/// How many have a component that is no number or infinite.
template <class Vector>
std::size_t not_finite(const std::vector<Vector>& all) {
    return std::size_t(std::count_if(all.begin(), all.end(), [](const Vector& v) { return !is_finite(v); }));
}

/// Unit normals; a normal without length or with a NaN becomes that of the triangles around its vertex.
/// Returns how many have no length.
std::size_t normalise(std::vector<vec3>& normals, const Primitive& primitive) {
    const auto is_good = [](const vec3& n) {
        return glm::dot(n, n) > 1e-12f && std::isfinite(glm::dot(n, n));
    };
    bool all_good = true;
    std::size_t without_length = 0;
    for (vec3& n : normals) {
        if (is_good(n)) {
            n = glm::normalize(n);
            continue;
        }
        without_length += is_finite(n);
        n = vec3(0.0f), all_good = false;
    }
    if (all_good) return 0;
    std::vector<dvec3> around(normals.size(), dvec3(0.0));
    for (const uvec3& t : primitive.triangles) {
        const dvec3 a = primitive.positions[t.x], b = primitive.positions[t.y], c = primitive.positions[t.z];
        const dvec3 n = glm::cross(b - a, c - a);
        for (int k = 0; k < 3; ++k) around[t[k]] += n;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (normals[i] != vec3(0.0f)) continue;
        const double length = glm::length(around[i]);
        normals[i] =
            length > 0.0 && std::isfinite(length) ? vec3(around[i] / length) : vec3(0.0f, 0.0f, 1.0f);
    }
    return without_length;
}

/// Unit tangents with a sign; false when one of them has no direction.
bool normalise(std::vector<vec4>& tangents) {
    for (vec4& t : tangents) {
        const float length = glm::length(vec3(t));
        if (!(length > 1e-6f) || !std::isfinite(length)) return false;
        t = vec4(vec3(t) / length, t.w < 0.0f ? -1.0f : 1.0f);
    }
    return true;
}

std::vector<vec2> transformed(const std::vector<vec2>& uvs, const TextureUse& use) {
    const auto& m = use.transform;
    std::vector<vec2> result;
    result.reserve(uvs.size());
    for (const vec2& uv : uvs)
        result.emplace_back(m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]);
    return result;
}

/// A primitive of the file while it is read.
struct Source {
    File& file;
    const tinygltf::Primitive& primitive;
    const std::string& what;  ///< for messages
    std::size_t count = 0;    ///< of vertices

    /// Its accessor; -1: there is none.
    int attribute(const std::string& name) const {
        const auto found = primitive.attributes.find(name);
        return found == primitive.attributes.end() ? -1 : found->second;
    }
    const tinygltf::Accessor& accessor(int index) const { return file.model.accessors[std::size_t(index)]; }

    /// That so many of the elements are damaged, and what becomes of them.
    void tell(std::size_t faulty, const std::string& name, const char* fault, const char* instead) const {
        if (faulty > 0)
            file.fault(what + ": " + name + " (accessor " + std::to_string(attribute(name)) + ") has " +
                       std::to_string(faulty) + " of " + std::to_string(count) + " elements " + fault + "; " +
                       instead + ".");
    }
};

constexpr const char* no_numbers = "that are no finite numbers";

void require_equal_counts(const Source& source) {
    for (const auto& [name, accessor] : source.primitive.attributes)
        if (const std::size_t count = source.accessor(accessor).count; count != source.count)
            throw Error(Exit::scene, source.what + ": " + name + " (accessor " + std::to_string(accessor) +
                                         ") has " + std::to_string(count) + " elements but POSITION has " +
                                         std::to_string(source.count) + ".");
}

/// Every vertex once where the file has none.
std::vector<std::uint32_t> indices_of(const Source& source) {
    std::vector<std::uint32_t> indices;
    if (source.primitive.indices < 0) {
        source.file.charge(source.count * sizeof(std::uint32_t), source.what);
        indices.resize(source.count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    indices = read_indices(source.file, source.primitive.indices, source.what + ": indices");
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] >= source.count)
            throw Error(Exit::scene, source.what + ": index " + std::to_string(i) + " is " +
                                         std::to_string(indices[i]) + " but there are " +
                                         std::to_string(source.count) + " vertices.");
    return indices;
}

/// Triangles or strokes.
void read_shape(const Source& source, int mode, Primitive& p) {
    const std::vector<std::uint32_t> indices = indices_of(source);
    source.file.charge(indices.size() * (mode == TINYGLTF_MODE_TRIANGLES ? 1 : 3) * sizeof(std::uint32_t),
                       source.what);
    if (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
        source.file.warn(source.what + " has " + std::to_string(indices.size()) +
                         " corners, no multiple of 3; the last are left out.");
    if (mode >= TINYGLTF_MODE_TRIANGLES)
        p.triangles = triangles_of(indices, mode);
    else
        p.strokes = strokes_of(indices, mode);
}

/// As they are in the file: settle_directions() makes them unit vectors.
void read_directions(const Source& source, bool with_tangents, Primitive& p) {
    if (const int normals = source.attribute("NORMAL"); normals >= 0) {
        p.normals = read_vec3(source.file, normals, Integers::quantised, source.what + ": NORMAL");
        source.tell(not_finite(p.normals), "NORMAL", no_numbers, "they become those of the triangles around");
    }
    if (const int tangents = source.attribute("TANGENT");
        tangents >= 0 && !p.normals.empty() && with_tangents)
        p.tangents = read_vec4(source.file, tangents, Integers::quantised, source.what + ": TANGENT");
}

void read_uvs(const Source& source, Primitive& p) {
    for (const auto& [name, accessor] : source.primitive.attributes)
        if (name.starts_with("TEXCOORD_") && name != "TEXCOORD_0" && name != "TEXCOORD_1")
            source.file.warn(source.what + " has the attribute " + name.substr(0, 40) +
                             "; only TEXCOORD_0 and 1 are used.");
    for (int set = 0; set < 2; ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(set);
        const int accessor = source.attribute(name);
        if (accessor < 0) continue;
        const Integers integers = source.file.quantised ? Integers::quantised : Integers::normalised;
        p.uvs[set] = read_vec2(source.file, accessor, integers, source.what + ": " + name);
        source.tell(not_finite(p.uvs[set]), name, no_numbers, "they become 0");
        for (vec2& uv : p.uvs[set])
            if (!is_finite(uv)) uv = vec2(0.0f);
    }
}

void read_colours(const Source& source, Primitive& p) {
    const int colours = source.attribute("COLOR_0");
    if (colours < 0) return;
    const std::string name = source.what + ": COLOR_0";
    if (source.accessor(colours).type == TINYGLTF_TYPE_VEC3) {
        for (const vec3& c : read_vec3(source.file, colours, Integers::normalised, name))
            p.colours.emplace_back(c, 1.0f);
    } else {
        p.colours = read_vec4(source.file, colours, Integers::normalised, name);
    }
    source.tell(not_finite(p.colours), "COLOR_0", no_numbers, "they become 0 or 1");
    for (vec4& c : p.colours)
        for (int k = 0; k < 4; ++k) c[k] = c[k] >= 0.0f ? std::min(c[k], 1.0f) : 0.0f;  // a NaN becomes 0
}

/// Along whose UVs the tangents of a material run, the most telling first; empty: it needs none. (There is
/// one frame for each vertex: what uses other UVs beside them is turned.)
std::vector<TextureUse> tangent_uvs(const Material& m) {
    std::vector<TextureUse> uses;
    if (m.normal_texture) uses.push_back(*m.normal_texture);
    if (m.anisotropy) uses.push_back(m.anisotropy->texture.value_or(TextureUse{}));
    if (m.clearcoat && m.clearcoat->normal_texture) uses.push_back(*m.clearcoat->normal_texture);
    return uses;
}

/// Unit normals and tangents, once the primitive is posed; tangents are made where the material lacks them.
void settle_directions(const Source& source, const std::vector<TextureUse>& uses, Primitive& p) {
    if (!p.normals.empty())
        source.tell(normalise(p.normals, p), "NORMAL", "without length",
                    "they become those of the triangles around");
    if (!normalise(p.tangents)) {
        source.file.fault(source.what + ": TANGENT (accessor " + std::to_string(source.attribute("TANGENT")) +
                          ") has elements without direction; all are computed anew.");
        p.tangents.clear();
    }
    const auto use =
        std::find_if(uses.begin(), uses.end(), [&](const TextureUse& u) { return !p.uvs[u.uv_set].empty(); });
    if (use == uses.end() || !p.tangents.empty()) return;
    if (p.normals.empty()) {
        source.file.charge(p.triangles.size() * 256, source.what);
        make_flat(p);
    }
    generate_tangents(p, transformed(p.uvs[use->uv_set], *use));
}

}  // namespace

std::size_t Meshes::use(int index, int skin, const Deformation& deformation) {
    const auto [found, is_new] =
        meshes_.try_emplace({index, skin, deformation.weights}, scene_.meshes.size());
    if (!is_new) return found->second;
    const tinygltf::Mesh& source = file_.model.meshes[std::size_t(index)];
    Mesh mesh;
    mesh.name = source.name;
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        const std::string what =
            label("mesh", std::size_t(index), source.name) + ", primitive " + std::to_string(i);
        if (auto primitive = convert(source.primitives[i], deformation, what))
            mesh.primitives.push_back(std::move(*primitive));
    }
    scene_.meshes.push_back(std::move(mesh));
    return found->second;
}

std::optional<Primitive> Meshes::convert(const tinygltf::Primitive& primitive, const Deformation& deformation,
                                         const std::string& what) {
    Source source{file_, primitive, what};
    const int positions = source.attribute("POSITION");
    if (positions < 0) {
        file_.warn(what + " has no POSITION; it is left out.");
        return std::nullopt;
    }
    source.count = source.accessor(positions).count;
    require_equal_counts(source);

    Primitive p;
    p.positions = read_vec3(file_, positions, Integers::quantised, what + ": POSITION");
    source.tell(not_finite(p.positions), "POSITION", no_numbers, "triangles at them are left out");
    if (source.count >= 0xffffffffu) throw Error(Exit::scene, what + " has too many vertices.");

    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    read_shape(source, mode, p);
    const int material = material_of(primitive, variant_);
    p.material = mode >= TINYGLTF_MODE_TRIANGLES
                     ? materials_.use(material)
                     : materials_.use_for_strokes(material, source.attribute("NORMAL") >= 0);
    const std::vector<TextureUse> uses = tangent_uvs(scene_.materials[p.material]);
    read_directions(source, !uses.empty(), p);
    read_uvs(source, p);
    read_colours(source, p);
    if (deformation.skin || !primitive.targets.empty()) deform(file_, primitive, deformation, p, what);
    settle_directions(source, uses, p);
    return p;
}

}  // namespace triad::gltf
