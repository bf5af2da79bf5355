// Other people's models through the whole program: every file of these folders gives a picture, or says that
// there is nothing to render. What the pictures show, and what looks wrong: docs/assets.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "../program.h"
#include "../unit/temporary_folder.h"
#include "../unit/test_assets.h"
#include "io/io.h"

namespace fs = std::filesystem;

namespace {

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

std::vector<fs::path> models_in(const fs::path& folder) {
    std::vector<fs::path> models;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (const fs::path extension = entry.path().extension();
            (extension == ".gltf" || extension == ".glb") &&
            !fs::relative(entry.path(), folder).begin()->string().starts_with("malformed"))
            models.push_back(entry.path());
    std::sort(models.begin(), models.end());
    return models;
}

/// What a picture without its background shows.
struct Seen {
    double covered = 0;          ///< share of the pixels with an alpha of at least a half
    double least = 0, most = 0;  ///< sum of the channels over those
    bool finite = true;
};

Seen look_at(const triad::Picture& picture) {
    Seen seen;
    const auto& alpha = picture.find("A")->values;
    seen.least = INFINITY;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        double sum = 0;
        for (const char* name : {"R", "G", "B"}) sum += picture.find(name)->values[i];
        seen.finite = seen.finite && std::isfinite(sum);
        if (alpha[i] < 0.5f) continue;
        seen.covered += 1.0 / double(alpha.size());
        seen.least = std::min(seen.least, sum), seen.most = std::max(seen.most, sum);
    }
    return seen;
}

}  // namespace

TEST(Assets, every_model_renders_or_has_nothing_to_render) {
    const fs::path assets = test_assets();
    if (!fs::exists(assets / "core")) GTEST_SKIP() << "no assets in " << assets;
    const TemporaryFolder folder;
    std::set<std::string> empty;
    std::map<std::string, std::string> refused;
    std::size_t models = 0;
    for (const fs::path& model : models_in(assets)) {
        SCOPED_TRACE(model.string());
        ++models;
        const Outcome outcome = run_triad(
            "render " + quoted(model) + " -o " + quoted(folder / "picture.exr") + " --json " +
            quoted(folder / "row.json") + " --env " + quoted(assets / "env" / "venice_sunset_256.hdr") +
            " --background transparent --size 64x64 --spp 4");
        if (outcome.exit == 2 && outcome.output.find("nothing to render") != std::string::npos) {
            empty.insert(model.stem().string());
            continue;
        }
        if (outcome.exit == 3) {
            refused[model.stem().string()] = outcome.output;
            continue;
        }
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        if (outcome.exit != 0) continue;
        const auto row = nlohmann::json::parse(std::ifstream(folder / "row.json"))["rows"][0];
        EXPECT_EQ(row["spp"], 4);
        EXPECT_EQ(row["not_finite"], 0);
        EXPECT_EQ(row["saturated"], 0);
        const Seen seen = look_at(triad::read_picture(folder / "picture.exr"));
        EXPECT_TRUE(seen.finite);
        if (model.stem() == "Material_AlphaMask_03") {  // a cutoff of 1.1
            EXPECT_EQ(seen.covered, 0);
            continue;
        }
        EXPECT_GT(seen.covered, 0.01) << "nothing is in view";
        // Noise alone makes lit surfaces uneven; black would be even. The one cube that is black still
        // reflects.
        EXPECT_GT(seen.most, 0.0) << "all black";
        EXPECT_GT(seen.most, seen.least) << "all one colour";
    }
    EXPECT_GE(models, 181u);
    for (const auto& [model, cause] :
         std::map<std::string, std::string>{{"CesiumBalloonKTX2", "KHR_texture_basisu"},
                                            {"Compatibility_04", "glTF 2.1"},
                                            {"Compatibility_05", "FAKE_materials_quantumRendering"}})
        EXPECT_NE(refused[model].find(cause), std::string::npos) << model << ": " << refused[model];
    EXPECT_EQ(refused.size(), 3u);
    EXPECT_EQ(empty, (std::set<std::string>{"00_empty_scene", "00_no_nodes", "XmpJsonLd",
                                            "khr_node_visibility_valid", "transform_matrices"}));
}
