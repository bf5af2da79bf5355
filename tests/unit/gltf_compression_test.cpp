// Compressed geometry: what encoders write is read back, and what is damaged is refused or replaced.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "gltf_builder.h"

namespace triad {
namespace {

using nlohmann::json;

using Raw = std::vector<std::uint8_t>;

template <class T>
Raw meshopt_vertices(const std::vector<T>& values, std::size_t stride) {
    const std::size_t count = values.size() * sizeof(T) / stride;
    Raw bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
    return bytes;
}

/// A view of `count` elements whose own buffer has no data: they are compressed in buffer 0.
std::size_t compressed_view(GltfBuilder& b, const Raw& bytes, std::size_t count, std::size_t stride,
                            const char* mode, const char* name = "EXT_meshopt_compression") {
    const std::size_t source = b.view(bytes);
    const json from = b.document["bufferViews"][source];
    json view{{"buffer", 1}, {"byteLength", count * stride}};
    view["extensions"][name] = {{"buffer", 0},
                                {"byteOffset", from["byteOffset"]},
                                {"byteLength", bytes.size()},
                                {"byteStride", stride},
                                {"count", count},
                                {"mode", mode}};
    b.document["bufferViews"].push_back(view);
    return b.document["bufferViews"].size() - 1;
}

/// A quad of which everything is compressed.
void meshopt_quad(GltfBuilder& b, const char* name = "EXT_meshopt_compression") {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    Raw triangles(meshopt_encodeIndexBufferBound(indices.size(), 4));
    triangles.resize(
        meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size()));
    b.document["accessors"] = {
        {{"bufferView", compressed_view(b, meshopt_vertices(corners, 12), 4, 12, "ATTRIBUTES", name)},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"}},
        {{"bufferView", compressed_view(b, triangles, 6, 2, "TRIANGLES", name)},
         {"componentType", 5123},
         {"count", 6},
         {"type", "SCALAR"}}};
    b.primitive()["attributes"]["POSITION"] = 0;
    b.primitive()["indices"] = 1;
    b.document["extensionsRequired"] = {name};
}

json& extension_of_view(GltfBuilder& b, std::size_t accessor, const char* name = "EXT_meshopt_compression") {
    return b.document["bufferViews"][b.document["accessors"][accessor]["bufferView"].get<std::size_t>()]
                     ["extensions"][name];
}

/// Buffer 0 in a file, buffer 1 without data.
Scene load_compressed(GltfBuilder& b) {
    std::ofstream((b.folder / "data.bin").string(), std::ios::binary)
        .write(reinterpret_cast<const char*>(b.bytes.data()), std::streamsize(b.bytes.size()));
    b.document["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", "data.bin"}}, {{"byteLength", 4096}}};
    return b.load_text(b.document.dump());
}

std::string refusal_of(GltfBuilder& b, Exit expected) {
    try {
        load_compressed(b);
        return "no error";
    } catch (const Error& error) {
        return (error.exit() == expected ? "" : "another exit code: ") + std::string(error.what());
    }
}

void expect_quad(const Scene& scene) {
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    ASSERT_EQ(p.triangles.size(), 2u);
    double area = 0;
    for (const uvec3& t : p.triangles)
        area += 0.5 * glm::cross(p.positions[t.y] - p.positions[t.x], p.positions[t.z] - p.positions[t.x]).z;
    EXPECT_EQ(area, 1);
}

TEST(GltfMeshopt, attributes_and_triangles_are_read_under_both_names) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        GltfBuilder b;
        meshopt_quad(b, name);
        expect_quad(load_compressed(b));
    }
}

