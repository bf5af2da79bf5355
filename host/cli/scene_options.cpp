/// What of the scene's file is rendered.
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "cli/render_options.h"

namespace triad {
namespace {

const char* const scene_group = "Scene";

}  // namespace

void declare_scene(CLI::App& command, RenderRequest& o) {
    command.add_option("--scene", o.scene_index, "Which scene of the file (default: the one it names)")
        ->check(whole_number_within(0, 0x7fffffff))
        ->type_name("N")
        ->group(scene_group);
    command
        .add_option("--variant", o.variant,
                    "Of the file's materials (KHR_materials_variants; triad info lists them; default: every "
                    "primitive's own material)")
        ->type_name("VARIANT")
        ->group(scene_group);
    command
        .add_option("--animation", o.animation,
                    "Of the file, or none for nodes as they are (default: the first)")
        ->type_name("NAME|INDEX|none")
        ->group(scene_group);
    command.add_option("--pose-time", o.pose_time, "Where in the animation, in seconds (default 0)")
        ->check(number_within(-1e9, 1e9))
        ->type_name("T")
        ->group(scene_group);
    command
        .add_option("--point-size", o.point_size,
                    "Width of the file's points and lines, in pixels of the picture (default 1.5)")
        ->check(number_within(0.01, 1000))
        ->type_name("PIXELS")
        ->group(scene_group);
    add_max_texture(command, o.max_texture)->group(scene_group);
    command
        .add_flag("--strict", o.strict,
                  "Damaged data of the scene (images, normals and the like) end it with exit code 2")
        ->group(scene_group);
}

}  // namespace triad
