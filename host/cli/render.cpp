// triad render: from a scene to pictures.
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/file_lock.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/program.h"
#include "base/progress.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "cli/frames.h"
#include "cli/output_options.h"
#include "cli/render_options.h"
#include "cli/resume.h"
#include "cli/scenes.h"
#include "io/io.h"
#include "kernels/types.h"
#include "report/pixel_table.h"
#include "report/render_report.h"
#include "session/render_session.h"

namespace triad {
namespace {

/// --pixel: the table on standard output, or where --json says.
void tell_pixel(RenderSession& session) {
    constexpr std::size_t largest = 5;
    const auto [x, y] = *session.request().pixel;
    const std::string& path = session.request().json_path;
    session.prove();
    const PixelReport report = report_pixel(session.renderer(), 0, 0, session.goal().samples, largest);
    const std::vector<std::string>& sources = session.renderer().packed().light_sources;
    if (path != "-") std::fputs(table_text(report, session.scene(), sources, x, y).c_str(), stdout);
    if (!path.empty())
        write_report(path, "render", &session.device().info(),
                     Json::array({to_json(report, session.scene(), sources, x, y)}));
}

/// What went wrong with samples is said, not hidden.
void report_counters(const Film& film, unsigned max_depth) {
    const auto& n = film.counters;
    if (n[COUNTER_NOT_FINITE])
        warn(std::to_string(n[COUNTER_NOT_FINITE]) + " samples were not finite and count as black.");
    if (n[COUNTER_SATURATED])
        warn(std::to_string(n[COUNTER_SATURATED]) + " samples were too bright for the film and were cut.");
    if (n[COUNTER_TRUNCATED])
        detail(format("%llu paths were cut at depth %u",
                      static_cast<unsigned long long>(n[COUNTER_TRUNCATED]), max_depth));
}

/// A scene whose own light is weak gets a black picture; that is right, and no fault of the reader's. Exposed
/// by itself only what has no light at all is dark.
void tell_darkness(const Film& film, const OutputStyle& style) {
    constexpr double dark = 0.03, mid_grey = 0.18;
    double sum = 0, coverage = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const auto mean = pixel_mean(film, p);
        sum += 0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2], coverage += mean[3];
    }
    if (!(coverage > 0)) return;
    const double shown = sum / coverage * std::exp2(style.exposure);
    if (style.automatic_exposure ? shown > 0 : !(shown < dark)) return;
    const std::string exposed =
        shown > 0 ? format("--exposure %.0f brightens it, and ", style.exposure + std::log2(mid_grey / shown))
                  : "";
    inform("The picture is nearly black, since the scene's own light is weak: " + exposed +
           "--look studio or --env FILE lights the scene.");
}

/// Of what was asked for and changes nothing.
void warn_of_idle(const RenderRequest& asked, const Renderer& renderer) {
    warn_of_idle(asked.style, asked.outputs);
    if (asked.focus && !(asked.aperture.value_or(0) > 0))
        warn("--focus changes nothing without --aperture: all is sharp.");
    if (asked.integrator == Integrator::automatic && renderer.photons() == 0 &&
        (asked.photons > 0 || asked.photon_radius > 0 || !asked.aim_photons))
        warn(
            "--photons, --photon-radius and --photon-aim change nothing here: paths bring all light "
            "(--integrator photons takes photons).");
}

/// What was made ready, and how.
void describe(RenderSession& session) {
    const Renderer& renderer = session.renderer();
    std::string left_out_text;
    for (const std::string& name : left_out(renderer.features()))
        left_out_text += (left_out_text.empty() ? "" : ", ") + name;
    detail(format("Loaded in %.2f s, trees and packing %.2f s, kernels %.2f s, %s on the device",
                  session.load_seconds(), renderer.build_seconds(), renderer.compile_seconds(),
                  bytes_text(renderer.device_bytes()).c_str()));
    const bool told = session.request().integrator == Integrator::automatic && renderer.photons() > 0;
    (told ? inform : detail)("Integrator: " + renderer.integrator());
    detail("Not needed by this scene and left out: " + (left_out_text.empty() ? "nothing" : left_out_text));
}

ProgressState shown(const Progress& p, const RenderGoal& goal) {
    return {.done = p.done,
            .seconds = p.seconds,
            .seconds_left = p.seconds_left,
            .spp = p.samples,
            .relmse = p.relmse,
            .trend = p.trend,
            .wanted_relmse = goal.error,
            .seconds_to_error = p.seconds_to_error,
            .perceived_noise = p.perceived_noise};
}

