#pragma once
/// Kinds of options that several are of. A bad text is an Error(usage) that names the option.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace triad {

/// For options: a whole number from lo to hi. (CLI11's own ranges say of a fraction that it is not within,
/// and without one a number that its type cannot hold "could not be converted".)
inline CLI::Validator whole_number_within(std::int64_t lo, std::int64_t hi) {
    const std::string range = std::to_string(lo) + " to " + std::to_string(hi);
    return CLI::Validator(
        [=](const std::string& text) {
            std::int64_t value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= lo && value <= hi;
            return good ? std::string() : "expected a whole number from " + range + ", not " + text;
        },
        range);
}

/// Any that 32 bits hold.
inline CLI::Validator whole_number_in_32_bits() { return whole_number_within(0, 0xffffffff); }

/// An option whose text `assign` parses.
inline CLI::Option* add_parsed(CLI::App& command, const std::string& name, const std::string& form,
                               const std::string& help, std::function<void(const std::string&)> assign) {
    return command.add_option_function<std::string>(name, std::move(assign), help)->type_name(form);
}

/// One of some words, which its form lists: help, manual and completions read them there.
template <class T, class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, const std::string& help,
                        const std::vector<std::pair<std::string, T>>& choices, Value& value) {
    std::string form;
    for (const auto& [word, meaning] : choices) form += (form.empty() ? "" : "|") + word;
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
    return add_choice<bool>(command, name, help, {{"on", true}, {"off", false}}, value);
}

/// One of some words, kept as it is.
inline CLI::Option* add_word(CLI::App& command, const std::string& name, const std::string& help,
                             const std::vector<std::string>& words, std::string& value) {
    return command.add_option(name, value, help)
        ->check(CLI::IsMember(words))
        ->type_name(CLI::detail::join(words, "|"));
}

/// Several of them with commas between.
inline CLI::Option* add_word_list(CLI::App& command, const std::string& name, const std::string& help,
                                  const std::vector<std::string>& words, std::vector<std::string>& values) {
    return command.add_option(name, values, help)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(words))
        ->type_name(CLI::detail::join(words, "|") + "[,...]");
}

inline CLI::Option* add_device(CLI::App& command, std::string& selector) {
    return command
        .add_option("--device", selector, "Number, cpu, gpu, or part of a name (triad devices lists them)")
        ->type_name("SEL");
}

inline CLI::Option* add_threads(CLI::App& command, unsigned& threads,
                                const std::string& standard = "0: all") {
    return command
        .add_option("--threads", threads, "Cores of a CPU device to use (default " + standard + ")")
        ->check(whole_number_in_32_bits())
        ->type_name("N");
}

inline CLI::Option* add_json(CLI::App& command, std::string& path,
                             const std::string& what = "Write the rows") {
    return command.add_option("--json", path, what + " as JSON (-: standard output)")->type_name("FILE");
}

inline CLI::Option* add_kernels(CLI::App& command, std::string& folder) {
    return command.add_option("--kernels", folder, "Read kernel source from here instead of the copy inside")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
}

inline CLI::Option* add_progress(CLI::App& command, std::string& style) {
    return add_word(command, "--progress", "How it is told on standard error (default auto)",
                    {"auto", "bar", "lines", "json", "none"}, style);
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

/// A form says what a value looks like; CLI11 would add the range that it may have, which the sentence about
/// a bad one names.
inline void hide_ranges(CLI::App& command) {
    for (CLI::Option* option : command.get_options()) try {
            for (int i = 0;; ++i) option->get_validator(i)->description("");
        } catch (const CLI::OptionNotFound&) {
            // beyond the last
        }
    for (CLI::App* sub : command.get_subcommands(nullptr)) hide_ranges(*sub);
}

}  // namespace triad
