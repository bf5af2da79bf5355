// triad manual: the pages that man shows, made of what help says.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>

#include "cli/command_line.h"
#include "cli/option_text.h"
#include "cli/programs.h"

namespace triad {
namespace {

/// As roff takes text: what would be a command of its own is not.
std::string roff(const std::string& text) {
    std::string all;
    bool is_line_start = true;
    for (const char c : text) {
        if (is_line_start && (c == '.' || c == '\'')) all += "\\&";
        if (c == '\\')
            all += "\\e";
        else if (c == '-')
            all += "\\-";
        else
            all += c;
        is_line_start = c == '\n';
    }
    return all;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string upper(std::string text) {
    for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// The date of the page: SOURCE_DATE_EPOCH, where packages are to be the same whenever they are built.
std::string date() {
    const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t now = epoch ? std::strtoll(epoch, nullptr, 10) : std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
    return text.data();
}

std::string synopsis(const CLI::App& command) {
    std::string text = bold(program_and_path(command));
    std::string standing;
    for (const CLI::Option* option : command.get_options()) {
        const OptionText said = text_of(*option);
        if (said.is_named) continue;
        standing += " " + (option->get_required() ? "" : std::string("[")) + italic(said.names.front()) +
                    (option->get_required() ? "" : "]");
    }
    text += " [" + italic("OPTIONS") + "]" + standing;
    if (!commands_of(command).empty()) text += " [" + italic("COMMAND") + "]";
    return text;
}

/// Its options, a paragraph each, below the names of their groups, which begin with `heading`.
std::string paragraphs(const CLI::App& command, const std::string& heading) {
    std::string standing, text;
    std::vector<std::string> groups;
    const std::vector<OptionText> options = options_of(command);
    const auto paragraph = [](const OptionText& o) {
        std::string names;
        for (const std::string& name : o.names)
            names += (names.empty() ? "" : ", ") + (o.is_named ? bold(name) : italic(name));
        if (o.is_named && o.takes_value()) names += " " + italic(o.form);
        return ".TP\n" + names + "\n" + roff(o.description) + ".\n";
    };
    for (const OptionText& option : options) {
        if (!option.is_named) standing += paragraph(option);
        if (option.is_named && std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    }
    for (const std::string& group : groups) {
        text += heading + roff(group) + "\n";
        for (const OptionText& option : options)
            if (option.is_named && option.group == group) text += paragraph(option);
    }
    return standing + text;
}

std::string page(const CLI::App& program, const std::string& other) {
    std::string what = program.get_description();
    if (what.ends_with('.')) what.pop_back();
    if (what.starts_with("Triad ")) what = what.substr(6);
    std::string text = ".TH " + roff(upper(program.get_name())) + " 1 " + date() +
                       " \"Triad " TRIAD_VERSION "\"\n.SH NAME\n" + roff(program.get_name()) + " \\- " +
                       roff(what) + "\n.SH SYNOPSIS\n" + synopsis(program) + "\n.SH OPTIONS\n" +
                       paragraphs(program, ".SS ");
    for (const CLI::App* command : with_commands(program)) {
        if (command == &program) continue;
        text += ".SH " + roff(upper(path_in_program(*command))) + "\n" + synopsis(*command) + "\n.PP\n" +
                roff(command->get_description()) + ".\n" + paragraphs(*command, ".SS ");
    }
    return text + ".SH EXIT STATUS\n" + roff(program.get_footer()) + "\n.SH SEE ALSO\n.BR " + roff(other) +
           " (1)\n";
}

}  // namespace

void add_manual(CLI::App& app) {
    auto name = std::make_shared<std::string>("triad");
    CLI::App* command =
        app.add_subcommand("manual", "Print the page of man, as cmake --install puts it into its place");
    command->add_option("PROGRAM", *name, "triad (the default) or triad-replay: triad manual | man -l -")
        ->check(CLI::IsMember({"triad", "triad-replay"}))
        ->type_name("triad|triad-replay");
    command->callback([name, &app] {
        const ReplayProgram replay;
        std::cout << (*name == "triad" ? page(app, "triad-replay") : page(replay.app(), "triad"));
    });
}

}  // namespace triad
