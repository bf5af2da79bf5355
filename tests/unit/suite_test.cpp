// The default suite: everything is there, reads without a warning, and stays small.
#include "cli/suite.h"

#include <gtest/gtest.h>

#include <set>

#include "base/child_process.h"
#include "cli/experiment.h"
#include "io/io.h"

namespace triad {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(TRIAD_SOURCE_DIR) / "scenes";

TEST(Suite, TenScenesWithOptionsThatRenderKnows) {
    const auto scenes = suite_scenes(folder);
    EXPECT_EQ(scenes.size(), 10u);
    std::set<std::string> names;
    for (const NamedOptions& scene : scenes) {
        names.insert(scene.name);
        EXPECT_NO_THROW(render_options({}, scene, {"default", {}})) << scene.name;
        ASSERT_TRUE(suite_baselines().contains(scene.name)) << scene.name;
        EXPECT_GT(suite_baselines().at(scene.name), 0) << scene.name;
        // What the bench makes of it again from its text.
        EXPECT_EQ(parse_setting(scene.name + ": " + scene.text()).arguments, scene.arguments);
    }
    EXPECT_EQ(names.size(), suite_baselines().size());
}

TEST(Suite, FilesReadWithoutWarningsAndHaveOneCamera) {
    for (const NamedOptions& scene : suite_scenes(folder)) {
        const RenderRequest options = render_options({}, scene, {"default", {}});
        if (options.scene_path.empty()) continue;
        GltfReport report;
        Scene loaded = load_gltf(options.scene_path, {}, &report);
        EXPECT_TRUE(report.warnings.empty()) << scene.name << ": " << report.warnings.front();
        EXPECT_EQ(validate(loaded), 0u) << scene.name;
        EXPECT_EQ(loaded.cameras.size(), 1u) << scene.name;
        EXPECT_LT(fs::file_size(options.scene_path), 150'000u) << scene.name;
        if (!options.env_path.empty()) {
            EXPECT_NO_THROW(load_environment(options.env_path)) << scene.name;
        }
    }
}

TEST(Suite, FilesAreWhatTheGeneratorWrites) {
    const triad::TemporaryFolder made;
    const auto status =
        run_program({"/usr/bin/python3", (folder / "suite" / "generate.py").string(), made.path().string()},
                    made.path() / "out", made.path() / "log");
    if (status != 0) GTEST_SKIP() << "python3 with numpy is not installed (Debian: python3-numpy)";
    for (const NamedOptions& scene : suite_scenes(folder)) {
        const RenderRequest options = render_options({}, scene, {"default", {}});
        const fs::path file = fs::path(options.scene_path).filename();
        if (options.scene_path.empty() || file == "cornell.gltf") continue;
        // Sines may differ in their last bit between machines: what is built of them, not.
        const Scene a = load_gltf(options.scene_path), b = load_gltf(made.path() / file);
        ASSERT_EQ(a.meshes.size(), b.meshes.size()) << file;
        for (std::size_t m = 0; m < a.meshes.size(); ++m)
            for (std::size_t p = 0; p < a.meshes[m].primitives.size(); ++p) {
                const auto &x = a.meshes[m].primitives[p].positions, &y = b.meshes[m].primitives[p].positions;
                ASSERT_EQ(x.size(), y.size()) << file;
                for (std::size_t i = 0; i < x.size(); ++i) ASSERT_LT(glm::length(x[i] - y[i]), 1e-5f) << file;
            }
    }
}

}  // namespace
}  // namespace triad
