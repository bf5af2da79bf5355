// The walls of docs/architecture.md: includes go down only, and packages stay behind the folder that owns
// them.
#include <gtest/gtest.h>
#include <vector>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

/// Which folders of host/ a folder may include from, beside itself. CMake's links say the same to the
/// compiler; this says it for headers that nothing includes yet.
const std::map<std::string, Names> below = [] {
    const Names data = {"base", "scene", "panel", "bvh"},
                device = {"base", "scene", "panel", "bvh", "pack", "device"};
    const auto with = [](Names names, const Names& more) {
        names.insert(more.begin(), more.end());
        return names;
    };
    const Names trace = with(device, {"trace"}), picture = with(trace, {"render", "display"}),
                measured = with(trace, {"metric", "page", "profile"});
    return std::map<std::string, Names>{
        {"base", {}},
        {"page", {"base"}},
        {"device", {"base"}},
        {"capture", {"device", "base"}},
        {"scene", {"base"}},
        {"io", {"scene", "base"}},
        {"images", {"io", "base"}},
        {"bvh", {"base"}},
        {"panel", {"base"}},
        {"pack", data},
        {"trace", device},
        {"render", trace},
        {"display", device},
        {"metric", {"panel", "scene", "base"}},
        {"profile", with(trace, {"metric", "page"})},
        {"check", with(trace, {"render"})},
        {"bench", with(measured, {"render", "display"})},
        {"session", with(measured, {"render", "display", "capture", "check", "io"})},
        {"report", with(measured, {"render", "display", "check", "bench", "io", "session"})},
        {"viewer", with(measured, {"render", "display", "check", "io", "session", "report"})},
        {"cli", with(measured, {"render", "display", "capture", "check", "bench", "io", "session", "report",
                                "viewer", "replay"})},
        {"api", with(trace, {"metric", "render", "display", "check", "io", "session", "cli"})},
        {"python", {}},  // what the library shows
        {"replay", with(measured, {"capture", "check"})},
    };
}();

/// Packages and their owners: how their headers begin.
const std::map<std::string, Names> owners = {{"CL/", {"device"}},
                                             {"tiny_gltf", {"io"}},
                                             {"OpenImageIO/", {"images"}},
                                             {"png.h", {"io"}},
                                             {"draco/", {"io"}},
                                             {"meshoptimizer", {"io"}},
                                             {"CLI/", {"cli", "replay", "api"}},
                                             {"xxhash", {"base"}},
                                             {"glm/", {"base"}},
                                             {"fftw3", {"panel"}},
                                             {"zstd", {"capture"}},
                                             {"httplib", {"viewer"}},
                                             {"pybind11/", {"python"}}};

/// Which folders of kernels/ the headers of a folder may include from, beside itself and common. Programs
/// (.cl) compose them all.
const std::map<std::string, Names> kernels_below = {
    {"common", {}},
    {"traversal", {}},
    {"shading", {}},
    {"photon", {}},
    {"subpixel", {}},
    {"denoise", {}},
    {"path", {"traversal", "shading", "photon"}},
};

/// The files of kernels/ that C++ reads too.
const Names border = {"kernels/types.h", "kernels/arguments.h"};

std::vector<std::string> includes_of(const std::string& text) {
    static const std::regex pattern(R"(^[ \t]*#[ \t]*include[ \t]*[<"]([^">]+)[">])", std::regex::multiline);
    std::vector<std::string> names;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        names.push_back((*match)[1]);
    return names;
}

std::string first_folder(const std::string& path) {
    const auto slash = path.find('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// What is wrong with the includes of one file; `path` is relative to the root of the repository.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
    std::vector<std::string> found;
    const std::string top = first_folder(path), folder = first_folder(path.substr(top.size() + 1));
    for (const std::string& include : includes_of(text)) {
        const std::string target = first_folder(include);
        bool wrong = include.starts_with("../") || include.starts_with("host/");
        if (top == "host") {
            if (const auto rule = below.find(folder); rule == below.end())
                wrong = true;
            else if (below.contains(target) && target != folder && !rule->second.contains(target))
                wrong = true;
            if (target == "kernels" && !border.contains(include)) wrong = true;
            // What is installed stands alone.
            if (path.starts_with("host/api/triad/") && !include.starts_with("triad/") &&
                include.find_first_of("/.") != std::string::npos)
                wrong = true;
            for (const auto& [prefix, owner] : owners)
                if (include.starts_with(prefix) && !owner.contains(folder)) wrong = true;
        } else if (top == "kernels") {
            if (path.ends_with(".h") && kernels_below.contains(target) && target != folder &&
                target != "common") {
                const auto rule = kernels_below.find(folder);
                if (rule == kernels_below.end() || !rule->second.contains(target)) wrong = true;
            }
            if (below.contains(target)) wrong = true;
        }
        if (wrong) found.push_back(path + " includes " + include);
    }
    return found;
}

std::vector<std::string> violations_of_tree(const fs::path& root) {
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const char* top : {"host", "kernels"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp" && extension != ".cl") continue;
            std::ifstream file(entry.path());
            std::stringstream text;
            text << file.rdbuf();
            for (auto& violation : violations(fs::relative(entry.path(), root).generic_string(), text.str()))
                found.push_back(std::move(violation));
            ++files;
        }
    }
    EXPECT_GT(files, 10u) << "looked in the wrong place: " << root;
    return found;
}

}  // namespace

