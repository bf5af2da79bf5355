// triad-replay: the work of a capture, on a machine that has an OpenCL driver and nothing else.
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/program.h"
#include "base/restart.h"
#include "base/shell_limits.h"
#include "device/device.h"
#include "replay/command_line.h"

namespace {

using namespace triad;

const std::string program = "triad-replay";

int run(int argc, char** argv) {
    CLI::App app;
    ReplayRequest request;
    declare(app, request);
    try {
        app.parse(argc, argv);
        return static_cast<int>(replay(request));
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return complain(program, static_cast<int>(Exit::usage),
                        std::string(error.what()) + "\nSee triad-replay --help.");
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
