#include "cli/suite.h"

#include <cstdio>
#include <memory>

#include "cli/bench_error.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

struct SuiteScene {
    const char* name;
    double baseline;   ///< e0 of docs/bench.md
    const char* file;  ///< below the folder of scenes; "": the built-in scene
    const char* sky;   ///< likewise; "": none
    std::vector<std::string> options;
};

// scenes/suite/README.md says what each is there for. Exposure changes only what is looked at: the PNG, and
// with it FLIP.
const SuiteScene scenes[] = {
    {"built-in", 47.8, "", "", {"--size", "320x180"}},
    {"cornell", 250, "cornell/cornell.gltf", "", {"--size", "240x240"}},
    {"knot",
     378,
     "suite/knot.glb",
     "suite/sky.hdr",
     {"--size", "320x180", "--env-strength", "1.7", "--env-rotate", "60"}},
    {"metals", 26.9, "suite/metals.glb", "suite/sky.hdr", {"--size", "320x180", "--env-strength", "0.35"}},
    {"glass", 7.36, "suite/glass.glb", "", {"--size", "320x180", "--exposure", "0.6"}},
    {"plates", 52.8, "suite/plates.glb", "", {"--size", "320x180", "--exposure", "0.5"}},
    {"lamps",
     13.4,
     "suite/lamps.glb",
     "suite/sky.hdr",
     {"--size", "320x180", "--env-strength", "0.03", "--exposure", "1.5"}},
    {"garden", 67.4, "suite/garden.glb", "suite/sky.hdr", {"--size", "320x180", "--exposure", "-0.4"}},
    {"rotunda", 19.9, "suite/rotunda.glb", "suite/sun.hdr", {"--size", "320x180", "--exposure", "-0.7"}},
    {"corridor", 11.5, "suite/corridor.glb", "suite/sun.hdr", {"--size", "320x180", "--exposure", "1.8"}},
};

}  // namespace

fs::path scenes_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::string places;
    for (const char* way : {"../share/triad/scenes", "../../scenes"}) {
        const fs::path folder = (program / way).lexically_normal();
        if (fs::exists(folder / "suite" / "knot.glb", error)) return folder;
        places += (places.empty() ? "" : " nor in ") + folder.string();
    }
    throw Error(Exit::scene,
                "The suite's scenes are neither in " + places +
                    "; install the program with cmake --install, or run it from its build folder.");
}

std::vector<NamedOptions> suite_scenes(const fs::path& folder) {
    std::vector<NamedOptions> all;
    for (const SuiteScene& scene : scenes) {
        NamedOptions one{scene.name, {}};
        if (*scene.file) one.arguments.push_back((folder / scene.file).string());
        if (*scene.sky) one.arguments.insert(one.arguments.end(), {"--env", (folder / scene.sky).string()});
        one.arguments.insert(one.arguments.end(), scene.options.begin(), scene.options.end());
        all.push_back(std::move(one));
    }
    return all;
}

const std::map<std::string, double>& suite_baselines() {
    static const std::map<std::string, double> baselines = [] {
        std::map<std::string, double> all;
        for (const SuiteScene& scene : scenes) all[scene.name] = scene.baseline;
        return all;
    }();
    return baselines;
}

void add_bench_suite(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<BenchErrorOptions>();
    o->title = "The suite: error against time";
    o->spp = suite_spp, o->reference_spp = suite_reference_spp;
    o->baselines = suite_baselines();
    declare(bench, *o);
    auto list = std::make_shared<bool>();
    bench.add_flag("--list", *list, "Print the suite's scenes with their options of triad render, and end");
    // Without that of help, which every command gets anew (add_commands).
    const std::vector<CLI::Option*> options =
        bench.get_options([&](const CLI::Option* option) { return option != bench.get_help_ptr(); });
    bench.parse_complete_callback([options, &bench] {
        if (bench.get_subcommands().empty()) return;
        for (const CLI::Option* option : options)
            if (option->count() > 0)
                throw Error(Exit::usage, option->get_name() + " stands before " +
                                             bench.get_subcommands().front()->get_name() +
                                             ": options of a bench follow its name.");
    });
    bench.callback([o, list, &bench, &exit] {
        if (!bench.get_subcommands().empty()) return;
        if (*list) {
            for (const NamedOptions& scene : suite_scenes(scenes_folder()))
                std::printf("%s: %s\n", scene.name.c_str(), scene.text().c_str());
            return;
        }
        for (const NamedOptions& scene : suite_scenes(scenes_folder()))
            o->scenes.push_back(scene.name + ": " + scene.text());
        if (!o->common.empty()) o->baselines.clear();  // they may ask for other pictures than were scored
        exit = run_bench_error(*o);
    });
}

}  // namespace triad
