#include "cli/output_options.h"

namespace triad {

void declare_style(CLI::App& command, OutputStyle& style) {
    const char* const group = "Output";
    command.add_option("--exposure", style.exposure, "In EV, for tone-mapped outputs (default 0)")
        ->check(CLI::Range(-64.0, 64.0))
        ->type_name("EV")
        ->group(group);
    command.add_option("--tonemap", style.tone_map, "none, aces, agx or khronos (the default: PBR Neutral)")
        ->check(CLI::IsMember({"none", "aces", "agx", "khronos"}))
        ->type_name("NAME")
        ->group(group);
    command.add_option("--bits", style.bits, "Of PNG outputs, 8 or 16 (default 8)")
        ->check(CLI::IsMember({8, 16}))
        ->type_name("N")
        ->group(group);
    command.add_flag("--half", style.half, "16-bit EXR instead of 32-bit")->group(group);
}

}  // namespace triad
