// Bad files: none may crash the loader, hang it or fill the memory, and each gets a sentence that names what
// is wrong.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <random>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "gltf_files.h"
#include "io/io.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr long memory_limit_kib = 2l << 20;
constexpr unsigned cpu_limit_seconds = 10;

struct Outcome {
    int signal = 0;
    int exit = 0;  ///< as the program's: 0 there is something to draw, 2 or 3 with a sentence
    std::string sentence;
    long peak_kib = 0;
};

/// What the program would do with this file, in a child that may crash.
Outcome try_to_load(const fs::path& path) {
    int channel[2];
    EXPECT_EQ(::pipe(channel), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit cpu{cpu_limit_seconds, cpu_limit_seconds}, no_core{0, 0};
        ::setrlimit(RLIMIT_CPU, &cpu);
        ::setrlimit(RLIMIT_CORE, &no_core);
        std::string sentence;
        int exit = 0;
        try {
            if (load_gltf(path).instances.empty())
                exit = 2, sentence = "There is nothing to render in the scene.";
        } catch (const Error& e) {
            exit = int(e.exit()), sentence = e.what();
        } catch (const std::exception& e) {
            exit = 99, sentence = e.what();
        }
        sentence.resize(std::min<std::size_t>(sentence.size(), 4000));
        (void)!::write(channel[1], sentence.data(), sentence.size());
        ::_exit(exit);
    }
    ::close(channel[1]);
    Outcome outcome;
    char buffer[4096];
    for (ssize_t n; (n = ::read(channel[0], buffer, sizeof buffer)) > 0;)
        outcome.sentence.append(buffer, std::size_t(n));
    ::close(channel[0]);
    int status = 0;
    rusage usage{};
    EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
    outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.peak_kib = usage.ru_maxrss;
    return outcome;
}

void expect_survived(const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.signal, 0) << name;
    EXPECT_TRUE(outcome.exit == 0 || outcome.exit == 2 || outcome.exit == 3)
        << name << ": exit " << outcome.exit << ", " << outcome.sentence;
    EXPECT_LT(outcome.peak_kib, memory_limit_kib) << name;
    EXPECT_TRUE(outcome.exit == 0 || outcome.sentence.size() > 20) << name;
}

struct Expectation {
    int exit;
    const char* names;  ///< what the sentence must contain
};

// The number of the file in malformed-minimal, and what has to come of it. Valid: 00 control, 39 a skin
// without inverse bind matrices, 43 and 51 buffers without data that nothing uses, 44 and 45 data URIs with
// other media types, 52 and 53.
const std::map<std::string, Expectation> minimal{
    {"00", {0, ""}},
    {"01", {2, "accessors[0].count"}},
    {"02", {2, "accessor 0"}},
    {"03", {2, "accessors[0].byteOffset"}},
    {"04", {2, "bufferView 0"}},
    {"05", {2, "bufferView 1"}},
    {"06", {2, "bufferView 1"}},
    {"07", {2, "nodes[0]"}},
    {"08", {2, "nodes[3]"}},
    {"09", {2, "nodes[0].children[0]"}},
    {"10", {2, "nodes[3]"}},
    {"11", {2, "nodes[4096]"}},
    {"12", {2, "nests deeper"}},
    {"13", {2, "buffer 0"}},
    {"14", {2, "image 0"}},
    {"15", {2, "image 0"}},
    {"16", {2, "image 0"}},
    {"17", {2, "image 0"}},
    {"18", {2, "image 0"}},
    {"19", {3, "glTF 1.0"}},
    {"20", {3, "glTF 99.0"}},
    {"21", {3, "FAKE_ext"}},
    {"22", {2, "nodes[0].matrix"}},
    {"23", {2, "nodes[0].rotation"}},
    {"24", {2, "nodes[0].matrix"}},
    {"25", {2, "nodes[0].mesh"}},
    {"26", {2, "mesh 0, primitive 0: index 2"}},
    {"27", {2, "nothing to render"}},
    {"28", {2, "sparse index"}},
    {"29", {2, "accessors[0].sparse.count"}},
    {"30", {2, "byteStride"}},
    {"31", {2, "accessors[0].componentType"}},
    {"32", {2, "accessors[0].componentType"}},
    {"33", {2, "attributes.POSITION"}},
    {"34", {2, "meshes[0].primitives[0]"}},
    {"35", {2, "mode"}},
    {"36", {2, "primitives[0].material"}},
    {"37", {2, "textures[0].source"}},
    {"38", {2, "KHR_lights_punctual.light"}},
    {"39", {0, ""}},
    {"40", {2, "skins[0].joints[0]"}},
    {"41", {2, "byte order mark"}},
    {"42", {2, "a+b.png"}},
    {"43", {0, ""}},
    {"44", {0, ""}},
    {"45", {0, ""}},
    {"46", {2, "bufferView 0"}},
    {"47", {2, "buffer 0"}},
    {"48", {2, "emissiveStrength"}},
    {"49", {2, "accessor 1"}},
    {"50", {2, "nothing to render"}},
    {"51", {0, ""}},
    {"52", {0, ""}},
    {"53", {0, ""}},
    {"54", {2, "GLB header"}},
    {"55", {2, "GLB chunk 0"}},
    {"56", {3, "GLB container"}},
    {"57", {2, "GLB header"}},
    {"58", {2, "nothing to render"}},
    {"59", {3, "glTF 1.0"}},
    {"60", {2, "JSON"}},
    {"61", {2, "JSON"}},
    {"62", {2, "cameras[0].perspective.yfov"}},
    {"63", {2, "node 0"}},
};

