// Every option of every command: what is no value is refused, with a sentence that names the option.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/command_line.h"
#include "program.h"

namespace {

/// Of options that take any text: names of files, folders, devices, cameras.
const std::set<std::string> free_text{"",
                                      "FILE",
                                      "FILE.png",
                                      "FILM",
                                      "FOLDER",
                                      "DIR",
                                      "VARIANT",
                                      "CSV",
                                      "SEL",
                                      "PANEL",
                                      "SEL[/N],...|all",
                                      "NAME|INDEX",
                                      "NAME|INDEX|none",
                                      "COMMAND",
                                      "ID[,...]",
                                      "TEXT",
                                      "NAME|FILE.json",
                                      "MATERIAL=NAME",
                                      "OPTION=V,V...",
                                      "PANEL,..."};

/// The commands as the program has them, which parse and do nothing: a last word that no command takes ends
/// it.
class Commands {
  public:
    Commands() { triad::add_commands(app_, exit_); }

    /// Calls take(path of the command, option) for all that take a value.
    template <class Take>
    void for_each_option(const Take& take) {
        visit(app_, {}, take);
    }

    /// What is said when this is given; empty: nothing is wrong with it.
    std::string refusal(std::vector<std::string> path, const CLI::Option& option, const std::string& value) {
        const bool is_named = !option.get_lnames().empty();
        if (is_named && value.empty()) path.push_back("--" + option.get_lnames().front());
        path.push_back(is_named && !value.empty() ? "--" + option.get_lnames().front() + "=" + value : value);
        path.push_back("--no-such-option");
        std::reverse(path.begin(), path.end());  // as CLI11 takes them
        try {
            app_.parse(path);
        } catch (const CLI::ExtrasError&) {
            return "";
        } catch (const CLI::ParseError& error) {
            return error.what();
        } catch (const triad::Error& error) {
            EXPECT_EQ(error.exit(), triad::Exit::usage);
            return error.what();
        }
        ADD_FAILURE() << "what no command takes was taken";
        return "";
    }

  private:
    CLI::App app_;
    triad::Exit exit_{};

    template <class Take>
    static void visit(const CLI::App& command, std::vector<std::string> path, const Take& take) {
        if (!command.get_name().empty()) path.push_back(command.get_name());
        for (const CLI::Option* option : command.get_options())
            if (option->get_expected_max() > 0) take(path, *option);
        for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
            visit(*sub, path, take);
    }
};

void expect_refused(Commands& commands, const std::vector<std::string>& path, const CLI::Option& option,
                    const std::string& value) {
    const std::string said = commands.refusal(path, option, value);
    std::string words;
    for (const std::string& word : path) words += word + " ";
    // a name stands at the place of the first that the command takes
    const std::string named =
        option.get_positional() && value.empty() ? "a value is missing" : option.get_name();
    EXPECT_NE(said.find(named), std::string::npos)
        << words << option.get_name() << " '" << value << "': " << said;
}

}  // namespace

TEST(Options, an_empty_value_is_never_taken_for_none_given) {
    Commands commands;
    std::size_t seen = 0;
    commands.for_each_option([&](const std::vector<std::string>& path, const CLI::Option& option) {
        ++seen;
        expect_refused(commands, path, option, "");
    });
    EXPECT_GT(seen, 120u);
    for (const std::string arguments : {"render ''", "info ''", "render --film ''", "panel --json ''"})
        EXPECT_EQ(run_triad(arguments).exit, 1) << arguments;
}

TEST(Options, none_takes_what_is_no_number) {
    Commands commands;
    std::size_t seen = 0;
    commands.for_each_option([&](const std::vector<std::string>& path, const CLI::Option& option) {
        const std::string type = option.get_type_name();
        if (free_text.contains(type.substr(0, type.find(':')))) return;
        ++seen;
        for (const std::string value : {"nan", "inf", "-inf", "1e999"})
            if (!option.get_positional() || value[0] != '-')  // that would be an option
                expect_refused(commands, path, option, value);
    });
    EXPECT_GT(seen, 70u);
    for (const std::string option : {"time=nan", "error=inf", "spp=1e999", "fov=-inf"})
        EXPECT_EQ(run_triad("render --" + option).exit, 1) << option;
}
