// The only place that catches, prints and exits.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "base/memory_limit.h"
#include "base/shell_limits.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "device/device.h"

namespace {

using namespace triad;

constexpr int internal_error = 70;  // EX_SOFTWARE: a defect of Triad

int complain(int exit, const std::string& sentence) {
    std::fprintf(stderr, "triad: %s\n", sentence.c_str());
    return exit;
}

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
    app.set_version_flag("--version", "triad " TRIAD_VERSION);
    app.set_help_flag("-h,--help", "Show this help, or that of a command");
    app.get_formatter()->column_width(34);
    app.footer(
        "Exit codes: 0 done, 1 usage, 2 scene or file, 3 unsupported, 4 memory, 5 device, 6 incomplete, 7 "
        "comparison failed,\n"
        "75 interrupted and saved. A first picture: triad render; your own: triad render SCENE.glb -o "
        "OUT.png");
    add_commands(app, exit);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) std::cout << app.help();
        return static_cast<int>(exit);
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return complain(static_cast<int>(Exit::usage), std::string(error.what()) + "\n" + hint(app));
    }
}

/// The exit code of a whole program.
int run_and_tell(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        return complain(static_cast<int>(error.exit()), error.what());
    } catch (const std::bad_alloc& error) {
        const std::string said = error.what();
        return complain(static_cast<int>(Exit::memory),
                        said.find(' ') == std::string::npos
                            ? "There is not enough memory for this scene or picture."
                            : said);
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(static_cast<int>(Exit::scene), error.what());
    } catch (const std::exception& error) {
        return complain(internal_error, std::string("internal error: ") + error.what());
    }
}

/// The exit code once all that was printed is out: what went to a full disk or a closed pipe was not done.
int told(int exit) {
    const bool is_out = !std::cout.flush().fail() && std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (is_out || exit != static_cast<int>(Exit::done)) return exit;
    return complain(static_cast<int>(Exit::scene),
                    "Standard output is closed or full, so that some of what was to be printed is lost.");
}

/// Where a standard stream is closed, a file that is opened would take its place and what is printed would go
/// into it. Nothing can be written to what stands there now.
void fill_standard_streams() {
    for (int stream = 0; stream < 3; ++stream)
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != stream) std::abort();
}
/// What the loader calls before the initialisers of any library.
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = heed_shell_limits;

}  // namespace

int main(int argc, char** argv) {
    libraries_have_started();
    fill_standard_streams();
    survive_drivers(argc, argv);
    std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then a failed write with a sentence
    std::signal(SIGPIPE, SIG_IGN);  // so is a reader that went away
    set_memory_limit(available_memory() / 2);
    const int exit = told(run_and_tell(argc, argv));
    if (!any_device_hangs()) return exit;
    std::cout.flush(), std::fflush(nullptr);
    std::_Exit(exit);  // its driver would wait for it
}
