#include "report/render_report.h"

#include "base/progress.h"
#include "base/text.h"
#include "kernels/types.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

double mega_rays(const RenderOutcome& outcome) {
    return outcome.rays == 0 ? 0 : double(outcome.rays) / outcome.result.seconds / 1e6;
}

Json rows_of(const std::vector<DeviceWork>& devices) {
    Json rows = Json::array();
    for (const DeviceWork& work : devices)
        rows.push_back({{"name", work.device->name},
                        {"driver", work.device->driver},
                        {"compute_units", work.device->compute_units},
                        {"samples", work.samples},
                        {"busy_s", work.busy_seconds},
                        {"idle", work.idle},
                        {"failure", work.failure}});
    return rows;
}

}  // namespace

Json render_row(RenderSession& session, const RenderOutcome& outcome) {
    const RenderRequest& request = session.request();
    const Film& film = outcome.film;
    const SampleNumbers& numbers = outcome.numbers;
    const Renderer& renderer = session.renderer();
    const auto& n = film.counters;
    return {
        {"scene", request.scene_path.empty() ? "built-in" : request.scene_path},
        {"scene_hash", film.scene},
        {"settings_hash", film.settings},
        {"width", film.width},
        {"height", film.height},
        {"spp", spp_json(numbers)},
        {"spp_min", numbers.least},
        {"spp_max", numbers.most},
        {"samples", numbers.total},
        {"adaptive", session.goal().adaptive && renderer.photons() == 0},
        {"stopped_by", to_string(outcome.result.stop)},
        {"seed", request.seed},
        {"integrator", renderer.integrator()},
        {"photons_per_sample", renderer.photons()},
        {"pilot_s", renderer.pilot_seconds()},
        {"photon_s", renderer.photon_seconds()},
        {"complete", outcome.complete()},
        {"load_s", session.load_seconds()},
        {"build_s", renderer.build_seconds()},
        {"compile_s", renderer.compile_seconds()},
        {"render_s", outcome.result.seconds},
        {"render_cpu_s", outcome.result.processor_seconds},
        {"relmse", outcome.relmse < 0 ? Json() : Json(outcome.relmse)},
        {"trend", outcome.result.trend ? Json(*outcome.result.trend) : Json()},
        {"perceived_noise", outcome.result.perceived_noise ? Json(*outcome.result.perceived_noise) : Json()},
        {"rays", n[COUNTER_RAYS]},
        {"mrays", mega_rays(outcome)},
        {"device", session.device().info().name},
        {"driver", session.device().info().driver},
        {"format", name_of(format_of(session.device()))},
        {"path_driver", name_of(path_driver_of(session.device()))},
        {"devices", rows_of(outcome.result.devices)},
        {"scene_bytes", bytes_of(session.scene())},
        {"device_bytes", renderer.device_bytes()},
        {"film_bytes", film_bytes(film)},
        {"bins", {film.bins_x, film.bins_y}},
        {"reconstruct", request.style.reconstruction.method},
        {"denoise", name_of(request.style.denoise)},
        {"left_out", left_out(renderer.features())},
        {"not_finite", n[COUNTER_NOT_FINITE]},
        {"saturated", n[COUNTER_SATURATED]},
        {"truncated", n[COUNTER_TRUNCATED]},
        {"cut_energy", double(n[COUNTER_CUT_ENERGY]) / CUT_ENERGY_ONE}};
}

std::string render_sentence(RenderSession& session, const RenderOutcome& outcome) {
    const RenderRequest& request = session.request();
    const SampleNumbers& numbers = outcome.numbers;
    const RenderResult& result = outcome.result;
    std::string names;
    for (const std::string& path : request.outputs) names += (names.empty() ? "" : ", ") + path;
    if (!request.film_path.empty()) names += (names.empty() ? "" : ", ") + request.film_path;
    const std::string spread =
        numbers.least == numbers.most ? "" : format(" (%u to %u)", numbers.least, numbers.most);
    const std::string perceived =
        result.perceived_noise ? format(", perceived noise %.2g", *result.perceived_noise) : "";
    const std::string denoised =
        request.style.denoise == Denoiser::off
            ? ""
            : std::string(" before ") + name_of(request.style.denoise) + " denoised it";
    return format("%s: %ux%u, %s samples per pixel%s in %.1f s, %.2f Mrays/s, relMSE %s%s%s", names.c_str(),
                  outcome.film.width, outcome.film.height, spp_text(numbers.mean).c_str(), spread.c_str(),
                  result.seconds, mega_rays(outcome),
                  outcome.relmse < 0 ? "not known" : relmse_text(outcome.relmse, result.trend).c_str(),
                  perceived.c_str(), denoised.c_str());
}

}  // namespace triad
