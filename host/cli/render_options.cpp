#include "cli/render_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/output_options.h"
#include "cli/reconstruct_options.h"
#include "scene/limits.h"

namespace triad {
namespace {

const char* const samples_group = "Samples";
const char* const paths_group = "Paths and photons";
const char* const view_group = "View";
const char* const light_group = "Light and background";
const char* const machine_group = "Machine";

void declare_goals(CLI::App& command, RenderRequest& o) {
    command
        .add_option("--spp", o.spp,
                    "Samples per pixel (default 64; with --error or --time no limit). Of --spp, --error and "
                    "--time, what is reached first ends the render")
        ->check(whole_number_within(1, most_samples))
        ->type_name("N")
        ->group(samples_group);
    command.add_option("--error", o.error, "Stop when the estimated relMSE of the picture is this low")
        ->check(number_within(1e-30, 1e30))
        ->type_name("E")
        ->group(samples_group);
    command
        .add_option("--time", o.time,
                    "Stop after so many seconds of rendering (loading and compiling not counted)")
        ->check(number_within(1e-6, 1e9))
        ->type_name("S")
        ->group(samples_group);
    add_switch(command, "--adaptive",
               "Send samples where they lower the error most (default: with --error or --time, "
               "where it is worth it)",
               o.adaptive)
        ->group(samples_group);
}

void declare_paths(CLI::App& command, RenderRequest& o) {
    command
        .add_option("--max-depth", o.max_depth,
                    "Longest path in edges: 1 emitters only, 2 direct light (default 0: no limit)")
        ->check(whole_number_in_32_bits())
        ->type_name("N")
        ->group(paths_group);
    command
        .add_option("--roulette", o.roulette,
                    "Paths that carry less than this are ended in proportion (default 0.4: least error for "
                    "its rays; 1: most samples)")
        ->check(number_within(0.01, 10))
        ->type_name("T")
        ->group(paths_group);
    add_choice<Integrator>(
        command, "--integrator",
        "Who brings light through mirrors and glass. auto, the default: photons where something casts the "
        "light of a small source onto other surfaces; path: paths alone; photons: from every light; light: "
        "photons that the camera sees directly, paths for all else; photon-map: the classic method",
        {{"auto", Integrator::automatic},
         {"path", Integrator::path},
         {"photons", Integrator::photons},
         {"light", Integrator::light},
         {"photon-map", Integrator::photon_map}},
        o.integrator)
        ->group(paths_group);
}

void declare_photons(CLI::App& command, RenderRequest& o) {
    command
        .add_option(
            "--photons", o.photons,
            "Photons with every sample of the picture (default: one for each pixel; auto: as few as a small "
            "picture shows to be best); of photon-map: in all (default: a million)")
        ->check(whole_number_within(1, 0xffffffff))
        ->type_name("N")
        ->group(paths_group);
    command
        .add_option(
            "--photon-radius", o.photon_radius,
            "In which photons are gathered, in scene units: of the first sample, after which it shrinks, "
            "or of photon-map (default: chosen by the scene)")
        ->check(number_within(1e-12, 1e12))
        ->type_name("R")
        ->group(paths_group);
    add_switch(command, "--photon-aim",
               "Aim photons at what mirrors and refracts (default on; off: to compare)", o.aim_photons)
        ->group(paths_group);
    add_switch(command, "--final-gather",
               "With photon-map: bounce once before the map is looked up (default on)", o.final_gather)
        ->group(paths_group);
}

void declare_sampler(CLI::App& command, RenderRequest& o) {
    command.add_option("--seed", o.seed, "Of the random numbers (default 0)")
        ->check(whole_number_in_32_bits())
        ->type_name("N")
        ->group(samples_group);
    add_choice<bool>(
        command, "--sampler",
        "Where random numbers come from. sobol, the default: Sobol's sequence, scrambled; independent: every "
        "sample for itself",
        {{"sobol", false}, {"independent", true}}, o.independent)
        ->group(samples_group);
    add_switch(command, "--texture-levels",
               "Average colours of textures over what a sample stands for, which shrinks with every sample "
               "(default on; off: the texels of the images, to compare)",
               o.texture_levels)
        ->group(samples_group);
    add_parsed(command, "--samples", "A:B|share:I/K",
               "Only this half-open range of sample indices, or the I-th (from 0) of K equal parts of --spp, "
               "for triad merge",
               [&o](const std::string& v) {
                   if (v.starts_with("share:"))
                       o.share = parse_share("--samples", v);
                   else
                       o.samples = parse_range("--samples", v);
               })
        ->group(samples_group);
}

void declare_picture(CLI::App& command, RenderRequest& o) {
    add_parsed(command, "--size", "WxH", "Of the picture (default 1280x720, or the aspect of the camera)",
               [&o](const std::string& v) { o.size = parse_size("--size", v); })
        ->group(view_group);
    add_parsed(command, "--crop", "X,Y,W,H", "Render this part of the picture only",
               [&o](const std::string& v) { o.crop = parse_crop("--crop", v); })
        ->group(view_group);
    add_parsed(
        command, "--pixel", "X,Y",
        "Print everything about one pixel instead of making a picture: its samples, paths, lights, errors",
        [&o](const std::string& v) {
            const auto n = parse_numbers("--pixel", v, 2);
            for (double x : n)
                if (x < 0 || x > 1e9 || x != std::floor(x))
                    throw Error(Exit::usage, "--pixel " + v + ": expected two whole numbers.");
            o.pixel = {unsigned(n[0]), unsigned(n[1])};
        })
        ->group(view_group);
}

void declare_camera(CLI::App& command, RenderRequest& o) {
    CLI::Option* camera = command.add_option("--camera", o.camera, "Camera of the file (default: the first)")
                              ->type_name("NAME|INDEX")
                              ->group(view_group);
    CLI::Option* orbit =
        add_parsed(command, "--orbit", "AZIMUTH,ELEVATION[,ZOOM]",
                   "Frame the scene from there, in degrees from the front to the right and upwards; 2 is "
                   "twice as large",
                   [&o](const std::string& v) {
                       const bool zoomed = std::count(v.begin(), v.end(), ',') > 1;
                       const auto n = parse_numbers("--orbit", v, zoomed ? 3 : 2);
                       o.orbit = {n[0], n[1], zoomed ? n[2] : 1.0};
                       if (std::abs(n[0]) > 1e6 || std::abs(n[1]) > 89.9 ||
                           !((*o.orbit)[2] >= 0.01 && (*o.orbit)[2] <= 1000))
                           throw Error(Exit::usage, "--orbit " + v +
                                                        ": expected an elevation within 89.9 degrees and a "
                                                        "zoom of .01 to 1000.");
                   })
            ->excludes(camera)
            ->group(view_group);
    add_parsed(command, "--look-at", "EX,EY,EZ,TX,TY,TZ", "From this eye point to this target",
               [&o](const std::string& v) {
                   const auto n = parse_numbers("--look-at", v, 6);
                   for (const double x : n)
                       if (std::abs(x) > limits::ray_start)
                           throw Error(Exit::usage, "--look-at " + v + ": expected coordinates up to " +
                                                        limits::text_of(limits::ray_start) +
                                                        "; scale the scene down.");
                   o.look_at.emplace();
                   std::copy(n.begin(), n.end(), o.look_at->begin());
               })
        ->excludes(camera)
        ->excludes(orbit)
        ->group(view_group);
    command.add_option("--fov", o.fov, "Vertical angle of view in degrees")
        ->check(number_within(0.001, 179))
        ->type_name("DEG")
        ->group(view_group);
    command.add_option("--aperture", o.aperture, "Lens radius in scene units (default 0: all sharp)")
        ->check(number_within(0, limits::ray_start))
        ->type_name("R")
        ->group(view_group);
    command
        .add_option(
            "--focus", o.focus,
            "Distance that is sharp, along the view (default: the target, or the middle of the scene)")
        ->check(number_within(1 / limits::squared, limits::squared))
        ->type_name("D")
        ->group(view_group);
}

void declare_light(CLI::App& command, RenderRequest& o) {
    add_choice<Spectral>(command, "--spectral",
                         "Wavelengths of paths. auto, the default: a path has three wavelengths from the "
                         "first body on that disperses; off: RGB; "
                         "full: four per path; classic: one from the camera on",
                         {{"auto", Spectral::automatic},
                          {"off", Spectral::off},
                          {"full", Spectral::full},
                          {"classic", Spectral::classic}},
                         o.spectral)
        ->group(light_group);
    command
        .add_option("--glass", o.glass,
                    "Make this material of the file that glass of the catalogue (docs/spectral.md); several "
                    "allowed")
        ->type_name("MATERIAL=NAME")
        ->allow_extra_args(false)
        ->group(light_group);
    CLI::Option* env = command.add_option("--env", o.env_path, "Lat-long environment, .hdr or .exr")
                           ->type_name("FILE")
                           ->group(light_group);
    add_parsed(command, "--look", "studio|sky|white",
               "Light of Triad's own making (default: studio, where the scene has no light)",
               [&o](const std::string& v) { o.look = look_named(v); })
        ->excludes(env)
        ->group(light_group);
    add_parsed(command, "--ground", "on|off|auto",
               "A matte floor below the scene (auto, the default: where it has neither light nor camera)",
               [&o](const std::string& v) {
                   if (v != "on" && v != "off" && v != "auto")
                       throw Error(Exit::usage, "--ground " + v + ": there are on, off and auto.");
                   o.ground.reset();
                   if (v != "auto") o.ground = v == "on";
               })
        ->group(light_group);
    command
        .add_option("--env-rotate", o.env_rotate,
                    "Turn environment or sky about the vertical axis, from +x towards +z")
        ->check(number_within(-1e6, 1e6))
        ->type_name("DEG")
        ->group(light_group);
    command.add_option("--env-strength", o.env_strength, "Brightness of environment or sky (default 1)")
        ->check(number_within(0, limits::brightness))
        ->type_name("X")
        ->group(light_group);
    add_parsed(command, "--background", "env|transparent|#RRGGBB",
               "What is seen behind everything (default env)",
               [&o](const std::string& v) {
                   o.transparent = v != "env";
                   if (v != "env" && v != "transparent") o.style.background = parse_colour("--background", v);
               })
        ->group(light_group);
}

void declare_machine(CLI::App& command, RenderRequest& o) {
    command
        .add_option(
            "--device", o.device,
            "Number, cpu, gpu, or part of a name (see triad devices); several with commas between share "
            "the picture, all is every one; SEL/N is a CPU in N parts")
        ->type_name("SEL[/N],...|all")
        ->group(machine_group);
    command.add_option("--threads", o.threads, "Cores to use, here and on CPU devices (default 0: all)")
        ->check(whole_number_in_32_bits())
        ->type_name("N")
        ->group(machine_group);
    add_format(command, o.format)->group(machine_group);
    add_path_driver(command, o.path_driver)->group(machine_group);
    command.add_flag("--force", o.force, "Render even on a device that triad check found wrong")
        ->group(machine_group);
    add_kernels(command, o.kernels_path)->group(machine_group);
}

}  // namespace

void declare_workload(CLI::App& command, RenderRequest& o) {
    command.add_option("SCENE", o.scene_path, "glTF file, .gltf or .glb (default: the built-in scene)")
        ->type_name("");
    declare_goals(command, o);
    declare_sampler(command, o);
    declare_picture(command, o);
    declare_camera(command, o);
    declare_scene(command, o);
    declare_light(command, o);
    declare_paths(command, o);
    declare_photons(command, o);
    declare(command, o.reconstruct);
    declare_machine(command, o);
}

void declare(CLI::App& command, RenderRequest& o) {
    declare_outputs(command, o);
    declare_workload(command, o);
}

}  // namespace triad
