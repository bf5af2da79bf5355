// The list of extensions: what the loader does, what is told, and what docs/extensions.md says.
#include "io/gltf_extensions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "gltf_builder.h"
#include "io/gltf_contents.h"

namespace triad {
namespace {

TEST(GltfExtensions, docs_say_of_each_what_the_list_says) {
    std::string table;
    for (const GltfExtension& e : gltf_extensions())
        table += std::string("| ") + e.name + " | " + words_for(e.treatment, false) + " | " + e.how + " |\n";
    std::ifstream file(TRIAD_SOURCE_DIR "/docs/extensions.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find("|---|---|---|\n" + table + "\n"), std::string::npos)
        << "the table of docs/extensions.md must be:\n"
        << table;
}

TEST(GltfExtensions, are_sorted_so_that_none_is_there_twice) {
    const auto list = gltf_extensions();
    for (std::size_t i = 1; i < list.size(); ++i) EXPECT_LT(std::string(list[i - 1].name), list[i].name);
}

TEST(GltfExtensions, the_loader_keeps_to_the_list) {
    for (const GltfExtension& e : gltf_extensions()) {
        GltfBuilder b;
        b.triangle().document["extensionsUsed"] = {e.name};
        b.load();
        EXPECT_EQ(b.warned(e.name), e.treatment == Treatment::left_out) << e.name;
        b.document["extensionsRequired"] = {e.name};
        EXPECT_EQ(b.refusal(Exit::unsupported).empty(), e.treatment != Treatment::left_out) << e.name;
    }
}

TEST(GltfContents, counts_all_that_a_file_holds_even_where_it_is_refused) {
    GltfBuilder b;
    b.triangle();
    b.document["accessors"][0]["max"] = {1, 1, 0};
    b.primitive()["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
    b.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    const auto times = b.accessor(std::vector<float>{0, 2.5f}, "SCALAR");
    b.document["accessors"][times]["max"] = {2.5};
    const auto moves = b.accessor(std::vector<float>{0, 0, 0, 1, 0, 0}, "VEC3");
    b.document["animations"] = {
        {{"name", "walk"},
         {"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    b.document["nodes"].push_back(
        {{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}}}}});
    b.document["skins"] = {{{"joints", {0, 1}}}};
    b.document["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "hot"}}};
    b.document["extensionsRequired"] = {"FAKE_extension"};
    EXPECT_NE(b.refusal(Exit::unsupported), "");
    const GltfContents c = gltf_contents(b.folder / "scene.gltf");
    EXPECT_EQ(c.triangles, 1u);
    EXPECT_EQ(c.primitives, (std::map<std::string, std::size_t>{{"triangles", 1}, {"points", 1}}));
    EXPECT_EQ(c.morph_targets, 2u);
    EXPECT_EQ(c.instances, 3u);
    ASSERT_EQ(c.animations.size(), 1u);
    EXPECT_EQ(c.animations[0].name, "walk");
    EXPECT_EQ(c.animations[0].seconds, 2.5);
    EXPECT_EQ(c.skins.at(0).joints, 2u);
    EXPECT_EQ(c.variants, std::vector<std::string>{"hot"});
    EXPECT_EQ(c.extensions_required, std::vector<std::string>{"FAKE_extension"});
}

}  // namespace
}  // namespace triad