TEST(GltfFuzz, every_minimal_bad_file_gets_its_sentence) {
    const fs::path folder = test_assets() / "malformed-minimal";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    std::size_t seen = 0;
    for (const fs::path& file : gltf_files(folder)) {
        const std::string name = file.filename().string();
        const auto expectation = minimal.find(name.substr(0, 2));
        const Outcome outcome = try_to_load(file);
        expect_survived(outcome, name);
        if (expectation == minimal.end()) continue;
        ++seen;
        EXPECT_EQ(outcome.exit, expectation->second.exit) << name << ": " << outcome.sentence;
        EXPECT_NE(outcome.sentence.find(expectation->second.names), std::string::npos)
            << name << ": " << outcome.sentence;
    }
    EXPECT_EQ(seen, minimal.size());
}

TEST(GltfFuzz, no_file_of_the_large_corpus_crashes_hangs_or_fills_the_memory) {
    const fs::path folder = test_assets() / "malformed";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    const auto files = gltf_files(folder);
    EXPECT_GT(files.size(), 100u);
    for (const fs::path& file : files) expect_survived(try_to_load(file), file.string());
}

/// scene: most of what the loader reads; pose: what poses are made of.
class GltfFuzzSeed : public testing::TestWithParam<const char*> {};

TEST_P(GltfFuzzSeed, random_changes_to_a_good_file_never_crash_the_loader) {
    const auto bytes = read_file(fs::path(TRIAD_SOURCE_DIR) / "tests/fuzz/seeds/gltf_json" / GetParam());
    const std::string seed(bytes.begin(), bytes.end());
    const fs::path file = fs::temp_directory_path() / ("triad-fuzz-" + std::to_string(::getpid()) + ".gltf");
    std::ofstream(file) << seed;
    ASSERT_NO_THROW(load_gltf(file));
    const char* const replacements[] = {"-1", "0",  "1",     "4294967296", "1e30", "null",
                                        "[]", "{}", "\"x\"", "true",       "255"};
    std::mt19937 random(1);  // fixed: a failure comes again
    int loaded = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text = seed;
        for (int change = 0; change <= round % 3; ++change) {
            // A number of the document becomes something else; every eighth time any byte does.
            std::size_t at = random() % text.size();
            if (round % 8 == 0) {
                text[at] = char(random() % 256);
                continue;
            }
            at = text.find_first_of("0123456789", at);
            if (at == std::string::npos) continue;
            const std::size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
            text.replace(at, end - at, replacements[random() % std::size(replacements)]);
        }
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
        try {
            Scene scene = load_gltf(file);
            EXPECT_EQ(validate(scene), 0u);
            ++loaded;
        } catch (const Error& e) {
            EXPECT_TRUE(e.exit() == Exit::scene || e.exit() == Exit::unsupported) << e.what();
        }
    }
    fs::remove(file);
    EXPECT_GT(loaded, 100);
    EXPECT_LT(loaded, 2900);
}

INSTANTIATE_TEST_SUITE_P(Seeds, GltfFuzzSeed, testing::Values("scene", "pose"));

}  // namespace
}  // namespace triad
