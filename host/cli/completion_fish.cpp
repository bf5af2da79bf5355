#include "cli/completion.h"
#include "cli/option_text.h"

namespace triad {
namespace {

std::string fish_quoted(const std::string& text) {
    std::string all = "'";
    for (const char c : text) all += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
    return all + "'";
}

std::string fish_value(const OptionText& option) {
    const std::string words = CLI::detail::join(option.words, " ");
    if (!option.takes_value()) return "";
    if (option.is_file) return " -r -F";
    if (option.is_folder) return " -x -a '(__fish_complete_directories)'";
    if (option.words.empty()) return " -x";
    return " -x -a " + fish_quoted(option.is_list ? "(__fish_append , " + words + ")" : words);
}

/// What is completed after the words of one command, and how it is known that they are.
std::string lines_of(const CLI::App& command, const std::string& begin) {
    const std::string path = path_in_program(command);
    const std::string here = begin + " -n " + fish_quoted("__triad_at " + fish_quoted(path));
    std::string text;
    for (const CLI::App* sub : commands_of(command))
        text += here + " -a " + sub->get_name() + " -d " +
                fish_quoted(short_description(sub->get_description())) + "\n";
    for (const OptionText& option : options_of(command)) {
        if (!option.is_named) continue;
        text += here;
        for (const std::string& name : option.names)
            text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
        text += fish_value(option) + " -d " + fish_quoted(short_description(option.description)) + "\n";
    }
    const Standing standing = standing_of(command);
    if (standing.is_file) text += here + " -F\n";
    if (commands_of(command).empty() && !standing.words.empty())
        text += here + " -a " + fish_quoted(CLI::detail::join(standing.words, " ")) + "\n";
    return text;
}

}  // namespace

std::string fish_completion(const Programs& programs) {
    std::string cases, lines;
    for (const CLI::App* program : programs) {
        const std::string begin = "complete -c " + program->get_name();
        lines += begin + " -f\n";
        for (const CLI::App* command : with_commands(*program)) {
            lines += lines_of(*command, begin);
            if (command == program) continue;
            cases += "            case " +
                     fish_quoted(path_in_program(*command->get_parent()) + " " + command->get_name()) +
                     "\n                set path " + fish_quoted(path_in_program(*command)) + "\n";
        }
    }
    return "# Completions of Triad for fish, by: triad completion fish\n"
           "function __triad_at --description 'Whether the words so far are of this command'\n"
           "    set -l path ''\n    set -l words (commandline -opc)\n    for word in $words[2..]\n"
           "        switch \"$path $word\"\n" +
           cases + "        end\n    end\n    test \"$path\" = \"$argv\"\nend\n" + lines;
}

}  // namespace triad
