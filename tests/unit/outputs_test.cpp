// What is read is never replaced by what is written, nothing waits for a pipe that is no file, and what could
// not be printed is no success. Nothing here needs a device: all of it is found before one is opened.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/io.h"
#include "program.h"
#include "synthetic_film.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;

namespace {

/// A folder with a scene, its buffer and its image, and other files that are read.
class Inputs {
  public:
    Inputs() {
        write("scene.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,
"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"scene.bin"}],
"images":[{"uri":"image.png"}]})");
        write("scene.bin", std::string(36, '\0'));
        write("image.png", "an image that nothing uses");
        write("sky.hdr", "a sky");
        write("a.exr", "a picture"), write("b.exr", "another"), write("a.film", "a film"),
            triad::save_film(folder_ / "a.film", synthetic({0, 4}));
        triad::save_film(folder_ / "b.film", synthetic({4, 8}));
        EXPECT_EQ(run("panel rgb --write panel.json").exit, 0);
        fs::create_symlink("scene.gltf", folder_ / "link");
        fs::create_hard_link(folder_ / "scene.gltf", folder_ / "hard");
        fs::create_directory(folder_ / "sub");
    }

    /// Exit 1, a sentence that holds `names`, and not a byte of any file changed.
    void expect_kept(const std::string& arguments, const std::string& names) const {
        const auto before = contents();
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit, 1) << arguments << "\n" << outcome.output;
        EXPECT_NE(outcome.output.find(names), std::string::npos) << arguments << "\n" << outcome.output;
        EXPECT_EQ(contents(), before) << arguments;
    }

    Outcome run(const std::string& arguments) const {
        return run_triad(arguments, "cd '" + (folder_ / "").string() + "'; timeout -k 1 20");
    }

    fs::path operator/(const std::string& name) const { return folder_ / name; }

  private:
    TemporaryFolder folder_;

    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    std::string contents() const {
        std::string all;
        for (const char* name : {"scene.gltf", "scene.bin", "image.png", "sky.hdr", "a.exr", "b.exr",
                                 "a.film", "b.film", "panel.json", "link", "hard"})
            all += bytes_of(folder_ / name) + "|";
        return all;
    }
};

}  // namespace

TEST(Outputs, none_replaces_the_scene_or_what_it_refers_to) {
    const Inputs inputs;
    for (const char* name : {"scene.gltf", "./scene.gltf", "sub/../scene.gltf", "link", "hard"})
        for (const char* option : {"--film", "--json"})
            inputs.expect_kept("render scene.gltf " + std::string(option) + " " + name,
                               "would replace scene.gltf");
    inputs.expect_kept("render scene.gltf --film scene.bin", "scene.bin");
    inputs.expect_kept("render scene.gltf --json scene.bin", "scene.bin");
    inputs.expect_kept("render scene.gltf -o image.png", "image.png");
    inputs.expect_kept("info scene.gltf --json scene.gltf", "would replace scene.gltf");
    inputs.expect_kept("info scene.gltf --json scene.bin", "would replace");
    inputs.expect_kept("info a.film --json ./a.film", "would replace a.film");
}

TEST(Outputs, none_replaces_any_other_input) {
    const Inputs inputs;
    inputs.expect_kept("render --env sky.hdr -o sky.hdr", "would replace sky.hdr");
    inputs.expect_kept("render --env sky.hdr --json sky.hdr", "would replace sky.hdr");
    inputs.expect_kept("render --panel panel.json --json panel.json", "would replace panel.json");
    inputs.expect_kept("render --spp 99 --resume a.film --json a.film", "the same file");
    inputs.expect_kept("render --spp 99 --resume a.film --film c.film --json a.film", "would replace a.film");
    inputs.expect_kept("resolve a.exr -o sub/../a.exr", "would replace a.exr");
    inputs.expect_kept("merge a.film b.film -o b.film", "would replace b.film");
    inputs.expect_kept("merge a.film b.film -o c.film --json a.film", "would replace a.film");
    inputs.expect_kept("compare a.exr b.exr --map b.exr", "would replace b.exr");
    inputs.expect_kept("compare a.exr b.exr --json a.exr", "would replace a.exr");
    inputs.expect_kept("panel panel.json --write panel.json", "would replace panel.json");
    inputs.expect_kept("panel panel.json --json panel.json", "would replace panel.json");
    inputs.expect_kept("panel rgb --picture image.png -o image.png", "would replace image.png");
    inputs.expect_kept("bench error scene.gltf --csv scene.gltf", "would replace scene.gltf");
    inputs.expect_kept("bench error \"x: scene.gltf --env sky.hdr\" --json sky.hdr", "would replace sky.hdr");
    inputs.expect_kept("bench subpixel scene.gltf --panel panel.json --csv panel.json",
                       "would replace panel.json");
}

