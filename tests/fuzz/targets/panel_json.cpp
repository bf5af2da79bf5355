// A panel.json; what is read is written, and read back as it was.
#include "panel/panel_json.h"

#include <cstdlib>

#include "base/error.h"
#include "fuzz/targets/target.h"

using namespace triad;

TRIAD_FUZZ_TARGET(panel_json) {
    const Panel panel = panel_of_json(fuzz::text_of(input), "panel.json");
    const std::string text = json_of_panel(panel);
    try {
        if (json_of_panel(panel_of_json(text, "panel.json")) != text) std::abort();
    } catch (const Error&) {
        std::abort();
    }
}
