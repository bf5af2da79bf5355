// Bodies that share a face know of each other.
#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/types.h"
#include "pack/pack.h"
#include "scene/shapes.h"

namespace triad {
namespace {

Material wax() {
    Material m;
    m.metallic = 0.0f;
    m.specular = 0.0f;
    m.thickness = 1.0f;
    m.diffuse_transmission = DiffuseTransmission{.factor = 0.5f};
    return m;
}

Material glass() {
    Material m;
    m.metallic = 0.0f;
    m.thickness = 1.0f;
    m.transmission = 1.0f;
    return m;
}

/// Geometries that know the body on their other side, where two boxes share a face.
std::size_t touching(const Material& lower, const Material& upper) {
    Scene scene;
    for (const Material& m : {lower, upper}) {
        const float y = float(scene.meshes.size());
        Primitive box = shapes::box({0, y, 0}, {1, y + 1, 1});
        box.material = scene.materials.size();
        scene.materials.push_back(m);
        scene.meshes.push_back({"box", {std::move(box)}});
        scene.instances.push_back({"node", scene.meshes.size() - 1, dmat4(1.0)});
    }
    validate(scene);
    const PackedScene packed = pack(scene, RenderSettings{});
    return std::size_t(std::count_if(packed.geometries.begin(), packed.geometries.end(),
                                     [](const dev::Geometry& g) { return g.touching != TRIAD_NONE; }));
}

TEST(Touching, bodies_of_one_kind_share_a_face_whether_they_refract_or_scatter) {
    EXPECT_EQ(touching(glass(), glass()), 1u);
    EXPECT_EQ(touching(wax(), wax()), 1u);
}

TEST(Touching, one_that_refracts_and_one_that_scatters_do_not) {
    EXPECT_EQ(touching(glass(), wax()), 0u);
    EXPECT_EQ(touching(wax(), glass()), 0u);
}

TEST(Touching, what_is_no_body_has_no_other_side) {
    Material sheet = wax(), lamp = glass();
    sheet.thickness = 0.0f;
    lamp.emission = vec3(1.0f);
    EXPECT_EQ(touching(sheet, sheet), 0u);
    EXPECT_EQ(touching(lamp, glass()), 0u);
}

}  // namespace
}  // namespace triad
