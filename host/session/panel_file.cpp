#include "session/panel_file.h"

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "panel/panel_json.h"

namespace triad {
namespace {

constexpr std::uint64_t file_cap = 1 << 20;

bool is_file(const std::string& name) {
    std::error_code none;
    return name.ends_with(".json") || name.find('/') != std::string::npos ||
           std::filesystem::is_regular_file(name, none);
}

}  // namespace

Panel panel_named(const std::string& name_or_file) {
    if (auto panel = builtin_panel(name_or_file)) return *panel;
    if (is_file(name_or_file)) {
        const auto bytes = read_filled_file(name_or_file, file_cap);
        return panel_of_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name_or_file);
    }
    std::string list;
    std::vector<std::string> names;
    for (const Panel& panel : builtin_panels()) {
        names.push_back(panel.name);
        list += (list.empty() ? "" : ", ") + panel.name;
    }
    const std::string near = nearest_name(name_or_file.substr(0, name_or_file.find('@')), names);
    throw Error(Exit::usage,
                "--panel " + name_or_file + ": there is no such panel." +
                    (near.empty() ? "" : " Did you mean " + near + "?") + " Give a panel.json, or one of " +
                    list + ", with @90, @180, @270 or @flip behind it for a screen so turned or mirrored.");
}

}  // namespace triad
