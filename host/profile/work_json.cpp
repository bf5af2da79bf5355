#include "profile/work_json.h"

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace triad {

using nlohmann::json;

std::string text_of(const WorkCounts& counts) {
    json rays = json::array(), edges = json::array();
    for (const RayCounts& r : counts.rays)
        rays.push_back({r.rays, r.nodes, r.blocks, r.triangles, r.deepest_sum, r.deepest});
    for (const EdgeCounts& e : counts.edges) edges.push_back({e.rays, e.hits, e.shadow_rays});
    return json{{"width", counts.width},
                {"height", counts.height},
                {"samples", counts.samples},
                {"rays", rays},
                {"edges", edges}}
        .dump();
}

WorkCounts work_counts_of(const std::string& text) {
    try {
        const json all = json::parse(text);
        WorkCounts counts;
        counts.width = all.at("width").get<unsigned>(), counts.height = all.at("height").get<unsigned>();
        counts.samples = all.at("samples").get<unsigned>();
        for (std::size_t i = 0; i < counts.rays.size(); ++i) {
            const json& r = all.at("rays").at(i);
            const auto number = [&](std::size_t k) { return r.at(k).get<std::uint64_t>(); };
            counts.rays[i] = {number(0), number(1), number(2),
                              number(3), number(4), std::uint32_t(number(5))};
        }
        for (std::size_t i = 0; i < counts.edges.size(); ++i) {
            const json& e = all.at("edges").at(i);
            counts.edges[i] = {e.at(0).get<std::uint64_t>(), e.at(1).get<std::uint64_t>(),
                               e.at(2).get<std::uint64_t>()};
        }
        return counts;
    } catch (const json::exception& error) {
        throw Error(Exit::scene, std::string("The capture's counted work is damaged: ") + error.what() + ".");
    }
}

}  // namespace triad
