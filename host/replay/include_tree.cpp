#include "replay/include_tree.h"

#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/files.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

/// Lines of a file by number from 1; empty where a program says nothing of them.
using FileLines = std::map<std::size_t, std::string>;

struct Mark {
    std::size_t line;
    std::string path;
};

/// `#line N "kernels/PATH"`, as kernel_source::flatten writes it; false for any other line.
bool read_mark(const std::string& text, Mark& mark) {
    const std::string start = "#line ", middle = " \"kernels/";
    const std::size_t at = text.find(middle);
    if (!text.starts_with(start) || at == std::string::npos || text.back() != '"') return false;
    mark.line = std::strtoull(text.c_str() + start.size(), nullptr, 10);
    mark.path = text.substr(at + middle.size(), text.size() - 1 - at - middle.size());
    if (mark.line == 0 || mark.path.find("..") != std::string::npos || mark.path.starts_with("/"))
        throw Error(Exit::scene,
                    "A captured program names a file that is not in kernels/: " + mark.path + ".");
    return true;
}

/// A file that begins within another was included there; one that was included before is not named again, so
/// that the line stays empty until another program fills it in.
void add_program(const Recording::Source& source, std::map<std::string, FileLines>& files) {
    std::istringstream lines(source.text);
    std::set<std::string> begun;
    std::string current, text;
    std::size_t line = 1;
    while (std::getline(lines, text)) {
        Mark mark;
        if (!read_mark(text, mark)) {
            std::string& known = files[current][line++];
            if (known.empty()) known = text;
            continue;
        }
        if (begun.insert(mark.path).second && !current.empty())
            files[current][line] = "#include \"" + mark.path + "\"";
        else if (begun.size() > 1 && mark.line > 1)
            files[mark.path].try_emplace(mark.line - 1);
        current = std::exchange(mark.path, {}), line = mark.line;
    }
}

/// Without marks and empty lines, which an extracted folder need not have where the captured one did.
std::string essence(const std::string& text) {
    std::istringstream lines(text);
    std::string all, line;
    while (std::getline(lines, line))
        if (!line.empty() && !line.starts_with("#line ")) all += line + "\n";
    return all;
}

}  // namespace

std::map<std::string, std::string> include_tree(const std::vector<Recording::Source>& sources) {
    std::map<std::string, FileLines> files;
    for (const Recording::Source& source : sources) add_program(source, files);
    std::map<std::string, std::string> texts;
    for (const auto& [path, lines] : files) {
        if (path.empty()) continue;
        std::string& text = texts[path];
        std::size_t next = 1;
        for (const auto& [number, line] : lines) {
            if (number > next + (1u << 20))
                throw Error(Exit::scene, "A captured program has lines that are too far apart.");
            text.append(number - next, '\n');
            text += line + "\n";
            next = number + 1;
        }
    }
    return texts;
}

void extract(const std::vector<Recording::Source>& sources, const fs::path& folder) {
    for (const auto& [path, text] : include_tree(sources)) {
        std::error_code failed;
        fs::create_directories((folder / path).parent_path(), failed);
        write_file(folder / path, text);
    }
}

std::vector<Recording::Source> from_folder(const std::vector<Recording::Source>& sources,
                                           const fs::path& folder, std::vector<std::string>& changed) {
    kernel_source::set_folder(folder);
    std::vector<Recording::Source> now = sources;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now[i].text = kernel_source::load(now[i].path);
        if (essence(now[i].text) != essence(sources[i].text)) changed.push_back(now[i].path);
    }
    return now;
}

}  // namespace triad
