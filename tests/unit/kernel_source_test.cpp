// Kernel source: flattening, line marks, the embedded files and the folder that overrides them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "device/device.h"

namespace fs = std::filesystem;
using namespace triad;

namespace {

/// A kernel folder on disk for one test; the embedded files are back afterwards.
class KernelFolder : public testing::Test {
  protected:
    fs::path folder = fs::temp_directory_path() / ("triad-kernels-" + std::to_string(::getpid()));
    void SetUp() override { fs::create_directories(folder / "sub"); }
    void TearDown() override {
        kernel_source::set_folder({});
        fs::remove_all(folder);
    }
    void write(const std::string& path, const std::string& text) { std::ofstream(folder / path) << text; }
};

TEST_F(KernelFolder, logs_that_count_lines_of_the_text_get_the_lines_of_our_files) {
    write("a.h", "a\nb\n");
    write("main.cl", "#include \"a.h\"\nmain\n");
    kernel_source::set_folder(folder);
    const std::string text = kernel_source::load("main.cl");  // main is its sixth line
    EXPECT_EQ(kernel_source::with_our_lines("<kernel>:4:7: error: b\n<kernel>:6:1: main\n<kernel>:99", text),
              "kernels/a.h:2:7: error: b\nkernels/main.cl:2:1: main\n<kernel>:99");
    EXPECT_EQ(kernel_source::with_our_lines("kernels/a.h:1: as it is", text), "kernels/a.h:1: as it is");
}

TEST_F(KernelFolder, flattens_each_file_once_with_marks_that_give_its_own_lines) {
    write("a.h", "a\n");
    write("sub/b.h", "#ifndef B\n#define B\n#include \"a.h\"\nb\n#endif\n");
    write("main.cl", "#include \"a.h\"\n  #  include  \"sub/b.h\" // why\n#include <stdint.h>\nmain\n");
    kernel_source::set_folder(folder);
    EXPECT_EQ(kernel_source::load("main.cl"),
              "#line 1 \"kernels/main.cl\"\n"
              "#line 1 \"kernels/a.h\"\n"
              "a\n"
              "#line 2 \"kernels/main.cl\"\n"
              "#line 1 \"kernels/sub/b.h\"\n"
              "#ifndef B\n#define B\n"
              "#line 4 \"kernels/sub/b.h\"\n"
              "b\n#endif\n"
              "#line 3 \"kernels/main.cl\"\n"
              "#include <stdint.h>\nmain\n");
}

TEST_F(KernelFolder, stops_at_files_that_include_each_other) {
    write("a.h", "#include \"sub/b.h\"\na\n");
    write("sub/b.h", "#include \"a.h\"\nb\n");
    kernel_source::set_folder(folder);
    EXPECT_EQ(kernel_source::load("a.h"),
              "#line 1 \"kernels/a.h\"\n#line 1 \"kernels/sub/b.h\"\n#line 2 \"kernels/sub/b.h\"\nb\n"
              "#line 2 \"kernels/a.h\"\na\n");
}

TEST_F(KernelFolder, refuses_an_include_under_a_condition) {
    write("a.h", "a\n");
    write("main.cl", "one\n#if X\n#include \"a.h\"\n#endif\n");
    kernel_source::set_folder(folder);
    try {
        kernel_source::load("main.cl");
        FAIL() << "it would be left out of the program when X is on and an earlier file included it under !X";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("kernels/main.cl:3"), std::string::npos) << error.what();
    }
}

TEST_F(KernelFolder, names_the_line_that_includes_a_missing_file) {
    write("main.cl", "one\n#include \"no.h\"\n");
    kernel_source::set_folder(folder);
    try {
        kernel_source::load("main.cl");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("kernels/main.cl:2 includes \"no.h\""), std::string::npos)
            << error.what();
    }
}

TEST_F(KernelFolder, hash_follows_every_file_and_its_name) {
    write("a.h", "a\n");
    write("main.cl", "main\n");
    kernel_source::set_folder(folder);
    EXPECT_EQ(kernel_source::programs(), std::vector<std::string>{"main.cl"});
    const std::string before = kernel_source::hash();
    write("a.h", "A\n");
    const std::string edited = kernel_source::hash();
    EXPECT_NE(edited, before);
    fs::rename(folder / "a.h", folder / "b.h");
    EXPECT_NE(kernel_source::hash(), edited);
}

TEST_F(KernelFolder, that_does_not_exist_is_a_usage_error) {
    try {
        kernel_source::set_folder(folder / "nowhere");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage);
    }
}

TEST(EmbeddedKernels, are_the_files_of_the_source_tree) {
    const fs::path tree = TRIAD_SOURCE_DIR "/kernels";
    const std::string embedded = kernel_source::hash();
    const std::string text = kernel_source::text("types.h");
    kernel_source::set_folder(tree);
    EXPECT_EQ(kernel_source::hash(), embedded);
    EXPECT_EQ(kernel_source::text("types.h"), text);
    kernel_source::set_folder({});
    EXPECT_THROW(kernel_source::text("no.h"), Error);
}

}  // namespace
