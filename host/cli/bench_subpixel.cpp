#include "cli/bench_subpixel.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "cli/command_line.h"
#include "cli/compare_perceived.h"
#include "cli/experiment.h"
#include "cli/option_kinds.h"
#include "cli/suite.h"
#include "page/html.h"
#include "report/subpixel_report.h"
#include "session/panel_file.h"
#include "session/prepare.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

struct SubpixelOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> panels = {"rgb"};
    std::vector<double> ppd;
    std::string size = "96x64", synthetic, device, folder, csv, json;
    std::vector<unsigned> rays = {9, 36, 144};
    unsigned repetitions = 2, samples = 6, reference_spp = 256, synthetic_samples = 12;
    std::uint32_t seed = 1;
};

/// Type and lines, leaves, smooth shades, highlights.
std::vector<NamedOptions> usual_scenes() {
    const fs::path folder = scenes_folder();
    std::vector<NamedOptions> scenes = {{"page", {(folder / "subpixel/page.glb").string()}}};
    for (const NamedOptions& scene : suite_scenes(folder))
        if (scene.name == "garden" || scene.name == "metals" || scene.name == "lamps")
            scenes.push_back(scene);
    return scenes;
}

/// The synthetic pictures, where the folder of test assets is known or lies beside the source; else "".
std::string usual_pictures() {
    const char* assets = std::getenv("TRIAD_TEST_ASSETS");
    const fs::path folder =
        (assets ? fs::path(assets) : scenes_folder().parent_path() / "../shared/assets") / "subpixel";
    if (is_folder(folder)) return folder.lexically_normal().string();
    inform("The synthetic pictures are left out: they are not in " + folder.lexically_normal().string() +
           " (TRIAD_TEST_ASSETS names the folder above, --synthetic any folder).");
    return "";
}

/// Every panel at every ppd; without ppd at the panel's own.
std::vector<PanelView> displays_of(const SubpixelOptions& o) {
    std::vector<PanelView> displays;
    for (const std::string& name : o.panels) {
        const Panel panel = panel_named(name);
        for (const double ppd : o.ppd.empty() ? std::vector{panel.ppd.value_or(usual_ppd)} : o.ppd)
            displays.push_back({panel, ppd});
    }
    return displays;
}

/// The .exr pictures of a folder, by name.
std::vector<fs::path> pictures_in(const fs::path& folder) {
    if (!is_folder(folder))
        throw Error(Exit::scene, "--synthetic " + folder.string() + ": there is no such folder.");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".exr") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty()) throw Error(Exit::scene, folder.string() + ": there is no .exr file in it.");
    return files;
}

/// What is named on the command line, and the device that the first of them asks for.
class Subjects {
  public:
    explicit Subjects(const SubpixelOptions& o) : o_(o) {
        std::vector<NamedOptions> scenes;
        for (const std::string& text : o.scenes) scenes.push_back(parse_scene(text));
        std::string synthetic = o.synthetic;
        if (scenes.empty() && synthetic.empty()) {
            scenes = usual_scenes();
            synthetic = usual_pictures();
        }
        for (const NamedOptions& scene : scenes)
            all_.push_back({scene.name, [this, request = request_of(scene)] { return rendered(request); }});
        if (synthetic.empty()) return;
        for (const fs::path& path : pictures_in(synthetic))
            all_.push_back({path.stem().string(), [this, path] { return sampled(path); }});
    }
    Subjects(const Subjects&) = delete;
    Subjects& operator=(const Subjects&) = delete;

    const std::vector<SubpixelSubject>& all() const { return all_; }
    /// Null: nothing was measured.
    const DeviceInfo* device() const { return device_ ? &device_->info() : nullptr; }

  private:
    const SubpixelOptions& o_;
    std::vector<SubpixelSubject> all_;
    std::unique_ptr<Device> device_;

    RenderRequest request_of(NamedOptions scene) const {
        // the scene's own size is for other benches
        scene.arguments.insert(scene.arguments.end(), {"--size", o_.size});
        if (!o_.device.empty()) scene.arguments.insert(scene.arguments.end(), {"--device", o_.device});
        return render_options({}, scene, {});
    }