TEST(Includes, go_down_only) {
    std::string all;
    for (const auto& violation : violations_of_tree(TRIAD_SOURCE_DIR)) all += violation + "\n";
    EXPECT_EQ(all, "");
}

TEST(Includes, rules_catch_what_they_forbid) {
    const auto bad = [](const char* path, const char* text) { return !violations(path, text).empty(); };
    EXPECT_TRUE(bad("host/base/a.h", "#include \"device/device.h\"\n"));
    EXPECT_TRUE(bad("host/scene/a.cpp", "x\n  #  include <CL/cl.h>\n"));
    EXPECT_TRUE(bad("host/render/a.cpp", "#include \"io/io.h\"\n"));
    EXPECT_TRUE(bad("host/pack/a.cpp", "#include \"trace/tracer.h\"\n"));
    EXPECT_TRUE(bad("host/session/a.cpp", "#include \"report/report.h\"\n"));
    EXPECT_TRUE(bad("host/session/a.cpp", "#include <CLI/CLI.hpp>\n"));
    EXPECT_TRUE(bad("host/io/a.cpp", "#include \"device/device.h\"\n"));
    EXPECT_TRUE(bad("host/api/triad/a.h", "#include \"base/error.h\"\n"));
    EXPECT_TRUE(bad("host/api/triad/a.h", "#include <CL/cl.h>\n"));
    EXPECT_TRUE(bad("host/python/a.cpp", "#include \"session/prepare.h\"\n"));
    EXPECT_FALSE(bad("host/api/triad/a.h", "#include <vector>\n#include \"triad/image.h\"\n"));
    EXPECT_TRUE(bad("host/render/a.cpp", "#include <OpenImageIO/imageio.h>\n"));
    EXPECT_TRUE(bad("host/cli/a.cpp", "#include <tiny_gltf.h>\n"));
    EXPECT_TRUE(bad("host/replay/a.cpp", "#include \"io/io.h\"\n"));
    EXPECT_TRUE(bad("host/replay/a.cpp", "#include \"session/prepare.h\"\n"));
    EXPECT_TRUE(bad("host/bvh/a.cpp", "#include \"../device/device.h\"\n"));
    EXPECT_TRUE(bad("host/bvh/a.cpp", "#include \"kernels/features.h\"\n"));
    EXPECT_TRUE(bad("host/extra/a.cpp", "#include <vector>\n"));
    EXPECT_TRUE(bad("kernels/shading/a.h", "#include \"traversal/intersect.h\"\n"));
    EXPECT_TRUE(bad("kernels/common/a.h", "#include \"shading/bsdf.h\"\n"));
    EXPECT_TRUE(bad("kernels/shading/a.h", "#include \"path/state.h\"\n"));
    EXPECT_TRUE(bad("kernels/photon/a.h", "#include \"shading/light.h\"\n"));
    EXPECT_TRUE(bad("kernels/path/a.h", "#include \"subpixel/noise.h\"\n"));
    EXPECT_FALSE(bad("kernels/path/a.h", "#include \"traversal/traverse.h\"\n#include \"photon/splat.h\"\n"));
    EXPECT_FALSE(bad("kernels/shading/a.cl", "#include \"traversal/intersect.h\"\n#include \"types.h\"\n"));
    EXPECT_FALSE(bad(
        "host/trace/a.cpp",
        "#include \"device/device.h\"\n#include \"kernels/types.h\"\n#include \"kernels/arguments.h\"\n"));
    EXPECT_FALSE(bad("host/cli/a.cpp", "// no #include \"x\" here: device/device.h\n#include \"io/io.h\"\n"));
}

/// Two types of one name in one namespace are one type to the linker, which takes either's functions for
/// both.
TEST(Headers, give_every_type_a_name_of_its_own) {
    static const std::regex scope(R"(^namespace ([A-Za-z:]+) \{)", std::regex::multiline),
        type(R"(^(?:struct|class|union|enum class) (\w+)(?: :[^:;][^;]*)? \{)", std::regex::multiline);
    std::map<std::string, Names> files;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TRIAD_SOURCE_DIR) / "host")) {
        if (entry.path().extension() != ".h") continue;
        std::ifstream file(entry.path());
        std::string line, inside;
        for (std::smatch found; std::getline(file, line);) {
            if (std::regex_search(line, found, scope))
                inside = found[1];
            else if (std::regex_search(line, found, type))
                files[inside + "::" + found[1].str()].insert(entry.path().string());
        }
    }
    EXPECT_GT(files.size(), 100u);
    for (const auto& [name, where] : files)
        EXPECT_EQ(where.size(), 1u) << name << " is in " << *where.begin() << " and in " << *where.rbegin();
}
