#pragma once
/// What help, manual and completions say of commands and options. Each reads it here, from what CLI11 was
/// told.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace triad {

struct OptionText {
    std::vector<std::string> names;  ///< "-o", "--output"; of what stands without a name: "SCENE"
    bool is_named = true;
    std::string form;         ///< of its value: "WxH"; empty: it takes none
    std::string description;  ///< with the options that it needs and excludes
    std::string group;
    std::vector<std::string> words;  ///< that the form lists: "on|off"
    bool is_list = false;            ///< of words, with commas between
    bool is_file = false, is_folder = false;
    bool is_repeated = false;  ///< may be given several times

    bool takes_value() const { return !form.empty(); }
    /// "-o, --output FILE".
    std::string usage() const;
};

OptionText text_of(const CLI::Option& option);

/// Those of a command that help shows: what has a group.
std::vector<OptionText> options_of(const CLI::App& command);

/// Its own commands, in the order of help.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The program and all its commands, each before its own.
std::vector<const CLI::App*> with_commands(const CLI::App& program);

/// "triad bench error", and without the program "bench error".
std::string program_and_path(const CLI::App& command);
std::string path_in_program(const CLI::App& command);

/// The text in lines of at most `columns` characters, each but the first after `indent`.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent);

/// Help in a hundred columns.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_description(const CLI::App* app) const override;
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override;
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace triad