TEST(Outputs, two_are_never_one_file) {
    const Inputs inputs;
    inputs.expect_kept("render --film x --json ./x", "the same file");
    inputs.expect_kept("render -o x.png -o sub/../x.png", "the same file");
    inputs.expect_kept("render -o - --json -", "standard output");
    inputs.expect_kept("compare a.exr b.exr --map x.exr --json x.exr", "the same file");
    EXPECT_FALSE(fs::exists(inputs / "x"));
}

TEST(Outputs, no_command_waits_for_a_pipe_or_reads_a_folder) {
    const Inputs inputs;
    for (const char* name : {"pipe", "pipe.exr", "pipe.json"})
        ASSERT_EQ(::mkfifo((inputs / name).c_str(), 0600), 0);
    for (const std::string it : {"pipe.exr", "sub"}) {
        for (const std::string& arguments :
             {"resolve " + it + " -o x.png", "merge " + it + " " + it + " -o x", "info " + it, "render " + it,
              "render --env " + it, "render --resume " + it, "compare " + it + " a.exr",
              "compare a.exr " + it, "panel rgb --picture " + it + " -o x.png", "bench error --against " + it,
              "bench subpixel ./" + it}) {
            const Outcome outcome = inputs.run(arguments);
            EXPECT_TRUE(outcome.exit == 1 || outcome.exit == 2)
                << arguments << ": " << outcome.exit << outcome.output;
            EXPECT_NE(outcome.output.find("triad: "), std::string::npos) << arguments;
        }
    }
    for (const std::string arguments :
         {"panel ./pipe.json", "render --panel ./pipe.json", "render --kernels pipe"})
        EXPECT_NE(inputs.run(arguments).exit, 124) << arguments;
}

TEST(Outputs, a_name_that_is_too_long_gets_a_sentence_before_anything_is_done) {
    const Inputs inputs;
    const std::string it(300, 'n');
    for (const std::string& arguments : {"render " + it,
                                         "render --env " + it,
                                         "render --panel " + it,
                                         "render -o " + it + ".png",
                                         "render --film " + it,
                                         "render --resume " + it,
                                         "render --frames 0:2 --resume " + it,
                                         "render --kernels " + it,
                                         "info " + it,
                                         "info scene.gltf --json " + it,
                                         "resolve " + it + " -o x.png",
                                         "resolve a.exr -o " + it + ".png",
                                         "compare " + it + " a.exr",
                                         "merge a.film " + it + " -o x",
                                         "panel " + it,
                                         "bench error " + it,
                                         "bench error -o " + it,
                                         "bench subpixel -o " + it,
                                         "bench device -o " + it,
                                         "profile -o " + it,
                                         "capture -o " + it}) {
        const Outcome outcome = inputs.run(arguments);
        EXPECT_TRUE(outcome.exit == 1 || outcome.exit == 2)
            << arguments << ": " << outcome.exit << outcome.output;
        EXPECT_EQ(outcome.output.find("filesystem error"), std::string::npos) << outcome.output;
        EXPECT_NE(outcome.output.find(it), std::string::npos) << arguments << "\n" << outcome.output;
    }
}

TEST(Outputs, what_could_not_be_printed_is_no_success) {
    const Inputs inputs;
    for (const std::string arguments :
         {"", "--help", "--version", "render --help", "info scene.gltf", "info scene.gltf --json -", "panel",
          "panel rgb", "panel --json -", "bench --list"})
        for (const std::string nowhere : {" >/dev/full", " >&-"}) {
            // the messages go where the test reads them
            const Outcome outcome = inputs.run(arguments + " 3>&1" + nowhere + " 2>&3 #");
            EXPECT_EQ(outcome.exit, 2) << arguments << nowhere << outcome.output;
            EXPECT_NE(outcome.output.find("tandard output"), std::string::npos) << arguments << nowhere;
        }
    EXPECT_EQ(inputs.run("info scene.gltf").exit, 0);
}
