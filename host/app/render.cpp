// triad render: from a scene to pictures.
#include <chrono>
#include <cstdio>
#include <memory>

#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/metadata.h"
#include "app/pixel.h"
#include "app/prepare.h"
#include "app/render_options.h"
#include "app/report.h"
#include "base/log.h"
#include "base/parallel_for.h"
#include "base/progress.h"
#include "base/text.h"
#include "kernels/types.h"
#include "measure/perceived_noise.h"
#include "measure/perceived_sets.h"
#include "render/renderer.h"

namespace triad {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The planes of --aov, as EXR channels.
std::vector<Channel> layers_of(const RenderOptions& o, Renderer& renderer, const Film& film) {
    std::vector<Channel> layers;
    auto asked = [&](const char* name) {
        return std::find(o.aovs.begin(), o.aovs.end(), name) != o.aovs.end();
    };
    auto add = [&](const std::string& name, const char* parts, const auto& values) {
        const std::size_t n = std::char_traits<char>::length(parts);
        for (std::size_t c = 0; c < n; ++c) {
            Channel channel{name + "." + parts[c], std::vector<float>(film.pixels())};
            for (std::size_t i = 0; i < film.pixels(); ++i)
                channel.values[i] = static_cast<float>(values[i * n + c]);
            layers.push_back(std::move(channel));
        }
    };
    if (asked("albedo") || asked("normal") || asked("position") || asked("depth")) {
        constexpr unsigned samples = 16;  // edges and lens blur; the planes have no other noise
        const Renderer::FeaturePlanes planes = renderer.feature_planes(samples);
        if (asked("albedo")) add("albedo", "RGB", planes.albedo);
        if (asked("normal")) add("normal", "XYZ", planes.normal);
        if (asked("position")) add("position", "XYZ", planes.position);
        if (asked("depth")) add("depth", "Z", planes.depth);
    }
    if (asked("samples")) add("samplecount", "Y", film.samples);
    if (asked("variance")) {
        std::vector<float> variance = mean_variance(film);
        if (variance.empty()) variance.assign(film.pixels() * 3, std::numeric_limits<float>::quiet_NaN());
        add("variance", "RGB", variance);
    }
    if (asked("error")) {
        std::vector<float> errors = error_map(film);
        if (errors.empty()) errors.assign(film.pixels(), std::numeric_limits<float>::quiet_NaN());
        add("error", "Y", errors);
    }
    return layers;
}

/// --pixel: the table on standard output, or where --json says.
void tell_pixel(const RenderOptions& o, const Scene& scene, Renderer& renderer, const DeviceInfo& device) {
    constexpr std::size_t largest = 5;
    const auto [x, y] = *o.pixel;
    const PixelReport report = report_pixel(renderer, 0, 0, o.goal().samples, largest);
    if (o.json_path != "-")
        std::fputs(table_text(report, scene, renderer.light_sources(), x, y).c_str(), stdout);
    if (!o.json_path.empty())
        write_report(o.json_path, "render", &device,
                     Json::array({to_json(report, scene, renderer.light_sources(), x, y)}));
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

Exit run(RenderOptions o) {
    complete(o);
    // Everything that can be wrong is found before the long part.
    for (const std::string& path : o.outputs) check_writable(path);
    for (const std::string& path : {o.film_path, o.json_path})
        if (!path.empty()) check_writable(path);
    set_host_threads(o.threads);
    if (!o.kernels_path.empty()) kernel_source::set_folder(o.kernels_path);

    const auto load_start = Clock::now();
    const Scene scene = load_scene(o);
    const RenderSettings settings = settings_of(o, scene);
    const double load_s = since(load_start);
    Device device = open_device(o);
    Renderer renderer(device, scene, settings);
    std::string left_out_text;
    for (const std::string& name : left_out(renderer.features()))
        left_out_text += (left_out_text.empty() ? "" : ", ") + name;
    detail(format("Loaded in %.2f s, trees and packing %.2f s, kernels %.2f s, %s on the device", load_s,
                  renderer.build_seconds(), renderer.compile_seconds(),
                  bytes_text(renderer.device_bytes()).c_str()));
    const bool told = o.integrator == Integrator::automatic && renderer.photons() > 0;
    (told ? inform : detail)("Integrator: " + renderer.integrator());
    detail("Not needed by this scene and left out: " + (left_out_text.empty() ? "nothing" : left_out_text));

    if (o.pixel) {
        tell_pixel(o, scene, renderer, device.info());
        return Exit::done;
    }
    const InterruptGuard guard;
    RenderGoal goal = o.goal();
    if (const auto& panel = o.style.reconstruction.panel) {
        const DisplaySettings display = display_settings(o.style, false);
        goal.perceived_noise = [noise = PerceivedNoise(device, panel->panel, panel->ppd, display)](
                                   const Film& film) { return noise.of(film); };
        if (goal.error == 0) goal.set_errors = perceived_sets(device, *panel, display);
    }
    RenderResult result;
    Progress progress;
    {
        ProgressDisplay display(progress_style(o.progress));
        result = renderer.render_until(goal, [&](const Progress& p) {
            progress = p;
            display.update({.done = p.done,
                            .seconds = p.seconds,
                            .seconds_left = p.seconds_left,
                            .spp = p.samples,
                            .relmse = p.relmse,
                            .trend = p.trend,
                            .wanted_relmse = goal.error,
                            .seconds_to_error = p.seconds_to_error,
                            .perceived_noise = p.perceived_noise});
            return !guard.interrupted();
        });
    }
    const double render_s = result.seconds;
    const Film film = renderer.film();
    const SampleNumbers numbers = film.sample_numbers();
    detail("The film has " + bytes_text(film_bytes(film)) + ", " + std::to_string(film.bins()) +
           (film.bins() == 1 ? " bin per pixel" : " bins per pixel"));
    const bool complete = result.stop != Stop::interrupt;

    Metadata metadata = metadata_of(film);
    metadata["triad:driver"] = device.info().driver;
    metadata["triad:stopped_by"] = to_string(result.stop);
    metadata["triad:seconds"] = metadata["renderTimeSeconds"] = format("%.3f", render_s);
    metadata["triad:scene_name"] =
        o.scene_path.empty() ? "built-in" : std::filesystem::path(o.scene_path).filename().string();
    metadata["triad:machine"] = machine_words();
    metadata["triad:compute_units"] = std::to_string(device.info().compute_units);
    describe(o.style.reconstruction, metadata);
    if (result.perceived_noise) metadata["triad:perceived_noise"] = format("%.4g", *result.perceived_noise);
    if (result.trend) metadata["triad:trend"] = format("%.3f", *result.trend);
    if (!o.film_path.empty()) save_film(o.film_path, film);
    write_outputs(o.outputs, device, film, o.style, layers_of(o, renderer, film), metadata);
    report_counters(film, o.max_depth);

    const double relmse = estimated_relmse(film),
                 mrays = double(film.counters[COUNTER_RAYS]) / render_s / 1e6;
    if (!o.json_path.empty()) {
        const auto& n = film.counters;
        const Json row = {
            {"scene", o.scene_path.empty() ? "built-in" : o.scene_path},
            {"scene_hash", film.scene},
            {"settings_hash", film.settings},
            {"width", film.width},
            {"height", film.height},
            {"spp", spp_json(numbers)},
            {"spp_min", numbers.least},
            {"spp_max", numbers.most},
            {"samples", numbers.total},
            {"adaptive", goal.adaptive && renderer.photons() == 0},
            {"stopped_by", to_string(result.stop)},
            {"seed", o.seed},
            {"integrator", renderer.integrator()},
            {"photons_per_sample", renderer.photons()},
            {"photon_s", renderer.photon_seconds()},
            {"complete", complete},
            {"load_s", load_s},
            {"build_s", renderer.build_seconds()},
            {"compile_s", renderer.compile_seconds()},
            {"render_s", render_s},
            {"relmse", relmse < 0 ? Json() : Json(relmse)},
            {"trend", result.trend ? Json(*result.trend) : Json()},
            {"perceived_noise", result.perceived_noise ? Json(*result.perceived_noise) : Json()},
            {"rays", n[COUNTER_RAYS]},
            {"mrays", mrays},
            {"device", device.info().name},
            {"driver", device.info().driver},
            {"device_bytes", renderer.device_bytes()},
            {"film_bytes", film_bytes(film)},
            {"bins", {film.bins_x, film.bins_y}},
            {"reconstruct", o.style.reconstruction.method},
            {"left_out", left_out(renderer.features())},
            {"not_finite", n[COUNTER_NOT_FINITE]},
            {"saturated", n[COUNTER_SATURATED]},
            {"truncated", n[COUNTER_TRUNCATED]},
            {"cut_energy", double(n[COUNTER_CUT_ENERGY]) / CUT_ENERGY_ONE}};
        write_report(o.json_path, "render", &device.info(), Json::array({row}));
    }
    std::string names;
    for (const std::string& path : o.outputs) names += (names.empty() ? "" : ", ") + path;
    if (!o.film_path.empty()) names += (names.empty() ? "" : ", ") + o.film_path;
    const std::string spread =
        numbers.least == numbers.most ? "" : format(" (%u to %u)", numbers.least, numbers.most);
    const std::string perceived =
        result.perceived_noise ? format(", perceived noise %.2g", *result.perceived_noise) : "";
    inform(format("%s: %ux%u, %s samples per pixel%s in %.1f s, %.2f Mrays/s, relMSE %s%s", names.c_str(),
                  film.width, film.height, spp_text(numbers.mean).c_str(), spread.c_str(), render_s, mrays,
                  relmse < 0 ? "not known" : relmse_text(relmse, result.trend).c_str(), perceived.c_str()));
    if (goal.error > 0 && result.stop != Stop::error)
        inform(format("The relMSE of %.2g that was asked for is not reached", goal.error) +
               (progress.seconds_to_error > 0
                    ? " and would take about " + clock_time(progress.seconds_to_error) + " more."
                    : "."));
    if (complete) return Exit::done;
    inform(format("Stopped early: every pixel has samples %llu to %llu.",
                  static_cast<unsigned long long>(result.range.begin),
                  static_cast<unsigned long long>(result.range.end)));
    return Exit::interrupted;
}

}  // namespace

void add_render(CLI::App& app, Exit& exit) {
    auto o = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene; without one the built-in scene");
    declare(*command, *o);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
