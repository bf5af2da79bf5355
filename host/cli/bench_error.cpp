#include "cli/bench_error.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "bench/error_csv.h"
#include "bench/error_experiment.h"
#include "cli/command_line.h"
#include "cli/experiment.h"
#include "cli/option_kinds.h"
#include "page/html.h"
#include "report/bench_tables.h"
#include "report/error_report.h"
#include "session/prepare.h"
#include "session/reference_store.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

std::vector<NamedOptions> named_scenes(const BenchErrorOptions& o) {
    std::vector<NamedOptions> scenes;
    for (const std::string& text : o.scenes) scenes.push_back(parse_scene(text));
    if (scenes.empty()) scenes.push_back({"built-in", {}});
    return scenes;
}

std::vector<NamedOptions> named_settings(const BenchErrorOptions& o) {
    std::vector<NamedOptions> settings;
    for (const std::string& text : o.settings) settings.push_back(parse_setting(text));
    if (settings.empty()) settings.push_back({o.compare.empty() ? "default" : "", {}});
    for (const std::string& text : o.compare) settings = compare(settings, text);
    return settings;
}

/// What is named on the command line, read by the parser of `triad render`: every slip is found before the
/// long part.
class Requests {
  public:
    explicit Requests(const BenchErrorOptions& o) : scenes_(named_scenes(o)), settings_(named_settings(o)) {
        const std::vector<std::string> every_run = words(o.common);
        for (const NamedOptions& scene : scenes_) {
            requests_.emplace_back();
            for (NamedOptions setting : settings_) {  // in front: over the scene's, not over its own
                setting.arguments.insert(setting.arguments.begin(), every_run.begin(), every_run.end());
                requests_.back().push_back(render_options({"--size", o.size}, scene, setting));
            }
        }
    }

    /// Which must not outlive this.
    ErrorExperiment experiment() {
        ErrorExperiment e;
        for (const NamedOptions& scene : scenes_) e.scenes.push_back({scene.name, scene.text()});
        for (const NamedOptions& setting : settings_) e.settings.push_back({setting.name, setting.text()});
        e.device = [this](std::size_t setting) -> Device& { return device_of(requests_[0][setting]); };
        e.load = [this](std::size_t scene) { return load_scene(requests_[scene][0]); };
        e.prepare = [this](std::size_t scene, std::size_t setting, const Scene& loaded) {
            return prepare(scene, setting, loaded);
        };
        return e;
    }

  private:
    const std::vector<NamedOptions> scenes_, settings_;
    std::vector<std::vector<RenderRequest>> requests_;  ///< [scene][setting]
    std::map<std::pair<std::string, unsigned>, std::unique_ptr<Device>> devices_;

    Device& device_of(const RenderRequest& request) {
        auto& device = devices_[{request.device, request.threads}];
        if (!device) device = std::make_unique<Device>(open_device(request));
        return *device;
    }

    ErrorCase prepare(std::size_t scene, std::size_t setting, const Scene& loaded) const {
        const RenderRequest &request = requests_[scene][setting], &first = requests_[scene][0];
        if (request.scene_path != first.scene_path || request.env_path != first.env_path ||
            request.scene_index != first.scene_index || request.glass != first.glass)
            throw Error(Exit::usage,
                        "Setting " + settings_[setting].name +
                            ": file, --scene, --env and --glass belong to the scene, not to a setting.");
        ErrorCase ready;
        ready.settings = settings_of(request, loaded);
        ready.adaptive = request.adaptive.value_or(false);
        ready.display = [style = request.style](Device& device, const Film& film) {
            return rgb_of(film, display_of(device, film, style));
        };
        return ready;
    }

    static RgbImage rgb_of(const Film& film, const std::vector<float>& rgba) {
        RgbImage image{film.width, film.height, std::vector<float>(film.pixels() * 3)};
        for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = rgba[i / 3 * 4 + i % 3];
        return image;
    }
};

void say(const ErrorRun& run, unsigned repetitions) {
    inform(format("%s, repetition %u of %u, %s: %.6g spp in %.2f s, relMSE %.3g", run.scene.c_str(),
                  run.repetition + 1, repetitions, run.setting.c_str(), run.spp, run.seconds, run.relmse));
}

