#include "cli/option_text.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace triad {
namespace {

constexpr std::size_t help_columns = 100, name_columns = 30;

bool is_word(const std::string& part) {
    const auto first = static_cast<unsigned char>(part.empty() ? 0 : part[0]);
    return (std::islower(first) || std::isdigit(first)) &&
           std::all_of(part.begin(), part.end(),
                       [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '-'; });
}

std::string names_of(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    for (const CLI::Option* option : options) names.push_back(option->get_name());
    std::sort(names.begin(), names.end());  // not in the order of their addresses
    return CLI::detail::join(names, ", ");
}

/// What the form lists, and whether it is a file.
void read_form(OptionText& text) {
    const std::string list = "[,...]";
    std::string form = text.form;
    if (form.ends_with(list)) {
        text.is_list = true;
        form.resize(form.size() - list.size());
    }
    for (const std::string& part : CLI::detail::split(form, '|')) {
        if (is_word(part)) text.words.push_back(part);
        if (part.starts_with("FILE") || part == "FILM" || part == "CSV") text.is_file = true;
        if (part == "DIR" || part == "FOLDER") text.is_folder = true;
    }
}

std::string line(const std::string& name, const std::string& description) {
    const std::string indent(name_columns, ' ');
    const std::string head = "  " + name;
    const std::string gap =
        head.size() + 2 <= name_columns ? std::string(name_columns - head.size(), ' ') : "\n" + indent;
    return head + gap + wrapped(description, help_columns - name_columns, indent) + "\n";
}

}  // namespace

std::string OptionText::usage() const {
    return CLI::detail::join(names, ", ") + (is_named && takes_value() ? " " + form : "");
}

OptionText text_of(const CLI::Option& option) {
    OptionText text;
    text.is_named = option.nonpositional();
    text.is_repeated = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
    if (text.is_named) {
        for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    } else {
        text.names = {option.get_name(true) + (text.is_repeated ? "..." : "")};
    }
    if (option.get_type_size() != 0) text.form = option.get_type_name();
    text.description = option.get_description();
    if (!option.get_needs().empty()) text.description += ". With " + names_of(option.get_needs());
    if (!option.get_excludes().empty()) text.description += ". Not with " + names_of(option.get_excludes());
    if (text.is_named && option.get_required()) text.description += ". Required";
    text.group = option.get_group();
    read_form(text);
    return text;
}

std::vector<OptionText> options_of(const CLI::App& command) {
    std::vector<OptionText> texts;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty()) texts.push_back(text_of(*option));
    return texts;
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
    return command.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

std::vector<const CLI::App*> with_commands(const CLI::App& program) {
    std::vector<const CLI::App*> all{&program};
    for (const CLI::App* command : commands_of(program))
        for (const CLI::App* one : with_commands(*command)) all.push_back(one);
    return all;
}

std::string program_and_path(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return (parent ? program_and_path(*parent) + " " : "") + command.get_name();
}

std::string path_in_program(const CLI::App& command) {
    const std::string path = program_and_path(command);
    const auto space = path.find(' ');
    return space == std::string::npos ? "" : path.substr(space + 1);
}

std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent) {
    std::string all;
    std::size_t used = 0;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (used > 0 && used + 1 + word.size() > columns) {
            all += "\n" + indent;
            used = 0;
        }
        if (used > 0) all += " ", ++used;
        all += word, used += word.size();
    }
    return all;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return wrapped(app->get_description(), help_columns, "") + "\n";
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
    std::string text = "\n" + group + ":\n";
    for (const CLI::Option* option : options) text += make_option(option, is_positional);
    return text;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool) const {
    const OptionText text = text_of(*option);
    return line(text.usage(), text.description);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return line(command->get_name(), command->get_description());
}

/// Without the empty line that CLI11 adds to the one before each group.
std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                         "\n\n");
}

}  // namespace triad
