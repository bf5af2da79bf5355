#pragma once
/// A render as JSON and in words.
#include "report/report.h"
#include "session/render_session.h"

namespace triad {

/// The row of `triad render --json`.
Json render_row(RenderSession& session, const RenderOutcome& outcome);

/// "out.png: 640x360, 64 samples per pixel in 3.2 s, 4.1 Mrays/s, relMSE 0.0021".
std::string render_sentence(RenderSession& session, const RenderOutcome& outcome);

}  // namespace triad