/// Interrupted: says so in the result.
ErrorBench measure(const BenchErrorOptions& o) {
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    Requests requests(o);
    ErrorExperiment experiment = requests.experiment();
    require_different_names(experiment);
    experiment.plan = {o.spp, o.time, o.repetitions, o.seed, o.reference_spp, o.own_references};
    if (!o.against.empty()) {
        const auto bytes = read_file(o.against);
        experiment.before =
            runs_from_csv(o.against, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    const InterruptGuard guard;
    ProgressDisplay display(progress_style(o.progress));
    const ErrorBench bench =
        run_experiment(experiment, {load_reference, keep_reference,
                                    [&](const Progress& p, double before) {
                                        display.update({.done = p.done,
                                                        .seconds = p.seconds,
                                                        .seconds_left = p.seconds_left,
                                                        .spp = before + p.samples,
                                                        .relmse = p.relmse,
                                                        .trend = p.trend});
                                        return !guard.interrupted();
                                    },
                                    [&] { return !guard.interrupted(); },
                                    [&](const ErrorRun& run) { say(run, o.repetitions); }});
    if (!o.against.empty() && bench.changes.empty())
        warn(o.against + " has no scene and setting in common with this bench that could be compared.");
    return bench;
}

void write_bench(const ErrorBench& bench, const std::vector<SettingScore>& scores, const std::string& json,
                 const std::string& csv) {
    if (!json.empty())
        write_report(json, "bench-error", &bench.device, rows_of(bench), details_of(bench, scores));
    if (csv == "-")
        std::fputs(csv_of(bench.runs).c_str(), stdout);
    else if (!csv.empty())
        write_file(csv, csv_of(bench.runs));
}

}  // namespace

Exit run_bench_error(const BenchErrorOptions& o) {
    std::vector<std::string> inputs = arguments_of(o.scenes);
    inputs.insert(inputs.end(), {o.against, o.kernels});
    check_outputs({o.csv, o.json}, inputs);
    check_output_folder(o.folder, {"report.html", "runs.csv", "report.json"}, inputs);
    const ErrorBench bench = measure(o);
    const std::vector<SettingScore> scores =
        o.baselines.empty() ? std::vector<SettingScore>{} : score_settings(bench, o.baselines);
    if (o.json != "-" && o.csv != "-") std::fputs((table_of(bench) + table_of(scores)).c_str(), stdout);
    if (!o.folder.empty()) {
        const fs::path folder = o.folder;
        write_bench(bench, scores, folder / "report.json", folder / "runs.csv");
        write_error_report(folder, bench, {o.title, command_words(), date_words(), scores});
    }
    write_bench(bench, scores, o.json, o.csv);
    if (!bench.right())
        throw Error(Exit::comparison,
                    "The picture is not the reference's, and the numbers are void: " + bench.wrong() + ".");
    if (const std::string worse = bench.worse(); !worse.empty() && o.fail_if_worse)
        throw Error(Exit::comparison, "Worse than " + o.against + ": " + worse + ".");
    if (!bench.interrupted) return Exit::done;
    inform("Stopped early: what was measured until then is above.");
    return Exit::interrupted;
}

void declare(CLI::App& command, BenchErrorOptions& o) {
    command
        .add_option(
            "--setting", o.settings,
            "\"NAME: OPTIONS\": options of triad render to compare; several allowed, the first is the "
            "one that times are compared with")
        ->allow_extra_args(false)
        ->type_name("TEXT");
    command
        .add_option("--compare", o.compare,
                    "Like roulette=0.5,1: every setting with each of these values; several allowed")
        ->allow_extra_args(false)
        ->type_name("OPTION=V,V...");
    command
        .add_option("--options", o.common, "Options of triad render for every run, over those of its scene")
        ->type_name("TEXT");
    command.add_option("--repetitions", o.repetitions, "Runs of each setting, with a seed each (default 5)")
        ->check(whole_number_within(1, 10000))
        ->type_name("N");
    command.add_option("--seed", o.seed, "Of the first repetition; the others count on (default 1)")
        ->check(whole_number_within(0, 1 << 30))
        ->type_name("N");
    command
        .add_option("--against", o.against, "runs.csv of an earlier bench: say what became better or worse")
        ->check(CLI::ExistingFile)
        ->type_name("CSV");
    command.add_flag("--fail-if-worse", o.fail_if_worse, "Exit 7 when something is worse than --against");
    command
        .add_option("-o,--output", o.folder, "Folder for report.html, its plots, report.json and runs.csv")
        ->type_name("FOLDER");
    command.add_option("--csv", o.csv, "Write the runs as CSV (-: standard output)")->type_name("FILE");
    add_json(command, o.json, "Write curves");
    add_kernels(command, o.kernels);
    add_progress(command, o.progress);
}

void add_bench_error(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<BenchErrorOptions>();
    CLI::App* command = bench.add_subcommand(
        "error", "Error against samples and time, of scenes and settings, to references that it renders");
    command
        ->add_option(
            "SCENES", o->scenes,
            "FILE, or \"NAME: FILE OPTIONS\" with options of triad render (default: the built-in scene)")
        ->type_name("");
    add_parsed(*command, "--size", "WxH", "Of the pictures, unless a scene says otherwise (default 256x256)",
               [o](const std::string& v) {
                   parse_size("--size", v);
                   o->size = v;
               });
    command->add_option("--spp", o->spp, "Samples per pixel of the last budget: 1, 2, 4 ... N (default 64)")
        ->check(whole_number_within(1, 1 << 24))
        ->type_name("N");
    command->add_option("--time", o->time, "Begin no budget that would make a run longer than this")
        ->check(number_within(1e-6, 1e9))
        ->type_name("S");
    command
        ->add_option("--reference-spp", o->reference_spp,
                     "Samples per pixel of the references at least (default 8 times --spp, 1024 at least)")
        ->check(whole_number_within(2, 1 << 29))
        ->type_name("N");
    command->add_flag(
        "--own-references", o->own_references,
        "A reference for every setting, instead of the first setting's for all: where they are not "
        "meant to show one picture");
    declare(*command, *o);
    command->callback([o, &exit] { exit = run_bench_error(*o); });
}

}  // namespace triad
