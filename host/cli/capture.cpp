// triad capture: one pass of a render as a file, for triad-replay on other devices.
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "capture/capture.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/render_options.h"
#include "io/io.h"
#include "session/capture_pass.h"

namespace triad {
namespace {

/// Enough that launches are as long as those of a render.
constexpr std::uint64_t default_samples = 4;

struct CaptureOptions {
    RenderRequest request;
    std::string output;
};

Exit run(const CaptureOptions& o) {
    RenderRequest request = o.request;
    if (!request.spp && !request.samples) request.spp = default_samples;
    refuse_folder(request.scene_path);
    check_outputs({o.output}, request.inputs_named());
    request.film_path = o.output;  // so that no picture is asked for
    const Capture capture = capture_pass(std::move(request));
    write_capture(o.output, capture);
    std::size_t launches = 0;
    for (const Recording::Command& command : capture.work.commands)
        launches += std::holds_alternative<Recording::Launch>(command);
    std::uint64_t bytes = 0;
    for (const Recording::Memory& memory : capture.work.memories) bytes += memory.bytes;
    inform(format("Captured %zu launches of %zu kernels over %zu buffers of %s in all: %s has %s", launches,
                  capture.work.functions.size(), capture.work.memories.size(), bytes_text(bytes).c_str(),
                  o.output.c_str(), bytes_text(InputFile(o.output).size()).c_str()));
    return Exit::done;
}

}  // namespace

void add_capture(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<CaptureOptions>();
    CLI::App* command = app.add_subcommand(
        "capture", "Write one pass of a render as a file that triad-replay takes to other devices");
    declare_workload(*command, o->request);
    // What ends a render before its samples are taken, or asks about one pixel.
    for (const char* other : {"--error", "--time", "--adaptive", "--pixel", "--spp"})
        command->remove_option(command->get_option(other));
    command->add_option("-o,--output", o->output, "The capture")
        ->required()
        ->type_name("FILE")
        ->group("Output");
    command->add_option("--spp", o->request.spp, "Samples per pixel (default 4)")
        ->check(whole_number_within(1, most_samples))
        ->type_name("N")
        ->group(command->get_option("--seed")->get_group());
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
