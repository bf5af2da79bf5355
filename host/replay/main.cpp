// triad-replay: the work of a capture, on a machine that has an OpenCL driver and nothing else.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "base/error.h"
#include "base/memory_limit.h"
#include "device/device.h"
#include "replay/command_line.h"

namespace {

using namespace triad;

constexpr int internal_error = 70;  // EX_SOFTWARE: a defect of Triad

int complain(int exit, const std::string& sentence) {
    std::fprintf(stderr, "triad-replay: %s\n", sentence.c_str());
    return exit;
}

int run(int argc, char** argv) {
    CLI::App app("Replays, verifies and measures what triad capture wrote, on any OpenCL device.",
                 "triad-replay");
    app.set_version_flag("--version", "triad-replay " TRIAD_VERSION);
    app.footer("Exit codes: 0 done, 1 usage, 2 file, 4 memory, 5 device, 7 the film is not the captured one");
    ReplayRequest request;
    declare(app, request);
    try {
        app.parse(argc, argv);
        return static_cast<int>(replay(request));
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return complain(static_cast<int>(Exit::usage),
                        std::string(error.what()) + "\nSee triad-replay --help.");
    } catch (const Error& error) {
        return complain(static_cast<int>(error.exit()), error.what());
    } catch (const std::bad_alloc& error) {
        const std::string said = error.what();
        return complain(static_cast<int>(Exit::memory), said.find(' ') == std::string::npos
                                                            ? "There is not enough memory for this capture."
                                                            : said);
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(static_cast<int>(Exit::scene), error.what());
    } catch (const std::exception& error) {
        return complain(internal_error, std::string("internal error: ") + error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    survive_drivers(argc, argv);
    std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then a failed write with a sentence
    std::signal(SIGPIPE, SIG_IGN);  // so is a reader that went away
    set_memory_limit(available_memory() / 2);
    const int exit = run(argc, argv);
    if (!any_device_hangs()) return exit;
    std::cout.flush(), std::fflush(nullptr);
    std::_Exit(exit);  // its driver would wait for it
}