/// `to_go_on`: the command for it, said when the render stops before its goal; empty: there is none.
Exit run(const RenderRequest& request, OpenDevices& devices, const std::string& to_go_on,
         ProgressDisplay& display) {
    RenderSession session(request, &devices);
    describe(session);
    warn_of_idle(session.request(), session.renderer());
    if (session.request().pixel) {
        tell_pixel(session);
        return Exit::done;
    }
    if (session.resumed_samples() > 0)
        inform("Going on from " + spp_text(session.resumed_samples()) + " samples per pixel");
    const InterruptGuard guard;
    const RenderGoal& goal = session.goal();
    RenderOutcome outcome;
    Progress progress;
    try {
        outcome = session.render([&](const Progress& p) {
            progress = p;
            display.update(shown(p, goal));
            return !guard.interrupted();
        });
    } catch (const Error& error) {
        if (!is_film(session.request().film_path)) throw;
        throw Error(error.exit(), std::string(error.what()) + "\nTo go on: " + to_go_on);
    }
    for (const DeviceWork& work : outcome.result.devices)
        if (!work.failure.empty()) devices.reset();  // another picture opens anew what still can be
    const Film& film = outcome.film;
    detail("The film has " + bytes_text(film_bytes(film)) + ", " + std::to_string(film.bins()) +
           (film.bins() == 1 ? " bin per pixel" : " bins per pixel"));
    session.write(outcome);
    report_counters(film, request.max_depth);
    tell_darkness(film, request.style);
    if (!request.json_path.empty())
        write_report(request.json_path, "render", &session.device().info(),
                     Json::array({render_row(session, outcome)}));
    inform(render_sentence(session, outcome));
    if (goal.error > 0 && outcome.result.stop != Stop::error)
        inform(format("The relMSE of %.2g that was asked for is not reached", goal.error) +
               (progress.seconds_to_error > 0
                    ? " and would take about " + clock_time(progress.seconds_to_error) + " more."
                    : "."));
    if (outcome.complete()) return Exit::done;
    inform(format("Stopped early: every pixel has samples %llu to %llu.",
                  static_cast<unsigned long long>(outcome.result.range.begin),
                  static_cast<unsigned long long>(outcome.result.range.end)));
    inform(to_go_on.empty() ? "No film was kept, so that the render cannot go on; with --film FILE it could."
                            : "To go on: " + to_go_on);
    return Exit::interrupted;
}

/// With its phases shown, the last of which says how it ended.
Exit run(const RenderRequest& request, OpenDevices& devices, const std::string& to_go_on) {
    ProgressDisplay display(progress_style(request.progress));
    display.show_phases();
    try {
        const Exit exit = run(request, devices, to_go_on, display);
        display.end(int(exit));
        return exit;
    } catch (...) {
        const Failure failure = failure_at_hand();
        display.end(failure.exit, failure.sentence);
        throw;
    }
}

/// Of one that is complete, a picture that is not there is an error, or is told: others come after it.
enum class Missing { refused, told };

Exit begin_or_go_on(const CLI::App& command, const RenderRequest& request, OpenDevices& devices,
                    const std::string& to_go_on, Missing missing = Missing::refused) {
    if (request.resume_path.empty()) return run(request, devices, to_go_on);
    std::string nothing_to_do;
    RenderRequest whole = resumed(command, request, nothing_to_do);
    whole.outputs = request.outputs,
    whole.film_path = request.film_path;  // numbered where it is a frame, named after its scene
    whole.json_path = request.json_path, whole.resume_path = request.resume_path;
    whole.frames.reset();
    if (nothing_to_do.empty()) return run(whole, devices, to_go_on);
    FileLock::clear(request.resume_path);  // of a process that was killed when it was done
    for (const std::string& path : request.outputs) {
        if (path != "-" && is_there(path)) continue;
        nothing_to_do += path == "-" ? " Nothing was written to standard output."
                                     : " " + path + " is not there, and was not made.";
        if (missing == Missing::refused) throw Error(Exit::usage, nothing_to_do);
    }
    inform(nothing_to_do);
    return Exit::done;
}

Exit render_frames(const CLI::App& command, const RenderRequest& all) {
    RenderRequest checked = all;
    complete(checked);
    OpenDevices devices;
    for (std::uint64_t frame = all.frames->begin; frame < all.frames->end; ++frame) {
        const RenderRequest one = frame_of(all, frame);
        inform(format("Frame %llu, at %.6g s", static_cast<unsigned long long>(frame), one.pose_time));
        if (const Exit exit = begin_or_go_on(command, one, devices, command_that_goes_on(command, all, frame),
                                             Missing::told);
            exit != Exit::done)
            return exit;
    }
    return Exit::done;
}

Exit render(const CLI::App& command, RenderRequest request, const std::vector<std::string>& scenes) {
    request.words = words_of_picture(command);
    OpenDevices devices;
    if (scenes.size() > 1)
        return for_each_scene(command, request, scenes,
                              [&](const RenderRequest& one, const std::string& to_go_on) {
                                  return begin_or_go_on(command, one, devices, to_go_on);
                              });
    request = scene_of(request, scenes.empty() ? "" : scenes.front());
    if (request.frames) return render_frames(command, request);
    const std::string& film = request.film_path.empty() ? request.resume_path : request.film_path;
    return begin_or_go_on(command, request, devices, film.empty() ? "" : command_that_goes_on(command, film));
}

}  // namespace

void add_render(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<RenderRequest>();
    auto scenes = std::make_shared<std::vector<std::string>>();
    CLI::App* command =
        app.add_subcommand("render", "Render a scene, or several; without one the built-in scene");
    declare(*command, *o);
    command->remove_option(command->get_option("SCENE"));
    command->add_option("SCENE", *scenes, "glTF files, .gltf or .glb (default: the built-in scene)")
        ->type_name("");
    command->callback([o, scenes, command, &exit] { exit = render(*command, *o, *scenes); });
}

}  // namespace triad
