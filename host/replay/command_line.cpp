#include "replay/command_line.h"

#include <string>

#include "base/log.h"
#include "base/memory_limit.h"

namespace triad {

void declare(CLI::App& app, ReplayRequest& o) {
    app.name("triad-replay");
    app.description("Replays, verifies and measures what triad capture wrote, on any OpenCL device.");
    app.set_version_flag("-V,--version", "triad-replay " TRIAD_VERSION, "Print the version");
    app.footer("Exit codes: 0 done, 1 usage, 2 file, 4 memory, 5 device, 7 the film is not the captured one");
    app.add_option("FILE", o.capture, "A capture, by triad capture")->required()->type_name("");
    app.add_option("--device", o.device, "Number, cpu, gpu, or part of a name")->type_name("SEL");
    app.add_option("--threads", o.threads, "Compute units to use on a CPU device (0: all)")->type_name("N");
    app.add_option("--repeat", o.repeat, "Runs that are measured, after the first (default 5; 0: none)")
        ->check(CLI::Range(0u, 100000u))
        ->type_name("N");
    app.add_option("--json", o.json, "Write the rows as JSON (-: standard output)")->type_name("FILE");
    app.add_option("-o,--output", o.folder, "Write a page, index.html, into this folder")->type_name("DIR");
    app.add_option("--against", o.against,
                   "An earlier --json of the same capture: exit 7 where a kernel became slower beyond noise")
        ->type_name("FILE");
    app.add_option_function<std::string>(
           "--verify",
           [&o](const std::string& rule) {
               o.rule = rule == "bits"   ? VerifyRule::bits
                        : rule == "film" ? VerifyRule::film
                                         : VerifyRule::automatic;
           },
           "How its film is compared. auto, the default: bits on the captured device and driver, else film; "
           "film: within tolerances")
        ->check(CLI::IsMember({"auto", "bits", "film"}))
        ->type_name("auto|bits|film");
    app.add_option("--kernels", o.kernels, "Take the programs from this folder instead of the capture")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
    app.add_option("--extract", o.extract,
                   "Write the captured programs to this folder, for --kernels; no more")
        ->type_name("DIR");
    CLI::Option* kernel =
        app.add_option("--single-kernel", o.kernel, "Measure one launch of this kernel alone")
            ->type_name("NAME");
    app.add_option("--launch", o.launch, "Which of its launches, from 1 (default: the longest)")
        ->needs(kernel)
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    app.add_flag("--tune", o.tune, "Find the best work-group size for each kernel")->excludes(kernel);
    app.add_flag("--check", o.check, "First prove the device by known answers, as triad check --quick does");
    app.add_flag_callback(
        "-q,--quiet", [] { set_log_level(0); }, "Errors only");
    app.add_flag_callback(
        "-v,--verbose", [] { set_log_level(2); }, "More about what is done");
    app.add_option_function<std::uint64_t>(
           "--max-memory", [](const std::uint64_t& bytes) { set_memory_limit(bytes); },
           "Memory to take at most, like 4G (default: half of the machine's)")
        ->transform(CLI::AsSizeValue(false))
        ->type_name("SIZE");
}

}  // namespace triad
