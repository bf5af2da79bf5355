#pragma once
/// Kinds of options that several are of. A bad text is an Error(usage) that names the option.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace triad {

/// An option whose text `assign` parses.
inline CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& form,
                               const std::string& help, std::function<void(const std::string&)> assign) {
    return command.add_option_function<std::string>(name, std::move(assign), help)->type_name(form);
}

/// One of some words, in the order of the sentence that lists them.
template <class T, class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, const std::string& form,
                        const std::string& help, const std::vector<std::pair<std::string, T>>& choices,
                        Value& value) {
    return add_parsed(command, name, form, help, [&value, name, choices](const std::string& text) {
        std::string words;
        for (std::size_t i = 0; i < choices.size(); ++i) {
            if (choices[i].first == text) {
                value = choices[i].second;
                return;
            }
            words += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + choices[i].first;
        }
        throw Error(Exit::usage, name + " " + text + ": " + words + ".");
    });
}

template <class Bool>
CLI::Option* add_switch(CLI::App& command, const std::string& name, const std::string& help, Bool& value) {
    return add_choice<bool>(command, name, "on|off", help, {{"on", true}, {"off", false}}, value);
}

/// Every option and name of the command, and of its own commands, refuses an empty text: what a script's
/// unset variable leaves would mean "none was given".
inline void refuse_empty_values(CLI::App& command) {
    CLI::Validator something(
        [](std::string& text) { return text.empty() ? "a value is missing" : std::string(); }, "");
    for (CLI::Option* option : command.get_options())
        if (option->get_expected_max() > 0) option->transform(something);  // the first of its validators
    for (CLI::App* sub : command.get_subcommands(nullptr)) refuse_empty_values(*sub);
}

}  // namespace triad
