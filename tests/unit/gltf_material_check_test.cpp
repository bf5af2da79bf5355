// Malformed members of the extensions of materials are refused with a sentence that names them.
#include <gtest/gtest.h>

#include "gltf_extended_material.h"

namespace triad {
namespace {

using nlohmann::json;

TEST(GltfMaterialCheck, members_of_another_type_are_named) {
    const json factors = all_factors();
    for (const auto& [extension, members] : factors.items())
        for (const auto& [member, value] : members.items())
            for (const json& wrong :
                 {json("x"), json(nullptr), json(true), json({1, 2}), json({1, 2, "x"})}) {
                GltfBuilder b;
                json malformed = factors;
                malformed[extension][member] = wrong;
                const std::string sentence = with_extensions(b, malformed).refusal();
                EXPECT_NE(sentence.find(member), std::string::npos) << wrong << ": " << sentence;
            }
    for (const auto& [extension, member] : all_textures)
        for (const json& wrong :
             {json(0), json::object(), json({{"index", 1}}), json({{"index", 0.5}}),
              json({{"index", 0}, {"texCoord", "x"}}), json({{"index", 0}, {"scale", json::array()}}),
              json({{"index", 0}, {"extensions", {{"KHR_texture_transform", 1}}}})}) {
            GltfBuilder b;
            json malformed = factors;
            malformed[extension][member] = wrong;
            const std::string sentence = with_extensions(b, malformed).refusal();
            EXPECT_NE(sentence.find(member), std::string::npos) << wrong << ": " << sentence;
        }
}

TEST(GltfMaterialCheck, numbers_that_no_thickness_or_index_can_be_are_refused) {
    for (const char* member :
         {"iridescenceIor", "iridescenceThicknessMinimum", "iridescenceThicknessMaximum"}) {
        GltfBuilder b;
        const std::string sentence =
            with_extensions(b, {{"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {member, -1}}}})
                .refusal();
        EXPECT_NE(sentence.find(member), std::string::npos) << sentence;
    }
}

}  // namespace
}  // namespace triad
