#include "cli/resume.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "cli/render_options.h"
#include "io/io.h"
#include "report/report.h"

namespace triad {
namespace {

/// What the next run may do otherwise.
const std::vector<std::string> of_this_run{
    "--help",     "--output",     "--film",    "--resume",    "--checkpoint", "--json",
    "--progress", "--device",     "--threads", "--format",    "--driver",     "--force",
    "--kernels",  "--frames",     "--fps",     "--aov",       "--strict",     "--quiet",
    "--verbose",  "--max-memory", "--port",    "--no-browser"};
/// Of every command: not among those that declare() makes.
const std::vector<std::string> common{"--help", "--quiet", "--verbose", "--max-memory"};
/// What ends a render: a film may go on to another.
const std::vector<std::string> goals{"--spp", "--error", "--time", "--samples"};

bool is_in(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// "--name=value" of what was given, or "value" of the scene.
using Words = std::vector<std::string>;

std::string name_in(const std::string& word) {
    return word.starts_with("--") ? word.substr(0, word.find('=')) : "";
}

template <class Wanted>
Words words_of(const CLI::App& command, const Wanted& wanted) {
    Words scenes, words;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_positional() ? "" : option->get_name();
        if (option->count() == 0 || !wanted(name)) continue;
        for (const std::string& value : option->results())
            name.empty() ? scenes.push_back(value) : words.push_back(name + "=" + value);
    }
    scenes.insert(scenes.end(), words.begin(), words.end());
    return scenes;
}

/// Every name once, with all that it was given.
std::map<std::string, Words> by_name(const Words& words) {
    std::map<std::string, Words> values;
    for (const std::string& word : words) values[name_in(word)].push_back(word);
    return values;
}

std::string joined(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string quoted(const std::string& word) {
    static const std::string plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=./,:@%+";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

/// What the film was begun with, and `given` where it adds to that.
Words together(const std::string& film, const Words& begun, const Words& given) {
    const auto before = by_name(begun), now = by_name(given);
    const bool has_goal =
        std::any_of(goals.begin(), goals.end(), [&](const std::string& goal) { return now.contains(goal); });
    Words words = given;
    for (const auto& [name, values] : before) {
        const auto again = now.find(name);
        if (is_in(goals, name)) {
            if (!has_goal) words.insert(words.end(), values.begin(), values.end());
        } else if (again == now.end()) {
            words.insert(words.end(), values.begin(), values.end());
        } else if (!name.empty() && again->second != values) {
            throw Error(Exit::usage, joined(again->second) + ": the film " + film + " was begun with " +
                                         joined(values) +
                                         ". Leave the option out to go on, or begin another film.");
        }
    }
    return words;
}

}  // namespace

std::vector<std::string> words_of_picture(const CLI::App& command) {
    return words_of(command, [](const std::string& name) { return !is_in(of_this_run, name); });
}

RenderRequest resumed(const CLI::App& command, const RenderRequest& given, std::string& nothing_to_do) {
    const std::string& path = given.resume_path;
    Film film = load_film_header(path);
    Words said = given.words;
    const Words run = words_of(
        command, [](const std::string& name) { return is_in(of_this_run, name) && !is_in(common, name); });
    const bool has_goal = std::any_of(said.begin(), said.end(),
                                      [](const std::string& word) { return is_in(goals, name_in(word)); });
    if (!has_goal && (!film.progress || film.progress->ended)) {
        SalvagedFilm found = salvage_film(path);
        if (found.damage().empty()) {
            nothing_to_do =
                "The film " + path + " is complete" + (film.progress ? " (--time ended it)" : "") +
                ": --spp N, --error E or --time S goes on" +
                (film.progress ? "" : ", with the scene and the options that it was rendered with") +
                "; triad resolve makes pictures of it.";
            return given;
        }
        const bool is_ended = film.progress.has_value();
        film = std::move(found.film);
        const FilmProgress& held = *film.progress;  // of one that was not ended: its samples
        if (held.words.empty() && is_ended)
            throw Error(Exit::usage, "Film " + path + ": " + found.damage() +
                                         ". To have them rendered again give the scene, the options and a "
                                         "goal (--spp N, --error E or --time S).");
        if (held.words.empty())
            said.push_back("--samples=" + std::to_string(held.samples.begin) + ":" +
                           std::to_string(held.samples.end));
    }
    Words words = film.progress ? together(path, film.progress->words, said) : said;
    RenderRequest request;
    CLI::App parser;
    declare(parser, request);
    Words all = words;
    all.insert(all.end(), run.begin(), run.end());
    std::reverse(all.begin(), all.end());  // as CLI11 takes them
    try {
        parser.parse(all);
    } catch (const CLI::ParseError& error) {
        throw Error(
            Exit::usage,
            "The film " + path + " was begun with options that this Triad does not take: " + error.what());
    }
    request.words = words_of_picture(parser);
    return request;
}

std::string command_of(const CLI::App& command, const std::vector<std::string>& without,
                       const std::vector<std::string>& with) {
    Words words = words_of(command, [&](const std::string& name) { return !is_in(without, name); });
    words.insert(words.end(), with.begin(), with.end());
    std::erase(words, "");
    std::stable_partition(words.begin(), words.end(),
                          [](const std::string& w) { return name_in(w).empty(); });
    std::string text = "triad render";  // and scenes first
    for (const std::string& word : words) text += " " + quoted(word);
    return text;
}

std::string command_that_goes_on(const CLI::App& command, const std::string& film) {
    std::string text = "triad render --resume " + quoted(film);
    for (const std::string& word : words_of(command, [](const std::string& name) {
             return is_in(of_this_run, name) && name != "--film" && name != "--resume";
         }))
        text += " " + quoted(word);
    return text;
}

}  // namespace triad