    std::unique_ptr<SubpixelSource> rendered(const RenderRequest& request) {
        if (!device_) device_ = std::make_unique<Device>(open_device(request));
        const auto scene = std::make_shared<const Scene>(load_scene(request));
        const DisplaySettings shown = display_settings(request.style, false);
        return rendered_source(*device_, {.scene = scene,
                                          .settings = settings_of(request, *scene),
                                          .exposure_ev = shown.exposure_ev,
                                          .tone_map = shown.tone_map,
                                          .samples = o_.samples,
                                          .reference_spp = o_.reference_spp});
    }

    std::unique_ptr<SubpixelSource> sampled(const fs::path& path) {
        if (!device_) device_ = std::make_unique<Device>(Device::open({.selector = o_.device}));
        return sampled_source(*device_, path.string(), display_of(read_picture(path)), o_.synthetic_samples);
    }
};

Exit run(const SubpixelOptions& o) {
    std::vector<std::string> inputs = arguments_of(o.scenes);
    inputs.insert(inputs.end(), o.panels.begin(), o.panels.end());
    inputs.push_back(o.synthetic);
    check_outputs({o.csv, o.json}, inputs);
    check_output_folder(o.folder, {"report.html", "rows.csv", "report.json"}, inputs);
    SubpixelReport report{{displays_of(o), o.rays, o.repetitions, o.seed}, {}, command_words(), date_words()};
    Subjects subjects(o);
    const InterruptGuard guard;
    run_subpixel(
        report.plan, subjects.all(),
        [&](const std::string& done) {
            detail(done);
            return !guard.interrupted();
        },
        report.rows, report.sights);
    if (o.json != "-" && o.csv != "-") std::fputs(summary_of(report).c_str(), stdout);
    const auto write_csv = [&](const fs::path& path) { write_file(path, csv_of(report)); };
    if (o.csv == "-")
        std::fputs(csv_of(report).c_str(), stdout);
    else if (!o.csv.empty())
        write_csv(o.csv);
    if (!o.json.empty()) write_report(o.json, "bench-subpixel", subjects.device(), rows_of(report));
    if (!o.folder.empty()) {
        const fs::path folder = o.folder;
        write_csv(folder / "rows.csv");
        write_report((folder / "report.json").string(), "bench-subpixel", subjects.device(), rows_of(report));
        write_subpixel_report(folder, report);
    }
    if (!guard.interrupted()) return Exit::done;
    inform("Stopped early: what was measured until then is above.");
    return Exit::interrupted;
}

}  // namespace

void add_bench_subpixel(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<SubpixelOptions>();
    CLI::App* command =
        bench.add_subcommand("subpixel",
                             "Perceived error of every method of reconstruction against rays "
                             "and time; without scenes, four of its own and the synthetic pictures");
    command->add_option("SCENE", o->scenes, "As in triad bench error")->type_name("");
    command->add_option("--panel", o->panels, "The displays (default rgb)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("PANEL,...");
    command->add_option("--ppd", o->ppd, "Pixels per degree of each (default: the panel's, else 45)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number_within(5, 1000))
        ->type_name("LIST");
    command->add_option("--rays", o->rays, "Per pixel (default 9,36,144)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(whole_number_within(1, 4096))
        ->type_name("LIST");
    command->add_option("--repetitions", o->repetitions, "With other seeds (default 2)")
        ->check(whole_number_within(1, 100))
        ->type_name("N");
    add_parsed(*command, "--size", "WxH", "Of the pictures (default 96x64)", [o](const std::string& v) {
        parse_size("--size", v);
        o->size = v;
    });
    command->add_option("--samples", o->samples, "Of references, per pixel along each axis (default 6)")
        ->check(whole_number_within(3, 24))
        ->type_name("N");
    command->add_option("--reference-spp", o->reference_spp, "Rays per sample of references (default 256)")
        ->check(whole_number_within(1, 65536))
        ->type_name("N");
    command->add_option("--synthetic", o->synthetic, "The .exr pictures of a folder, as scenes")
        ->type_name("FOLDER");
    command
        ->add_option("--synthetic-samples", o->synthetic_samples,
                     "Per pixel of those, along each axis (default 12)")
        ->check(whole_number_within(3, 64))
        ->type_name("N");
    command->add_option("--seed", o->seed, "Of the first repetition (default 1)")
        ->check(whole_number_in_32_bits())
        ->type_name("N");
    add_device(*command, o->device);
    command
        ->add_option("-o,--output", o->folder, "Folder for report.html, its plots, rows.csv and report.json")
        ->type_name("FOLDER");
    command->add_option("--csv", o->csv, "All rows (-: standard output)")->type_name("FILE");
    add_json(*command, o->json);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
