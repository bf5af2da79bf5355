// triad completion: what a shell offers after Tab.
#include "cli/completion.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>

#include "cli/command_line.h"
#include "cli/option_text.h"
#include "cli/programs.h"

namespace triad {
namespace {

/// In double quotes.
std::string bash_quoted(const std::vector<std::string>& words) {
    return "\"" + CLI::detail::join(words, " ") + "\"";
}

/// One line of a case: how a value of the option is completed.
std::string bash_value(const std::string& path, const OptionText& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : " | ") + bash_quoted({path, name});
    std::string way = "kind=none";
    if (!option.words.empty())
        way = (option.is_list ? "kind=list values=" : "kind=words values=") + bash_quoted(option.words);
    if (option.is_folder) way = "kind=folders";
    if (option.is_file) way = "kind=files";
    return "    " + names + ") " + way + " ;;\n";
}

std::string bash_function(const CLI::App& program) {
    std::string commands, values, options, standing;
    for (const CLI::App* command : with_commands(program)) {
        const std::string path = path_in_program(*command);
        if (command != &program)
            commands += "        " +
                        bash_quoted({path_in_program(*command->get_parent()), command->get_name()}) +
                        ") path=" + bash_quoted({path}) + " ;;\n";
        std::vector<std::string> names;
        for (const OptionText& option : options_of(*command)) {
            if (!option.is_named) continue;
            names.push_back(option.names.back());
            if (option.takes_value()) values += bash_value(path, option);
        }
        options += "        " + bash_quoted({path}) + ") values=" + bash_quoted(names) + " ;;\n";
        const Standing found = standing_of(*command);
        standing += "        " + bash_quoted({path}) + ") values=" + bash_quoted(found.words) +
                    (found.is_file ? " files=1" : "") + " ;;\n";
    }
    return function_of(program) + R"(() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local path="" kind="" values="" files="" before="" i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case "$path ${COMP_WORDS[i]}" in
)" + commands +
           R"(        esac
    done
    if [[ $current == = ]]; then # of --name=value bash makes three words
        current=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    case "$path $previous" in
)" + values +
           R"(    esac
    if [[ -z $kind && $current == -* ]]; then
        kind=words
        case $path in
)" + options +
           R"(        esac
    elif [[ -z $kind ]]; then
        kind=words
        case $path in
)" + standing +
           R"(        esac
        [[ -z $files ]] || kind=files
    fi
    case $kind in
    list)
        [[ $current != *,* ]] || before=${current%,*},
        mapfile -t COMPREPLY < <(compgen -P "$before" -W "$values" -- "${current##*,}")
        ;;
    words) mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current") ;;
    files | folders)
        compopt -o filenames 2>/dev/null # outside of a completion there is none to change
        if [[ $kind == folders ]]; then
            mapfile -t COMPREPLY < <(compgen -d -- "$current")
        else
            mapfile -t COMPREPLY < <(compgen -f -W "$values" -- "$current")
        fi
        ;;
    esac
}
complete -F )" +
           function_of(program) + " " + program.get_name() + "\n";
}

}  // namespace

std::string function_of(const CLI::App& command) {
    std::string name = "_" + program_and_path(command);
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

std::string short_description(const std::string& description) {
    std::size_t end = description.size();
    for (const char* stop : {". ", " (", "; ", ": "}) end = std::min(end, description.find(stop));
    return description.substr(0, end);
}

Standing standing_of(const CLI::App& command) {
    Standing found;
    for (const CLI::App* sub : commands_of(command)) found.words.push_back(sub->get_name());
    for (const OptionText& option : options_of(command)) {
        if (option.is_named) continue;
        found.name = option.names.front();
        if (found.name.starts_with("COMMAND"))
            for (const CLI::App* other : commands_of(*command.get_parent()))
                found.words.push_back(other->get_name());
        found.words.insert(found.words.end(), option.words.begin(), option.words.end());
        found.is_file = found.words.empty();
    }
    return found;
}

std::string bash_completion(const Programs& programs) {
    std::string text = "# Completions of Triad for bash, by: triad completion bash\n";
    for (const CLI::App* program : programs) text += bash_function(*program);
    return text;
}

void add_completion(CLI::App& app) {
    auto shell = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "completion", "Print the completions of a shell, as cmake --install puts them into their place");
    command->add_option("SHELL", *shell, "Like: source <(triad completion bash)")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->type_name("bash|zsh|fish");
    command->callback([shell, &app] {
        const ReplayProgram replay;
        const Programs programs{&app, &replay.app()};
        std::cout << (*shell == "bash"  ? bash_completion(programs)
                      : *shell == "zsh" ? zsh_completion(programs)
                                        : fish_completion(programs));
    });
}

}  // namespace triad
