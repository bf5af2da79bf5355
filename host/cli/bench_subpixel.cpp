#include "cli/bench_subpixel.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/command_line.h"
#include "cli/compare_perceived.h"
#include "cli/experiment.h"
#include "cli/suite.h"
#include "report/subpixel_report.h"
#include "session/output.h"
#include "session/panel_file.h"
#include "session/prepare.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr double usual_ppd = 45;

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
    std::error_code error;
    if (fs::is_directory(folder, error)) return folder.lexically_normal().string();
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

ToneMap tone_map_of(const std::string& name) {
    static const std::map<std::string, ToneMap> maps = {{"none", ToneMap::none},
                                                        {"aces", ToneMap::aces},
                                                        {"agx", ToneMap::agx},
                                                        {"khronos", ToneMap::khronos}};
    return maps.at(name);
}

class Bench {
  public:
    Bench(const SubpixelOptions& o, SubpixelReport& report) : o_(o), report_(report) {}

    void run() {
        std::vector<NamedOptions> scenes;
        for (const std::string& text : o_.scenes) scenes.push_back(parse_scene(text));
        std::string synthetic = o_.synthetic;
        if (scenes.empty() && synthetic.empty()) {
            scenes = usual_scenes();
            synthetic = usual_pictures();
        }
        for (const PanelView& view : report_.plan.displays) displays_.push_back(subpixel_display(view));
        for (const NamedOptions& scene : scenes)
            if (!guard_.interrupted()) render(scene);
        if (!synthetic.empty()) sample(synthetic);
    }

    const DeviceInfo* device() const { return device_ ? &device_->info() : nullptr; }

  private:
    bool go_on(const std::string& done) {
        detail(done);
        return !guard_.interrupted();
    }

    Device& open(const RenderRequest& options) {
        if (!device_) device_ = std::make_unique<Device>(open_device(options));
        return *device_;
    }

    void render(const NamedOptions& name) {
        inform("Scene " + name.name);
        NamedOptions sized = name;  // the scene's own size is for other benches
        sized.arguments.insert(sized.arguments.end(), {"--size", o_.size});
        if (!o_.device.empty()) sized.arguments.insert(sized.arguments.end(), {"--device", o_.device});
        const RenderRequest options = render_options({}, sized, {});
        const Scene scene = load_scene(options);
        RenderedView view;
        view.scene = &scene, view.settings = settings_of(options, scene);
        view.exposure_ev = float(options.style.exposure), view.tone_map = tone_map_of(options.style.tone_map);
        view.samples = o_.samples, view.reference_spp = o_.reference_spp;
        const auto source = rendered_source(open(options), view);
        run_subpixel(
            report_.plan, displays_, name.name, *source, [this](const std::string& s) { return go_on(s); },
            report_.rows);
    }

    /// The pictures of a folder, many samples a pixel.
    void sample(const fs::path& folder) {
        std::error_code absent;
        if (!fs::is_directory(folder, absent))
            throw Error(Exit::scene, "--synthetic " + folder.string() + ": there is no such folder.");
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".exr") files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        if (files.empty()) throw Error(Exit::scene, folder.string() + ": there is no .exr file in it.");
        for (const fs::path& path : files) {
            if (guard_.interrupted()) return;
            const unsigned n = o_.synthetic_samples;
            inform("Picture " + path.stem().string());
            RgbImage picture = display_of(path.string(), read_picture(path));
            const uvec2 size{picture.width / n * n, picture.height / n * n};
            if (picture.rgb.empty() || size != uvec2(picture.width, picture.height))
                throw Error(
                    Exit::scene,
                    path.string() + format(": R, G and B, and a size that %u divides, are needed.", n));
            if (!device_) device_ = std::make_unique<Device>(Device::open({.selector = o_.device}));
            const auto source = sampled_source(*device_, std::move(picture), n);
            run_subpixel(
                report_.plan, displays_, path.stem().string(), *source,
                [this](const std::string& s) { return go_on(s); }, report_.rows);
        }
    }

    const SubpixelOptions& o_;
    SubpixelReport& report_;
    std::vector<SubpixelDisplay> displays_;
    std::unique_ptr<Device> device_;
    const InterruptGuard guard_;
};

Exit run(const SubpixelOptions& o) {
    for (const std::string& path : {o.csv, o.json})
        if (!path.empty()) check_writable(path);
    if (!o.folder.empty()) fs::create_directories(o.folder);
    SubpixelReport report{{displays_of(o), o.rays, o.repetitions, o.seed}, {}, command_words(), date_words()};
    Bench bench(o, report);
    bench.run();
    if (o.json != "-" && o.csv != "-") std::fputs(summary_of(report).c_str(), stdout);
    const auto write_csv = [&](const fs::path& path) { write_file(path, csv_of(report)); };
    if (o.csv == "-")
        std::fputs(csv_of(report).c_str(), stdout);
    else if (!o.csv.empty())
        write_csv(o.csv);
    if (!o.json.empty()) write_report(o.json, "bench-subpixel", bench.device(), rows_of(report));
    if (!o.folder.empty()) {
        const fs::path folder = o.folder;
        write_csv(folder / "rows.csv");
        write_report((folder / "report.json").string(), "bench-subpixel", bench.device(), rows_of(report));
        write_subpixel_report(folder, report);
    }
    return Exit::done;
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
        ->type_name("LIST");
    command->add_option("--ppd", o->ppd, "Pixels per degree of each (default: the panel's, else 45)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(number_within(5, 1000))
        ->type_name("LIST");
    command->add_option("--rays", o->rays, "Per pixel (default 9,36,144)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1, 4096))
        ->type_name("LIST");
    command->add_option("--repetitions", o->repetitions, "With other seeds (default 2)")
        ->check(CLI::Range(1, 100))
        ->type_name("N");
    command->add_option("--size", o->size, "Of the pictures (default 96x64)")->type_name("WxH");
    command->add_option("--samples", o->samples, "Of references, per pixel along each axis (default 6)")
        ->check(CLI::Range(3, 24))
        ->type_name("N");
    command->add_option("--reference-spp", o->reference_spp, "Rays per sample of references (default 256)")
        ->check(CLI::Range(1, 65536))
        ->type_name("N");
    command->add_option("--synthetic", o->synthetic, "The .exr pictures of a folder, as scenes")
        ->type_name("FOLDER");
    command
        ->add_option("--synthetic-samples", o->synthetic_samples,
                     "Per pixel of those, along each axis (default 12)")
        ->check(CLI::Range(3, 64))
        ->type_name("N");
    command->add_option("--seed", o->seed, "Of the first repetition (default 1)")->type_name("N");
    command->add_option("--device", o->device, "Number, cpu, gpu, or part of a name")->type_name("SEL");
    command
        ->add_option("-o,--output", o->folder, "Folder for report.html, its plots, rows.csv and report.json")
        ->type_name("FOLDER");
    command->add_option("--csv", o->csv, "All rows (-: standard output)")->type_name("FILE");
    command->add_option("--json", o->json, "All rows (-: standard output)")->type_name("FILE");
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
