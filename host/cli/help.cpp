// triad help: what --help prints, of the program or of a command.
#include <iostream>
#include <memory>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/option_text.h"

namespace triad {
namespace {

/// The command of these words. Throws Error(usage) that names the nearest.
const CLI::App& command_named(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    for (const std::string& word : words) {
        std::vector<std::string> names;
        const CLI::App* found = nullptr;
        for (const CLI::App* sub : commands_of(*command)) {
            names.push_back(sub->get_name());
            if (sub->get_name() == word) found = sub;
        }
        if (!found) {
            const std::string near = nearest_name(word, names);
            throw Error(Exit::usage, program_and_path(*command) + " has no command " + word + "." +
                                         (near.empty() ? "" : " Did you mean " + near + "?"));
        }
        command = found;
    }
    return *command;
}

}  // namespace

void add_help(CLI::App& app) {
    auto words = std::make_shared<std::vector<std::string>>();
    CLI::App* command = app.add_subcommand("help", "Show this help, or that of a command");
    command->add_option("COMMAND", *words, "Like render, or bench error")->type_name("");
    command->callback([words, &app] {
        const CLI::App& chosen = command_named(app, *words);
        std::cout << app.get_formatter()->make_help(&chosen, program_and_path(chosen),
                                                    CLI::AppFormatMode::Normal);
    });
}

}  // namespace triad
