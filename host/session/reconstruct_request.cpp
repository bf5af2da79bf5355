#include "session/reconstruct_request.h"

#include "base/error.h"
#include "session/panel_file.h"

namespace triad {
Reconstruction ReconstructRequest::make(std::optional<uvec2> film_bins) const {
    ReconstructionChoice choice{method, filter, bins ? bins : film_bins};
    if (panel.empty() && refine_steps)
        throw Error(Exit::usage, "--refine is for a display: name it with --panel.");
    choice.refine_steps = refine_steps.value_or(choice.refine_steps);
    if (panel.empty() && (ppd || distance))
        throw Error(Exit::usage, "--ppd and --distance say how a display is seen: name it with --panel.");
    if (distance && !pitch)
        throw Error(Exit::usage, "--distance needs --pitch, the size of a pixel in the same unit.");
    if (!panel.empty()) {
        PanelView view{panel_named(panel), usual_ppd};
        view.ppd = distance ? pixels_per_degree(*distance, *pitch)
                            : ppd.value_or(view.panel.ppd.value_or(usual_ppd));
        choice.panel = view;
    }
    return reconstruction_of(choice);
}

}  // namespace triad
