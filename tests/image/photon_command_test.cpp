// Photons as a user asks for them: what is said of what cannot be, and what a report holds.
#include <gtest/gtest.h>

#include <filesystem>

#include "program.h"

namespace fs = std::filesystem;

namespace {

const std::string cubo = TRIAD_SCENES "/spectral/cubo.glb";

void expect_refused(const std::string& arguments, int exit, const std::string& sentence) {
    const Outcome outcome = run_triad("render " + arguments + " -q -o /dev/null/x.png");
    EXPECT_EQ(outcome.exit, exit) << arguments;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << arguments << ": " << outcome.output;
}

TEST(PhotonCommand, what_cannot_be_is_refused_with_a_sentence) {
    expect_refused("--integrator photonmap", 1, "auto, path, photons, light or photon-map");
    expect_refused("--photon-aim maybe", 1, "on or off");
    expect_refused("--final-gather 2", 1, "on or off");
    expect_refused("--photon-radius -1", 1, "--photon-radius");
    expect_refused("--photons 0", 1, "--photons");
    expect_refused("--photons 5000000000", 1, "--photons");
    expect_refused("--integrator light --adaptive on", 1, "use --integrator path there");
    expect_refused("--integrator photon-map --pixel 3,3", 1, "--pixel");
    expect_refused("--integrator path --photons 100", 1, "paths bring all light");
    expect_refused("--integrator photons --final-gather off", 1, "for --integrator photon-map");
    const std::string out = (fs::path(testing::TempDir()) / "full.png").string();
    for (const std::string integrator : {"photons", "light", "photon-map"}) {
        const Outcome outcome = run_triad("render " + cubo + " --size 8x8 --spectral full --integrator " +
                                          integrator + " -o " + out);
        EXPECT_EQ(outcome.exit, 1) << integrator;
        EXPECT_NE(outcome.output.find("neither random3 nor --spectral full"), std::string::npos)
            << outcome.output;
    }
}

TEST(PhotonCommand, says_when_it_chose_photons_and_why) {
    for (const char* scene : {"cubo", "prism"}) {
        const Outcome outcome =
            run_triad(std::string("render ") + TRIAD_SCENES "/spectral/" + scene +
                      ".glb --size 8x8 --spp 1 -o " + (fs::path(testing::TempDir()) / "chosen.png").string());
        EXPECT_NE(outcome.output.find("Integrator: photons: something casts"), std::string::npos)
            << outcome.output;
    }
}

TEST(PhotonCommand, more_photons_than_there_is_memory_for_are_refused_with_their_size) {
    const std::string out = (fs::path(testing::TempDir()) / "photons.png").string();
    const Outcome outcome = run_triad(
        "render " + cubo + " --size 16x12 --spp 1 --integrator photon-map --photons 4294967295 -o " + out);
    EXPECT_EQ(outcome.exit, 4) << outcome.output;
    EXPECT_NE(outcome.output.find("Ask for fewer --photons"), std::string::npos) << outcome.output;
    EXPECT_FALSE(fs::exists(out));
}

TEST(PhotonCommand, a_single_photon_is_enough) {
    const std::string out = (fs::path(testing::TempDir()) / "one.png").string();
    for (const std::string integrator : {"photons", "light", "photon-map"}) {
        const Outcome outcome =
            run_triad("render " + cubo + " --size 16x12 --spp 2 --photons 1 -q --integrator " + integrator +
                      " -o " + out);
        EXPECT_EQ(outcome.exit, 0) << integrator << ": " << outcome.output;
    }
}

TEST(PhotonCommand, the_classic_map_tells_the_time_of_its_phases) {
    const std::string out = (fs::path(testing::TempDir()) / "classic.png").string();
    for (const std::string final_gather : {"on", "off"}) {
        const Outcome outcome =
            run_triad("render " + cubo +
                      " --size 16x12 --spp 2 --integrator photon-map --photons 20000 -q --json - "
                      "--final-gather " +
                      final_gather + " -o " + out);
        EXPECT_EQ(outcome.exit, 0) << outcome.output;
        for (const char* member : {"\"photon_s\"", "\"render_s\"", "photon-map: as asked"})
            EXPECT_NE(outcome.output.find(member), std::string::npos) << outcome.output;
    }
}

// A share of photons that a pilot hardly meets makes white specks in the picture, up to fifty
// times its error.
TEST(PhotonCommand, no_share_of_photons_is_taken_whose_specks_cost_more_than_they_bring) {
    const std::string out = (fs::path(testing::TempDir()) / "metals.png").string();
    for (const std::string size : {"128x72", "320x180"}) {
        const Outcome outcome = run_triad("render '" TRIAD_SCENES "/suite/metals.glb' --env '" TRIAD_SCENES
                                          "/suite/sky.hdr' --env-strength 0.35 --spp 1 --force -v --size " +
                                          size + " -o " + out);
        EXPECT_NE(outcome.output.find("a pilot found photons not worth their work"), std::string::npos)
            << size << ": " << outcome.output;
    }
}

}  // namespace
