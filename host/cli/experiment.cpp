#include "cli/experiment.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"

namespace triad {
namespace {

/// What the bench decides itself.
const char* const taken[] = {"--spp",    "--error", "--time", "--samples", "--seed",     "--pixel",
                             "--output", "--film",  "--json", "--aov",     "--progress", "--kernels"};

std::string trimmed(const std::string& text) {
    const auto begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

}  // namespace

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> all;
    bool within = false;
    char quote = 0;
    for (const char c : text) {
        const bool quotes = quote ? c == quote : c == '\'' || c == '"';
        if (!quotes && !quote && std::isspace(static_cast<unsigned char>(c))) {
            within = false;
            continue;
        }
        if (!within) all.emplace_back();
        within = true;
        if (quotes)
            quote = quote ? 0 : c;
        else
            all.back() += c;
    }
    std::erase(all, "");
    return all;
}

std::string NamedOptions::text() const {
    std::string line;
    for (const std::string& a : arguments) {
        const bool plain = !a.empty() && a.find_first_of(" '\"\\$`") == std::string::npos;
        line += (line.empty() ? "" : " ") + (plain ? a : "'" + a + "'");
    }
    return line;
}

NamedOptions parse_scene(const std::string& text) {
    const auto colon = text.find(": ");
    if (is_there(text) || colon == std::string::npos)
        return {std::filesystem::path(text).stem().string(), {text}};
    return parse_setting(text);
}

std::vector<std::string> arguments_of(const std::vector<std::string>& scenes) {
    std::vector<std::string> all;
    for (const std::string& text : scenes)
        for (std::string& argument : parse_scene(text).arguments) all.push_back(std::move(argument));
    return all;
}

NamedOptions parse_setting(const std::string& text) {
    const auto colon = text.find(':');
    if (text.starts_with("-") || colon == std::string::npos) {
        if (!text.starts_with("-"))
            throw Error(Exit::usage,
                        "'" + text + "': expected \"NAME: OPTIONS\", like \"short: --max-depth 4\".");
        return {trimmed(text), words(text)};
    }
    const std::string name = trimmed(text.substr(0, colon));
    if (name.empty()) throw Error(Exit::usage, "'" + text + "': there is no name before the colon.");
    return {name, words(text.substr(colon + 1))};
}

std::vector<NamedOptions> compare(const std::vector<NamedOptions>& settings, const std::string& text) {
    const auto equals = text.find('=');
    const std::vector<std::string> values = equals == std::string::npos
                                                ? std::vector<std::string>{}
                                                : CLI::detail::split(text.substr(equals + 1), ',');
    if (equals == 0 || values.empty() || std::count(values.begin(), values.end(), "") > 0)
        throw Error(Exit::usage,
                    "--compare " + text + ": expected OPTION=VALUE,VALUE..., like roulette=0.5,1.");
    const std::string option = text.substr(0, equals);
    std::vector<NamedOptions> product;
    for (const NamedOptions& setting : settings)
        for (const std::string& value : values) {
            NamedOptions one = setting;
            one.name += (one.name.empty() ? "" : ", ") + option + " " + value;
            one.arguments.insert(one.arguments.end(), {"--" + option, value});
            product.push_back(one);
        }
    return product;
}

RenderRequest render_options(const std::vector<std::string>& common, const NamedOptions& scene,
                             const NamedOptions& setting) {
    RenderRequest options;
    CLI::App app;
    app.set_help_flag();
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    declare(app, options);
    const std::string where = "Scene " + scene.name + ", setting " + setting.name + ": ";
    std::vector<std::string> arguments = common;
    for (const NamedOptions* more : {&scene, &setting})
        arguments.insert(arguments.end(), more->arguments.begin(), more->arguments.end());
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
        app.parse(arguments);
        complete(options);
    } catch (const CLI::ParseError& error) {
        throw Error(Exit::usage, where + error.what());
    } catch (const Error& error) {
        throw Error(error.exit(), where + error.what());
    }
    for (const char* name : taken)
        if (app.get_option(name)->count() > 0)
            throw Error(Exit::usage,
                        where + name + " is for the bench to decide: see triad bench error --help.");
    return options;
}

}  // namespace triad
