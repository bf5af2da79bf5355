#include "cli/completion.h"
#include "cli/option_text.h"

namespace triad {
namespace {

std::string zsh_quoted(std::string text) {
    return "'" + CLI::detail::find_and_replace(std::move(text), "'", "'\\''") + "'";
}

/// With a backslash before each of these characters.
std::string zsh_escaped(const std::string& text, const std::string& special) {
    std::string all;
    for (const char c : text) {
        if (special.find(c) != std::string::npos) all += '\\';
        all += c;
    }
    return all;
}

std::string zsh_action(const OptionText& option) {
    const std::string words = CLI::detail::join(option.words, " ");
    if (option.is_file) return "_files";
    if (option.is_folder) return "_files -/";
    if (option.words.empty()) return " ";
    return option.is_list ? "_values -s , value " + words : "(" + words + ")";
}

/// What _arguments is told of an option, one word for each of its names.
std::string specifications(const OptionText& option) {
    std::string all;
    for (const std::string& name : option.names) {
        std::string one = option.is_repeated ? "*" + name : name;
        if (option.takes_value()) one += name.starts_with("--") ? "=" : "+";
        one += "[" + zsh_escaped(short_description(option.description), "[]\\") + "]";
        if (option.takes_value()) one += ":" + zsh_escaped(option.form, ":\\") + ":" + zsh_action(option);
        all += " \\\n        " + zsh_quoted(one);
    }
    return all;
}

/// Not that of the file, which is _triad.
std::string name_of(const CLI::App& command) {
    return function_of(command) + (command.get_parent() ? "" : "_program");
}

std::string zsh_function(const CLI::App& command) {
    const std::vector<const CLI::App*> subs = commands_of(command);
    std::string text = name_of(command) + "() {\n";
    if (!subs.empty()) text += "    local context state state_descr line\n    local -A opt_args\n";
    text += subs.empty() ? "    _arguments -s -S" : "    _arguments -s -S -C";
    for (const OptionText& option : options_of(command))
        if (option.is_named) text += specifications(option);
    if (subs.empty()) {
        const Standing standing = standing_of(command);
        if (!standing.name.empty())
            text += " \\\n        " +
                    zsh_quoted(
                        "*:" + zsh_escaped(standing.name, ":") + ":" +
                        (standing.is_file ? "_files" : "(" + CLI::detail::join(standing.words, " ") + ")"));
        return text + "\n}\n";
    }
    text +=
        " \\\n        '1: :->command' \\\n        '*:: :->arguments'\n    case $state in\n    command)\n"
        "        local -a commands=(";
    for (const CLI::App* sub : subs)
        text += "\n            " + zsh_quoted(sub->get_name() + ":" +
                                              zsh_escaped(short_description(sub->get_description()), ":\\"));
    text +=
        "\n        )\n        _describe command commands\n        ;;\n    arguments)\n        case $words[1] "
        "in\n";
    for (const CLI::App* sub : subs) text += "        " + sub->get_name() + ") " + name_of(*sub) + " ;;\n";
    return text + "        esac\n        ;;\n    esac\n}\n";
}

}  // namespace

std::string zsh_completion(const Programs& programs) {
    std::string names, services, functions;
    for (const CLI::App* program : programs) {
        names += " " + program->get_name();
        services += "    " + program->get_name() + ") " + name_of(*program) + " ;;\n";
        for (const CLI::App* command : with_commands(*program)) functions += zsh_function(*command);
    }
    return "#compdef" + names + "\n# Completions of Triad for zsh, by: triad completion zsh\n" + functions +
           "_triad_service() {\n    case $service in\n" + services +
           "    esac\n}\n"
           "# A file of $fpath is the function _triad itself; what is sourced says what it is for.\n"
           "if [[ $funcstack[1] == _triad ]]; then\n    _triad_service \"$@\"\nelse\n    compdef "
           "_triad_service" +
           names + "\nfi\n";
}

}  // namespace triad
