// triad profile: where the time of a render goes, kernel by kernel.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/spans.h"
#include "bench/profile_run.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/render_options.h"
#include "profile/kernel_changes.h"
#include "profile/profile_page.h"
#include "profile/profile_report.h"
#include "report/profile_maps.h"
#include "session/render_session.h"

namespace triad {
namespace {

struct ProfileOptions {
    RenderRequest request;
    unsigned runs = 5;
    std::string folder, json, trace, against;
};

/// What a report of other work is told by.
Json workload_of(RenderSession& session) {
    const RenderRequest& o = session.request();
    const Film film = session.renderer().film();
    return {{"scene", film.scene}, {"settings", film.settings}, {"spp", *o.spp}};
}

/// One after the other, each alone.
std::vector<std::string> devices_in(const std::string& list) {
    std::vector<std::string> devices;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) devices.push_back(word);
    if (devices.empty()) devices.emplace_back();
    return devices;
}

void check(const ProfileOptions& o) {
    if (o.request.error || o.request.time || o.request.samples || o.request.share)
        throw Error(Exit::usage,
                    "The runs of a profile do the same work: give --spp N instead of --error, "
                    "--time or --samples.");
    if (o.request.pixel) throw Error(Exit::usage, "A profile is of a picture: leave --pixel out.");
    if (o.request.device == "all" || o.request.device.find('/') != std::string::npos)
        throw Error(Exit::usage,
                    "--device " + o.request.device +
                        ": a profile is of whole devices, one after the other: a number, cpu, gpu "
                        "or part of a name each, with commas between.");
    refuse_folder(o.request.scene_path);
    std::vector<std::string> inputs = o.request.inputs_named();
    inputs.push_back(o.against);
    check_outputs({o.json, o.trace}, inputs);
    check_output_folder(o.folder, {"index.html"}, inputs);
}

Exit run(ProfileOptions o) {
    check(o);
    o.request.profile = true;
    if (!o.request.spp) o.request.spp = 8;
    const Json before = o.against.empty() ? Json() : earlier_report(o.against, "profile");
    keep_spans();
    std::vector<Profile> profiles;
    Json workload;
    const InterruptGuard guard;
    const std::vector<std::string> devices = devices_in(o.request.device);
    for (const std::string& device : devices) {
        RenderRequest request = o.request;
        request.device = device;
        RenderSession session(std::move(request));
        workload = workload_of(session);
        if (!before.is_null()) {  // nothing is to be measured in vain
            require_same_work(before, workload);
            if (devices.size() == 1) require_comparable(before, session.device().info(), o.runs);
        }
        profiles.push_back(profile(session.renderer(), session.goal(), session.request().seed, o.runs,
                                   [&](unsigned done, unsigned all) {
                                       inform(done == 0 ? "Warmed up"
                                                        : "Run " + std::to_string(done) + " of " +
                                                              std::to_string(all));
                                       return !guard.interrupted();
                                   }));
    }
    if (o.json != "-") std::fputs(table_of(profiles).c_str(), stdout);
    const Json more{{"workload", workload}, {"devices", devices_of(profiles)}};
    if (!o.json.empty()) write_report(o.json, "profile", &profiles.front().device, rows_of(profiles), more);
    if (!o.trace.empty()) write_file(o.trace, trace_of(profiles.back(), kept_spans()).dump() + "\n");
    if (!o.folder.empty()) {
        write_file(std::filesystem::path(o.folder) / "index.html",
                   profile_page(profiles, kept_spans(), command_words(), profile_maps()));
        inform("Page: " + o.folder + "/index.html");
    }
    if (o.against.empty()) return Exit::done;
    const std::vector<KernelChange> changes = changes_since(before, profiles);
    if (o.json != "-") std::printf("\n%s", table_of(changes).c_str());
    return any_slower(changes) ? Exit::comparison : Exit::done;
}

}  // namespace

void add_profile(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<ProfileOptions>();
    CLI::App* command =
        app.add_subcommand("profile", "Where the time of a render goes: kernels, rays, bytes, roofline");
    declare_workload(*command, o->request);
    command->get_option("--spp")->description("Samples per pixel of every run (default 8)");
    // What a profile refuses, with a sentence.
    for (const char* refused : {"--error", "--time", "--samples", "--pixel"})
        command->get_option(refused)->group("");
    const char* const group = "Output";
    command
        ->add_option("--runs", o->runs,
                     "Of the same picture with other seeds, after one that warms up (default 5)")
        ->check(whole_number_within(1, 1000))
        ->type_name("N")
        ->group(group);
    command->add_option("-o,--output", o->folder, "Write a page, index.html, into this folder")
        ->type_name("DIR")
        ->group(group);
    add_json(*command, o->json)->group(group);
    command->add_option("--trace", o->trace, "Write the last run as a time line for Perfetto")
        ->type_name("FILE")
        ->group(group);
    command
        ->add_option("--against", o->against,
                     "An earlier --json of the same work: exit 7 where a kernel became slower beyond noise")
        ->type_name("FILE")
        ->group(group);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
