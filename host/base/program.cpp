#include "base/program.h"

#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "base/error.h"
#include "base/freed_memory.h"
#include "base/memory_limit.h"

namespace triad {
namespace {

constexpr int internal_error = 70;  // EX_SOFTWARE: a defect of Triad

/// Where a standard stream is closed, a file that is opened would take its place and what is printed would go
/// into it. Nothing can be written to what stands there now.
void fill_standard_streams() {
    for (int stream = 0; stream < 3; ++stream)
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != stream) std::abort();
}

}  // namespace

Failure failure_at_hand() {
    try {
        throw;
    } catch (const Error& error) {
        return {static_cast<int>(error.exit()), error.what()};
    } catch (const std::bad_alloc& error) {
        const std::string said = error.what();
        return {static_cast<int>(Exit::memory),
                said.find(' ') == std::string::npos ? "There is not enough memory for this work." : said};
    } catch (const std::filesystem::filesystem_error& error) {
        return {static_cast<int>(Exit::scene), error.what()};
    } catch (const std::exception& error) {
        return {internal_error, std::string("internal error: ") + error.what()};
    }
}

void prepare_process() {
    fill_standard_streams();
    keep_no_large_pieces();
    std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then a failed write with a sentence
    std::signal(SIGPIPE, SIG_IGN);  // so is a reader that went away
    set_memory_limit(available_memory() / 2);
}

int exit_code_of(const std::string& program, const std::function<int()>& work) {
    const int exit = [&] {
        try {
            return work();
        } catch (const std::exception&) {
            const Failure failure = failure_at_hand();
            return complain(program, failure.exit, failure.sentence);
        }
    }();
    const bool is_out = !std::cout.flush().fail() && std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (is_out || exit != static_cast<int>(Exit::done)) return exit;
    return complain(program, static_cast<int>(Exit::scene),
                    "Standard output is closed or full, so that some of what was to be printed is lost.");
}

int complain(const std::string& program, int exit, const std::string& sentence) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), sentence.c_str());
    return exit;
}

}  // namespace triad
