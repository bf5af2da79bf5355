#include "bench/ray_bench.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>

#include "bench/ray_sets.h"
#include "bench/tree_tracer.h"
#include "trace/node_format.h"

namespace triad {
namespace {

constexpr unsigned most_rounds = 7;
/// Long enough for a clock.
constexpr double shortest_pass = 0.01;

using RayClock = std::chrono::steady_clock;

/// The nodes of a device for as long as this lives.
class Walking {
  public:
    Walking(Device& device, BvhFormat format) : device_(device), before_(format_of(device)) {
        set_format(device, format);
    }
    ~Walking() { set_format(device_, before_); }
    Walking(const Walking&) = delete;

  private:
    Device& device_;
    BvhFormat before_;
};

struct RayKind {
    const char* name;
    bool is_occlusion;
    std::vector<dev::Ray> rays;
};

/// A kind of rays in one format of nodes.
struct RayLane {
    BvhFormat format;
    bool in_packets;
    std::shared_ptr<TreeTracer> tracer;
    unsigned passes = 1;
    std::vector<double> mrays;
    bool is_right = true;

    void trace(const RayKind& kind) const {
        if (in_packets)
            tracer->trace_packets();
        else
            tracer->trace(kind.is_occlusion);
    }
};

double seconds_of(RayLane& lane, const RayKind& kind) {
    const auto start = RayClock::now();
    for (unsigned i = 0; i < lane.passes; ++i) lane.trace(kind);
    return std::chrono::duration<double>(RayClock::now() - start).count();
}

/// What a pass over the rays has found, as bytes.
std::vector<std::uint32_t> answers(TreeTracer& tracer, bool is_occlusion) {
    if (is_occlusion) return tracer.occluded();
    const std::vector<dev::Hit> hits = tracer.hits();
    std::vector<std::uint32_t> words(hits.size() * sizeof(dev::Hit) / sizeof(std::uint32_t));
    std::memcpy(words.data(), hits.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

void measure(Device& device, const std::string& scene, const RayKind& kind, std::vector<RayLane>& lanes,
             const std::function<bool()>& go_on, std::vector<BoardRow>& rows) {
    std::vector<std::uint32_t> expected;
    for (RayLane& lane : lanes) {
        const Walking walking(device, lane.format);
        lane.mrays.clear(), lane.passes = 1;
        lane.tracer->set_rays(kind.rays);
        lane.trace(kind);  // some drivers compile at launches
        const std::vector<std::uint32_t> found = answers(*lane.tracer, kind.is_occlusion);
        if (expected.empty()) expected = found;
        lane.is_right = found == expected;
        lane.passes = unsigned(std::clamp(shortest_pass / seconds_of(lane, kind), 1.0, 1000.0));
    }
    for (unsigned round = 0; round < most_rounds && (round == 0 || go_on()); ++round)
        for (RayLane& lane : lanes)
            lane.mrays.push_back(1e-6 * double(kind.rays.size()) * lane.passes / seconds_of(lane, kind));
    for (const RayLane& lane : lanes)
        rows.push_back({.part = BoardPart::rays,
                        .name = scene + ", " + kind.name,
                        .format = std::string(name_of(lane.format)) + (lane.in_packets ? " packets" : ""),
                        .value = median_estimate(lane.mrays),
                        .unit = "M/s",
                        .is_right = lane.is_right,
                        .note = lane.is_right ? "" : "hits differ from those of the first format"});
}

}  // namespace

std::vector<BoardRow> measure_rays(Device& device, const std::string& scene, unsigned size,
                                   const std::function<bool()>& go_on) {
    const RayScene where = make_ray_scene(scene);
    std::vector<RayLane> lanes;
    for (const BvhFormat format : all_bvh_formats) {
        const Walking walking(device, format);
        lanes.push_back({format, false, std::make_shared<TreeTracer>(device, where)});
    }
    std::vector<BoardRow> rows;
    RayKind kind{"camera", false, primary_rays(where, size)};
    std::vector<RayLane> camera_lanes = lanes;
    for (const RayLane& lane : lanes)
        if (lane.tracer->walks_packets()) camera_lanes.push_back({lane.format, true, lane.tracer});
    measure(device, scene, kind, camera_lanes, go_on, rows);
    const auto ends = [&] { return ends_of(where, kind.rays, lanes.front().tracer->hits()); };
    kind = {"diffuse", false, diffuse_rays(ends())};
    measure(device, scene, kind, lanes, go_on, rows);
    kind = {"shadow", true, shadow_rays(where, ends())};
    measure(device, scene, kind, lanes, go_on, rows);
    return rows;
}

}  // namespace triad
