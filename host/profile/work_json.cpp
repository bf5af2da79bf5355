#include "profile/work_json.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"
#include "base/whole_number.h"

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
        counts.width = whole_number<unsigned>(all.at("width")),
        counts.height = whole_number<unsigned>(all.at("height"));
        counts.samples = whole_number<unsigned>(all.at("samples"));
        for (std::size_t i = 0; i < counts.rays.size(); ++i) {
            const json& r = all.at("rays").at(i);
            const auto number = [&](std::size_t k) { return whole_number<std::uint64_t>(r.at(k)); };
            counts.rays[i] = {number(0), number(1), number(2),
                              number(3), number(4), std::uint32_t(number(5))};
        }
        for (std::size_t i = 0; i < counts.edges.size(); ++i) {
            const json& e = all.at("edges").at(i);
            counts.edges[i] = {whole_number<std::uint64_t>(e.at(0)), whole_number<std::uint64_t>(e.at(1)),
                               whole_number<std::uint64_t>(e.at(2))};
        }
        return counts;
    } catch (const json::exception& error) {
        throw Error(Exit::scene,
                    std::string("The capture's counted work is damaged: ") + words_of_json(error) + ".");
    }
}

}  // namespace triad
