#include "viewer/view_state.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace triad {
namespace {

using Json = nlohmann::ordered_json;

/// Points of a course at most; then every other one is left out.
constexpr std::size_t most_points = 256;
/// Kernels that are told, the longest first.
constexpr std::size_t most_kernels = 8;

Json triple(const dvec3& v) { return {v.x, v.y, v.z}; }

Json course_json(const ViewCourse& course) {
    Json points = Json::array();
    for (const ViewCourse::Point& p : course.points) points.push_back({p.seconds, p.samples, p.relmse});
    return {{"seconds", course.seconds},
            {"samples", course.samples},
            {"relmse", course.relmse < 0 ? Json() : Json(course.relmse)},
            {"rays", course.rays},
            {"points", points}};
}

Json kernels_json(const std::map<std::string, KernelTime>& kernels) {
    std::vector<std::pair<std::string, KernelTime>> all(kernels.begin(), kernels.end());
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
    Json rows = Json::array();
    for (const auto& [name, time] : all)
        if (rows.size() < most_kernels) rows.push_back({name, time.launches, time.seconds});
    return rows;
}

}  // namespace

void ViewCourse::add(const Progress& progress) {
    const bool is_new = progress.relmse >= 0 && progress.relmse != relmse;
    seconds = seconds_before + progress.seconds;
    samples = progress.samples, relmse = progress.relmse >= 0 ? progress.relmse : relmse;
    rays = std::max(rays, progress.rays);
    if (!is_new) return;
    points.push_back({seconds, samples, relmse});
    if (points.size() <= most_points) return;
    for (std::size_t i = 0; i < points.size() / 2; ++i) points[i] = points[2 * i + 1];
    points.resize(points.size() / 2);
}

std::string json_of(const ViewFacts& f) {
    const Json state = {{"scene", f.scene},
                        {"device", f.device},
                        {"integrator", f.integrator},
                        {"cameras", f.cameras},
                        {"variants", f.variants},
                        {"panels", f.panels},
                        {"phase", f.phase},
                        {"message", f.message},
                        {"camera", f.camera},
                        {"moved", f.moved},
                        {"scale", f.scale},
                        {"exposure", f.exposure},
                        {"variant", f.variant},
                        {"panel", f.panel},
                        {"tonemap", f.tone_map},
                        {"method", f.method},
                        {"subpixels", f.subpixels},
                        {"paused", f.paused},
                        {"region", f.region},
                        {"eye", triple(f.view.eye)},
                        {"forward", triple(f.view.forward)},
                        {"orthographic", f.view.orthographic},
                        {"fov", f.fov},
                        {"size", {f.width, f.height}},
                        {"command", f.command},
                        {"frame", f.frame},
                        {"region_frame", f.region_frame},
                        {"divisor", f.divisor},
                        {"move_s", f.move_seconds ? Json(*f.move_seconds) : Json()},
                        {"packings", f.packings},
                        {"spp", f.wanted_samples},
                        {"course", course_json(f.course)},
                        {"kernels", kernels_json(f.kernels)}};
    // Names in a file are UTF-8 or nothing that a page could show.
    return state.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace triad
