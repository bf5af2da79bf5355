#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "base/files.h"
#include "base/hash.h"
#include "device/device.h"
#include "device/embedded.h"

namespace fs = std::filesystem;

namespace triad::kernel_source {
namespace {

fs::path folder;  // empty: the embedded files

std::string read(const std::string& path) {
    if (!folder.empty()) {
        const auto bytes = read_file(folder / path, 1 << 24);
        return {bytes.begin(), bytes.end()};
    }
    const auto file = embedded_kernels().find(path);
    if (file == embedded_kernels().end()) throw Error(Exit::scene, "There is no kernel file " + path + ".");
    return std::string(file->second);
}

/// Every file by path, sorted, so that the hash does not depend on how a folder is listed.
std::vector<std::string> all_files() {
    std::vector<std::string> paths;
    if (folder.empty()) {
        for (const auto& [path, text] : embedded_kernels()) paths.push_back(path);
        return paths;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path& path = entry.path();
        if (entry.is_regular_file() && (path.extension() == ".h" || path.extension() == ".cl"))
            paths.push_back(path.lexically_relative(folder).generic_string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

class Flattener {
  public:
    void add(const std::string& path, const std::string& text) {
        done_.insert(path);
        mark(1, path);
        std::istringstream lines(text);
        std::string line;
        int number = 0, depth = 0, guard = 0;
        bool seen_directive = false;
        while (std::getline(lines, line)) {
            ++number;
            std::smatch match;
            static const std::regex directive(
                R"re(\s*#\s*(include|if|ifdef|ifndef|endif|define|pragma)\b(\s*"([^"]+)")?.*)re");
            if (line.find('#') == std::string::npos || !std::regex_match(line, match, directive)) {
                out_ << line << '\n';
                continue;
            }
            const std::string word = match[1];
            if (word.starts_with("if")) {
                ++depth;
                if (!seen_directive && word == "ifndef") guard = 1;
            }
            if (word == "endif") --depth;
            seen_directive = true;
            if (word != "include" || !match[3].matched) {
                out_ << line << '\n';
                continue;
            }
            if (depth > guard)
                throw Error(Exit::scene,
                            "kernels/" + path + ":" + std::to_string(number) +
                                " includes a file inside #if; each file is included once per program, so "
                                "move the #include out and put the condition into that file.");
            if (const std::string included = match[3]; !done_.contains(included))
                add(included, text_of(included, path, number));
            mark(number + 1, path);
        }
    }
    std::string text() const { return out_.str(); }

  private:
    void mark(int number, const std::string& path) {
        out_ << "#line " << number << " \"kernels/" << path << "\"\n";
    }

    static std::string text_of(const std::string& path, const std::string& from, int number) {
        try {
            return read(path);
        } catch (const Error& error) {
            throw Error(error.exit(), "kernels/" + from + ":" + std::to_string(number) + " includes \"" +
                                          path + "\" (paths are relative to kernels/): " + error.what());
        }
    }

    std::ostringstream out_;
    std::set<std::string> done_;
};

}  // namespace

void set_folder(const fs::path& path) {
    if (!path.empty() && !is_folder(path))
        throw Error(Exit::usage, "The kernel folder " + path.string() + " is not a folder.");
    folder = path;
}

std::string text(const std::string& path) { return read(path); }

std::string flatten(const std::string& path, const std::string& text) {
    Flattener flattener;
    flattener.add(path, text);
    return flattener.text();
}

std::string with_our_lines(const std::string& log, const std::string& flattened) {
    static const std::regex place("<kernel>:([0-9]{1,7})"), mark("#line ([0-9]+) \"([^\"]+)\"");
    if (log.find("<kernel>:") == std::string::npos) return log;
    std::vector<std::string> names{""};  // of each line of the text, from 1 on
    std::istringstream lines(flattened);
    std::string line, file;
    std::size_t number = 0;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (line.starts_with("#line") && std::regex_match(line, match, mark)) {
            file = match[2], number = std::stoul(match[1]);
            names.push_back(file);
        } else {
            names.push_back(file + ":" + std::to_string(number++));
        }
    }
    std::string told;
    auto rest = log.begin();
    for (std::sregex_iterator at(log.begin(), log.end(), place), end; at != end; ++at) {
        const std::size_t n = std::stoul((*at)[1]);
        told.append(rest, (*at)[0].first);
        told += n < names.size() ? names[n] : at->str();
        rest = (*at)[0].second;
    }
    return told.append(rest, log.end());
}

std::string load(const std::string& path) { return flatten(path, read(path)); }

std::vector<std::string> programs() {
    std::vector<std::string> paths = all_files();
    std::erase_if(paths, [](const std::string& path) { return !path.ends_with(".cl"); });
    return paths;
}

std::string hash() {
    Hash hash;
    for (const std::string& path : all_files()) hash.add(path).add(read(path));
    return hash.hex();
}

}  // namespace triad::kernel_source
