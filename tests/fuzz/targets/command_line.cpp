// The words of a command, one a line: they are parsed, and nothing is done.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/experiment.h"
#include "fuzz/targets/target.h"

using namespace triad;

namespace {

/// What a command's callback does comes after all parsing, and is not reached.
void end_parsed(CLI::App& command) {
    for (CLI::App* sub : command.get_subcommands(nullptr)) {
        sub->parse_complete_callback([] { throw CLI::Success(); });
        end_parsed(*sub);
    }
}

}  // namespace

TRIAD_FUZZ_TARGET(command_line) {
    static CLI::App* const app = [] {
        static Exit exit{};
        auto* commands = new CLI::App("Triad", "triad");
        add_commands(*commands, exit);
        end_parsed(*commands);
        return commands;
    }();
    std::vector<std::string> words;
    for (std::string_view rest = fuzz::text_of(input); !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    fuzz::answer([](fuzz::Input bytes) { parse_scene(std::string(fuzz::text_of(bytes))).text(); }, input);
    fuzz::answer([](fuzz::Input bytes) { compare({{"", {}}}, std::string(fuzz::text_of(bytes))); }, input);
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        app->parse(words);
    } catch (const CLI::Error&) {
    }
}
