// docs/recipes/ci/pictures.sh, as a runner runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "program.h"
#include "unit/temporary_folder.h"

namespace fs = std::filesystem;

namespace {

class PicturesRecipe : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    Outcome run(const std::string& arguments, const std::string& options = "--size 32x18 --spp 2") const {
        return run_program(
            TRIAD_SOURCE_DIR "/docs/recipes/ci/pictures.sh",
            "-f " + path("pictures") + " -r " + path("references") + " " + arguments + " -- " + options,
            "TRIAD='" TRIAD_PROGRAM "' GITHUB_STEP_SUMMARY=" + path("summary"));
    }

    triad::TemporaryFolder folder_;
    const std::string knot = TRIAD_SCENES "/suite/knot.glb", metals = TRIAD_SCENES "/suite/metals.glb";
};

}  // namespace

TEST_F(PicturesRecipe, keeps_references_and_then_compares_with_them) {
    const Outcome kept = run("-u " + knot + " " + metals);
    EXPECT_EQ(kept.exit, 0) << kept.output;
    EXPECT_TRUE(fs::exists(path("references/knot.exr")));
    const Outcome same = run(knot + " " + metals);
    EXPECT_EQ(same.exit, 0) << same.output;
    EXPECT_NE(same.output.find("| metals | 0.0 | 0.02 | same |"), std::string::npos) << same.output;
    EXPECT_FALSE(fs::exists(path("pictures/knot.difference.png")));
    EXPECT_NE(bytes_of(path("summary")).find("| knot | 0.0 |"), std::string::npos);
    // Another light is another picture.
    const Outcome other = run(knot + " " + metals, "--size 32x18 --spp 2 --look sky");
    EXPECT_EQ(other.exit, 7) << other.output;
    EXPECT_TRUE(fs::exists(path("pictures/knot.difference.png")));
    EXPECT_TRUE(fs::exists(path("pictures/metals.png")));
}

TEST_F(PicturesRecipe, tells_what_has_no_reference_or_cannot_be_rendered_and_goes_on) {
    EXPECT_EQ(run("-u " + knot).exit, 0);
    const Outcome missing = run(knot + " " + metals);
    EXPECT_EQ(missing.exit, 7) << missing.output;
    EXPECT_NE(missing.output.find("| metals |  | 0.02 | has no reference"), std::string::npos)
        << missing.output;
    std::ofstream(path("bad.gltf")) << "{";
    const Outcome bad = run(path("bad.gltf") + " " + knot);
    EXPECT_EQ(bad.exit, 2) << bad.output;
    EXPECT_NE(bad.output.find("| bad |  | 0.02 | not rendered"), std::string::npos) << bad.output;
    EXPECT_NE(bad.output.find("| knot | 0.0 | 0.02 | same |"), std::string::npos) << bad.output;
    EXPECT_EQ(run("").exit, 1) << "no scene";
}
