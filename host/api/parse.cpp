#include "api/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "cli/output_options.h"
#include "cli/reconstruct_options.h"
#include "cli/render_options.h"
#include "cli/resume.h"

namespace triad::api {
namespace {

constexpr std::array load_options{"scene", "variant", "animation", "pose-time", "strict", "max-texture"};
constexpr std::array left_out{"output", "json", "progress", "pixel", "frames", "fps", "help"};

template <std::size_t n>
bool is_one_of(const std::array<const char*, n>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// max_depth and max-depth are one name.
std::string with_dashes(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

[[noreturn]] void refuse_unknown(const CLI::App& command, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& known : option->get_lnames()) names.push_back(known);
    const std::string near = nearest_name(name, names);
    throw triad::Error(Exit::usage, "There is no option '" + name + "'" +
                                        (near.empty() ? "; docs/command-line.md lists them."
                                                      : ". Did you mean '" + near + "'?"));
}

/// `refuse` throws for what is given in the wrong place.
void parse(
    CLI::App& command, const Options& options,
    const std::function<void(const std::string&)>& refuse = [](const std::string&) {}) {
    std::vector<std::string> words;
    for (const auto& [given, text] : options) {
        const std::string name = with_dashes(given);
        refuse(name);
        if (!command.get_option_no_throw("--" + name)) refuse_unknown(command, given);
        // CLI11 would take the next word for the value.
        if (text.empty()) throw triad::Error(Exit::usage, "--" + name + ": a value is missing.");
        words.push_back("--" + name + "=" + text);
    }
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        command.parse(words);
    } catch (const CLI::ParseError& error) {
        throw triad::Error(Exit::usage, std::string(error.what()) + ".");
    }
}

}  // namespace

Options take_load_options(Options& options) {
    Options taken;
    for (auto at = options.begin(); at != options.end();) {
        const auto each = at++;
        if (is_one_of(load_options, with_dashes(each->first))) taken.insert(options.extract(each));
    }
    return taken;
}

void parse_load_options(const Options& options, RenderRequest& request) {
    CLI::App command;
    declare(command, request);
    parse(command, options, [&command](const std::string& name) {
        if (!is_one_of(load_options, name) && command.get_option_no_throw("--" + name))
            throw triad::Error(Exit::usage, "--" + name + " is an option of render(), not of load().");
    });
    request.words = words_of_picture(command);
}

void parse_render_options(const Options& options, RenderRequest& request) {
    CLI::App command;
    declare(command, request);
    parse(command, options, [](const std::string& name) {
        if (is_one_of(load_options, name))
            throw triad::Error(Exit::usage, "--" + name +
                                                " decides what of a file is loaded: give it to load(), or "
                                                "the file's name to render().");
        if (is_one_of(left_out, name))
            throw triad::Error(Exit::usage, "--" + name +
                                                " is for the command line: the library returns a film, "
                                                "writes pictures of it where it is told to, and calls back "
                                                "with its progress.");
    });
    std::vector<std::string> words = words_of_picture(command);  // beside those of the scene
    request.words.insert(request.words.end(), words.begin(), words.end());
}

void parse_picture_options(const Options& options, OutputStyle& style, ReconstructRequest& reconstruct) {
    CLI::App command;
    declare_style(command, style);
    declare_background(command, style);
    declare(command, reconstruct);
    parse(command, options);
}

}  // namespace triad::api
