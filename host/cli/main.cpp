// triad: its commands.
#include <cstdlib>
#include <iostream>
#include <string>

#include "base/program.h"
#include "base/restart.h"
#include "base/shell_limits.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "device/device.h"

namespace {

using namespace triad;

const std::string program = "triad";

/// "Did you mean ...?", or where help is.
std::string hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const CLI::App* sub : command.get_subcommands(nullptr)) names.push_back(sub->get_name());
    for (const std::string& word : command.remaining()) {
        const std::string name = nearest_name(word.substr(0, word.find('=')), names);
        if (!name.empty()) return "Did you mean " + name + "?";
    }
    return "See triad" + (chosen.empty() ? "" : " " + command.get_name()) + " --help.";
}

int run(int argc, char** argv) {
    CLI::App app("Triad path-traces glTF scenes on any OpenCL device.", "triad");
    Exit exit = Exit::done;
    app.set_version_flag("-V,--version", "triad " TRIAD_VERSION, "Print the version");
    app.set_help_flag("-h,--help", "Show this help, or that of a command");
    const std::string exits =
        "Exit codes: 0 done, 1 usage, 2 scene or file, 3 unsupported, 4 memory, 5 device, 6 incomplete,\n"
        "7 comparison failed, 70 a defect of Triad, 75 interrupted and saved.";
    app.footer(exits);
    add_commands(app, exit);
    app.footer(exits + "\nA first picture: triad render; your own: triad render SCENE.glb -o OUT.png");
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) std::cout << app.help();
        return static_cast<int>(exit);
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return complain(program, static_cast<int>(Exit::usage), std::string(error.what()) + "\n" + hint(app));
    }
}

/// What the loader calls before the initialisers of any library.
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = heed_shell_limits;

}  // namespace

extern "C" void abort() noexcept { end_by_abort(); }

int main(int argc, char** argv) {
    libraries_have_started();
    prepare_process();
    survive_drivers(argc, argv);
    const int exit = exit_code_of(program, [&] { return run(argc, argv); });
    if (any_device_hangs()) std::_Exit(exit);  // its driver would wait for it
    return exit;
}
