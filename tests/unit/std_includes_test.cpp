// Every name of the standard library has its header, in the file or in one of ours that it includes: what
// comes along by chance with one standard library is missing in the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

const std::map<std::string, Names> names_of = {
    {"algorithm", {"max",       "min",     "clamp",     "sort",        "stable_sort", "nth_element",
                   "find",      "find_if", "copy",      "copy_n",      "fill",        "any_of",
                   "all_of",    "none_of", "transform", "max_element", "min_element", "minmax_element",
                   "partition", "unique",  "reverse",   "lower_bound", "upper_bound", "count_if",
                   "equal",     "rotate",  "shuffle",   "replace"}},
    {"array", {"array"}},
    {"atomic", {"atomic"}},
    {"bit", {"bit_cast", "bit_width", "popcount", "countr_zero", "bit_ceil"}},
    {"charconv", {"from_chars", "to_chars"}},
    {"chrono", {"chrono"}},
    {"cmath",
     {"sqrt", "pow",      "exp",   "log",   "log2", "floor", "ceil",  "lround", "isfinite", "isnan", "fabs",
      "sin",  "cos",      "tan",   "atan2", "acos", "hypot", "ldexp", "frexp",  "cbrt",     "fmod",  "atan",
      "asin", "copysign", "round", "log10", "exp2", "fma",   "trunc", "isinf",  "nextafter"}},
    {"complex", {"complex"}},
    {"cstdint", {"uint8_t", "uint16_t", "uint32_t", "uint64_t", "int32_t", "int64_t"}},
    {"cstdio", {"printf", "fprintf", "snprintf", "fwrite", "fopen", "fputs"}},
    {"cstdlib", {"getenv", "system", "strtod"}},
    {"cstring", {"memcpy", "memcmp", "memset", "strlen", "strerror"}},
    {"filesystem", {"filesystem"}},
    {"fstream", {"ifstream", "ofstream"}},
    {"functional", {"function", "greater", "less", "hash"}},
    {"limits", {"numeric_limits"}},
    {"map", {"map", "multimap"}},
    {"memory", {"unique_ptr", "shared_ptr", "make_unique", "make_shared"}},
    {"mutex", {"mutex", "lock_guard", "unique_lock", "once_flag"}},
    {"new", {"bad_alloc"}},
    {"numeric", {"accumulate", "iota", "inner_product", "gcd"}},
    {"optional", {"optional", "nullopt"}},
    {"random", {"mt19937", "mt19937_64"}},
    {"set", {"set", "multiset"}},
    {"span", {"span"}},
    {"sstream", {"ostringstream", "istringstream", "stringstream"}},
    {"stdexcept", {"runtime_error", "length_error", "invalid_argument"}},
    {"string", {"string", "to_string"}},
    {"thread", {"thread"}},
    {"tuple", {"tuple", "tie"}},
    {"unordered_map", {"unordered_map"}},
    {"vector", {"vector"}},
};

struct Source {
    Names standard, own;   ///< what it includes: "algorithm", "base/error.h"
    Names used;            ///< x of every std::x
    bool visited = false;  ///< while headers are walked
};

Source read(const std::string& text) {
    Source source;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#include ")) {
            const std::string name = line.substr(10, line.find_first_of(">\"", 10) - 10);
            (line[9] == '<' ? source.standard : source.own).insert(name);
        }
        line = line.substr(0, line.find("//"));
        for (auto at = line.find("std::"); at != std::string::npos; at = line.find("std::", at + 1)) {
            const auto begin = line.begin() + std::ptrdiff_t(at) + 5;
            source.used.insert({begin, std::find_if(begin, line.end(), [](unsigned char c) {
                                    return !std::isalnum(c) && c != '_';
                                })});
        }
    }
    return source;
}

using Sources = std::map<std::string, Source>;

/// The standard headers that come with a file; own headers are found by the end of their path.
void collect(Sources& sources, Source& source, Names& headers) {
    if (source.visited) return;
    source.visited = true;
    headers.insert(source.standard.begin(), source.standard.end());
    for (const std::string& name : source.own)
        for (auto& [path, other] : sources)
            if (path.ends_with("/" + name)) collect(sources, other, headers);
}

std::string missing_in(Sources& sources, const std::string& path) {
    for (auto& each : sources) each.second.visited = false;
    Names headers;
    collect(sources, sources[path], headers);
    std::string missing;
    for (const auto& [header, names] : names_of)
        for (const std::string& name : sources[path].used)
            if (names.contains(name) && !headers.contains(header))
                missing += path + " uses std::" + name + " without <" + header + ">\n";
    return missing;
}

}  // namespace

TEST(StandardIncludes, are_where_their_names_are_used) {
    const fs::path root = TRIAD_SOURCE_DIR;
    Sources sources;
    for (const char* top : {"host", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            sources[fs::relative(entry.path(), root).generic_string()] = read(text.str());
        }
    ASSERT_GT(sources.size(), 100u) << "looked in the wrong place: " << root;
    std::string missing;
    for (const auto& each : std::vector<std::pair<std::string, Source>>(sources.begin(), sources.end()))
        missing += missing_in(sources, each.first);
    EXPECT_EQ(missing, "");
}

TEST(StandardIncludes, a_missing_one_is_named) {
    Sources sources;
    sources["host/a.h"] = read("#include <vector>\n");
    sources["host/a.cpp"] =
        read("#include \"a.h\"\nstd::vector<int> v; // std::sort\nint x = std::max(1, 2);\n");
    EXPECT_EQ(missing_in(sources, "host/a.cpp"), "host/a.cpp uses std::max without <algorithm>\n");
}