TEST(GltfMeshopt, filters_give_unit_vectors_and_powers_of_two) {
    GltfBuilder b;
    meshopt_quad(b);
    // (x, y) on the octahedron, the third number is one: (0, 0, 1), (1, 0, 0), (0, -1, 0) and between.
    const std::vector<std::int8_t> normals{0, 0, 127, 0, 127, 0, 127, 0, 0, -127, 127, 0, 64, 64, 127, 0};
    const std::size_t view = compressed_view(b, meshopt_vertices(normals, 4), 4, 4, "ATTRIBUTES");
    b.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["filter"] = "OCTAHEDRAL";
    b.document["bufferViews"][view]["byteStride"] = 4;
    b.document["accessors"].push_back({{"bufferView", view},
                                       {"componentType", 5120},
                                       {"normalized", true},
                                       {"count", 4},
                                       {"type", "VEC3"}});
    // Eight bits of exponent above 24 of mantissa.
    const auto power = [](int exponent, std::uint32_t mantissa) {
        return std::uint32_t(exponent) << 24 | mantissa;
    };
    const std::vector<std::uint32_t> uvs{power(-1, 1), power(0, 3), power(1, 1), power(-2, 0xffffff),
                                         power(0, 0),  power(0, 0), power(3, 1), power(-8, 256)};
    const std::size_t uv = compressed_view(b, meshopt_vertices(uvs, 8), 4, 8, "ATTRIBUTES");
    b.document["bufferViews"][uv]["extensions"]["EXT_meshopt_compression"]["filter"] = "EXPONENTIAL";
    b.document["accessors"].push_back(
        {{"bufferView", uv}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    b.primitive()["attributes"]["NORMAL"] = 2;
    b.primitive()["attributes"]["TEXCOORD_0"] = 3;
    b.document["extensionsUsed"] = {"KHR_mesh_quantization"};
    const Scene scene = load_compressed(b);
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    const vec3 wanted[] = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(p.normals.at(i) - wanted[i]), 0.01f) << i;
    EXPECT_EQ(p.uvs[0], (std::vector<vec2>{{0.5f, 3}, {2, -0.25f}, {0, 0}, {8, 1}}));
}

TEST(GltfMeshopt, what_is_damaged_or_does_not_fit_is_refused) {
    const auto refused = [](const auto& change) {
        GltfBuilder b;
        meshopt_quad(b);
        change(b);
        return refusal_of(b, Exit::scene);
    };
    EXPECT_NE(refused([](GltfBuilder& b) { extension_of_view(b, 0)["byteLength"] = 9; }).find("damaged"),
              std::string::npos);
    EXPECT_NE(
        refused([](GltfBuilder& b) { extension_of_view(b, 0)["byteLength"] = 1 << 20; }).find("which has"),
        std::string::npos);
    EXPECT_NE(refused([](GltfBuilder& b) { extension_of_view(b, 0)["count"] = 1 << 30; }).find("decodes to"),
              std::string::npos);
    EXPECT_NE(refused([](GltfBuilder& b) { extension_of_view(b, 0)["byteStride"] = 3; }).find("byteStride"),
              std::string::npos);
    EXPECT_NE(refused([](GltfBuilder& b) { extension_of_view(b, 1)["count"] = 5; }).find("multiple of three"),
              std::string::npos);
    EXPECT_NE(refused([](GltfBuilder& b) { extension_of_view(b, 1)["mode"] = "LINES"; }).find("unknown mode"),
              std::string::npos);
}

TEST(GltfMeshopt, a_later_version_is_refused_by_its_number_unless_there_is_a_fallback) {
    GltfBuilder b;
    meshopt_quad(b, "KHR_meshopt_compression");
    b.bytes[extension_of_view(b, 0, "KHR_meshopt_compression")["byteOffset"].get<std::size_t>()] = 0xa1;
    EXPECT_NE(refusal_of(b, Exit::unsupported).find("version 1"), std::string::npos)
        << refusal_of(b, Exit::unsupported);
    const std::size_t plain = b.view(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    json& view = b.document["bufferViews"][b.document["accessors"][0]["bufferView"].get<std::size_t>()];
    view["buffer"] = 0;
    view["byteOffset"] = b.document["bufferViews"][plain]["byteOffset"];
    expect_quad(load_compressed(b));
    EXPECT_TRUE(b.warned("uncompressed data are used"));
}

/// A triangle with normals, as Draco has it.
Raw draco_triangle() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(1);
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, normal[3] = {0, 0, 1};
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
              upright = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
    builder.SetAttributeValuesForFace(upright, draco::FaceIndex(0), normal, normal, normal);
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// Its accessors have no views.
void with_draco(GltfBuilder& b, const Raw& bytes) {
    const json vertices{{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
    b.document["accessors"] = {
        vertices, vertices, {{"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}}};
    b.primitive() = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}};
    b.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", b.view(bytes)}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
    b.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
}

TEST(GltfDraco, positions_normals_and_triangles_are_read) {
    GltfBuilder b;
    with_draco(b, draco_triangle());
    const Scene scene = b.load();
    const Primitive& p = scene.meshes.at(0).primitives.at(0);
    ASSERT_EQ(p.triangles.size(), 1u);
    const uvec3 t = p.triangles[0];
    const vec3 front = glm::cross(p.positions[t.y] - p.positions[t.x], p.positions[t.z] - p.positions[t.x]);
    EXPECT_LT(glm::length(front - vec3(0, 0, 1)), 1e-3f);
    for (const vec3& n : p.normals) EXPECT_LT(glm::length(n - vec3(0, 0, 1)), 1e-2f);
}

TEST(GltfDraco, no_damage_of_the_data_does_more_than_end_in_a_sentence) {
    const Raw whole = draco_triangle();
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const std::uint8_t bits : {0x01, 0x80, 0xff}) {
            Raw bytes = whole;
            bytes[i] = std::uint8_t(bytes[i] ^ bits);
            GltfBuilder b;
            with_draco(b, bytes);
            try {
                b.load();
            } catch (const Error& error) {
                EXPECT_EQ(error.exit(), Exit::scene) << error.what();
            }
        }
    GltfBuilder b;
    with_draco(b, Raw(whole.begin(), whole.begin() + long(whole.size() / 2)));
    EXPECT_NE(b.refusal().find("KHR_draco_mesh_compression is damaged"), std::string::npos) << b.refusal();
}

TEST(GltfDraco, damaged_data_are_replaced_by_what_is_not_compressed) {
    GltfBuilder b;
    with_draco(b, {1, 2, 3, 4});
    b.document["accessors"] = json::array();
    b.triangle();
    b.primitive()["attributes"].erase("NORMAL");
    b.primitive().erase("indices");
    b.document.erase("extensionsRequired");
    EXPECT_EQ(b.load().meshes.at(0).primitives.at(0).triangles.size(), 1u);
    EXPECT_TRUE(b.warned("uncompressed data are used"));
}

TEST(GltfDraco, an_attribute_that_is_not_there_is_refused_by_name) {
    GltfBuilder b;
    with_draco(b, draco_triangle());
    b.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"] = 7;
    EXPECT_NE(b.refusal().find("NORMAL is not in the compressed data"), std::string::npos) << b.refusal();
}

}  // namespace
}  // namespace triad
