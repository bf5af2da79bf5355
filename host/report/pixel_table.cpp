#include "report/pixel_table.h"

#include <algorithm>
#include <cstdio>

#include "base/text.h"
#include "kernels/types.h"

namespace triad {
namespace {

Json rgb(const dvec3& v) { return {v.x, v.y, v.z}; }

std::string rgb_text(const dvec3& v) { return format(" %11.5g %11.5g %11.5g", v.x, v.y, v.z); }

double sum_of(const dvec3& v) { return v.x + v.y + v.z; }

/// How the path goes on from a vertex, or why it does not.
std::string event_text(const RecordedVertex& v) {
    switch (v.end) {
        case PATH_LEFT_SCENE:
            return "left the scene";
        case PATH_UNLIT:
            return "ends: unlit";
        case PATH_LONGEST:
            return "ends: --max-depth";
        case PATH_ABSORBED:
            return "ends: absorbed";
        case PATH_ROULETTE:
            return "ends: roulette";
        default:
            break;
    }
    const std::string kind = v.event & BSDF_DIFFUSE ? "diffuse" : v.event & BSDF_GLOSSY ? "glossy" : "mirror";
    if (!(v.event & BSDF_TRANSMIT)) return kind;
    return v.event & BSDF_GLOSSY ? "through, glossy" : "through, clear";
}

std::string material_text(const RecordedVertex& v, const Scene& scene) {
    if (v.material == TRIAD_NONE) return "";
    const std::string& name = scene.materials[v.material].name;
    return name.empty() ? "material " + std::to_string(v.material) : name;
}

Json to_json(const RecordedVertex& v, const Scene& scene, const std::vector<std::string>& names) {
    const auto name = [&](std::uint32_t source) {
        return source == TRIAD_NONE ? Json() : Json(names[source]);
    };
    return {{"position", v.end == PATH_LEFT_SCENE ? Json() : rgb(v.position)},
            {"direction", v.end == PATH_LEFT_SCENE ? rgb(v.position) : Json()},
            {"material", v.material == TRIAD_NONE ? Json() : Json(material_text(v, scene))},
            {"event", event_text(v)},
            {"found", rgb(dvec3(v.found))},
            {"found_from", name(v.found_source)},
            {"direct", rgb(dvec3(v.direct))},
            {"direct_from", name(v.direct_source)},
            {"throughput", rgb(dvec3(v.throughput))},
            {"edge", v.edge},
            {"wavelength", v.wavelength > 0 ? Json(v.wavelength) : Json()}};
}

/// A path of the table, a line for each vertex.
std::string path_text(const RecordedPath& path, const Scene& scene, const std::vector<std::string>& names) {
    std::string text;
    for (const RecordedVertex& v : path.vertices) {
        const bool away = v.end == PATH_LEFT_SCENE;
        text += format("    %4u  %s(%.5g, %.5g, %.5g)  %s%s%s", v.edge, away ? "towards " : "", v.position.x,
                       v.position.y, v.position.z, material_text(v, scene).c_str(), away ? "" : "  ",
                       event_text(v).c_str());
        if (v.found_source != TRIAD_NONE)
            text +=
                format("; found %.4g %.4g %.4g of ", v.found.x, v.found.y, v.found.z) + names[v.found_source];
        if (v.direct_source != TRIAD_NONE)
            text += format("; sampled %.4g %.4g %.4g of ", v.direct.x, v.direct.y, v.direct.z) +
                    names[v.direct_source];
        if (v.wavelength > 0) text += format("; %.1f nm", v.wavelength);
        text += "\n";
    }
    if (path.met > path.vertices.size())
        text += format("          and %zu more\n", path.met - path.vertices.size());
    return text;
}

}  // namespace

Json to_json(const PixelReport& r, const Scene& scene, const std::vector<std::string>& names, unsigned x,
             unsigned y) {
    Json halves = Json::array(), depths = Json::array(), sources = Json::array(), largest = Json::array();
    for (int half = 0; half < 2; ++half)
        halves.push_back({{"samples", r.half_samples[half]}, {"mean", rgb(r.half_means[half])}});
    for (std::size_t k = 0; k < r.depths.size(); ++k)
        depths.push_back({{"edges", k + 1},
                          {"paths", r.depths[k].paths},
                          {"found", rgb(r.depths[k].found)},
                          {"direct", rgb(r.depths[k].direct)}});
    for (const PixelReport::Source& s : r.sources)
        sources.push_back({{"light", s.name}, {"found", rgb(s.found)}, {"direct", rgb(s.direct)}});
    for (std::size_t i = 0; i < r.largest.size(); ++i) {
        const RecordedPath& path = r.largest[i];
        Json vertices = Json::array();
        for (const RecordedVertex& v : path.vertices) vertices.push_back(to_json(v, scene, names));
        largest.push_back({{"sample", path.sample},
                           {"half", path.half},
                           {"bin", path.bin},
                           {"value", rgb(dvec3(path.value))},
                           {"share", r.share(i)},
                           {"edges", path.met},
                           {"vertices", std::move(vertices)}});
    }
    return {{"x", x},
            {"y", y},
            {"samples", r.samples},
            {"not_finite", r.not_finite},
            {"rays", r.rays},
            {"mean", rgb(r.mean)},
            {"alpha", r.alpha},
            {"variance", rgb(r.variance)},
            {"mean_variance", rgb(r.mean_variance)},
            {"halves", std::move(halves)},
            {"by_depth", std::move(depths)},
            {"by_light", std::move(sources)},
            {"largest", std::move(largest)}};
}

std::string table_text(const PixelReport& r, const Scene& scene, const std::vector<std::string>& names,
                       unsigned x, unsigned y) {
    const double whole = std::max(sum_of(r.mean), 1e-300);
    const auto share = [&](const dvec3& a, const dvec3& b) {
        return format(" %6.2f %%\n", 100 * (sum_of(a) + sum_of(b)) / whole);
    };
    std::string text =
        format("pixel %u, %u: %llu samples, %.2f rays each, %llu not finite, alpha %.4g\n\n", x, y,
               static_cast<unsigned long long>(r.samples), double(r.rays) / double(r.samples),
               static_cast<unsigned long long>(r.not_finite), r.alpha);
    text += format("%-34s %11s %11s %11s\n", "", "R", "G", "B");
    const auto line = [&](const std::string& name, const dvec3& v) {
        text += format("%-34s", name.c_str()) + rgb_text(v) + "\n";
    };
    line("mean", r.mean);
    for (int half = 0; half < 2; ++half)
        line(format("half %d, %llu samples", half, static_cast<unsigned long long>(r.half_samples[half])),
             r.half_means[half]);
    line("variance of one sample", r.variance);
    line("variance of the mean, by halves", r.mean_variance);

    text += format("\n%5s %10s  %-35s  %-35s\n", "edges", "paths", "emission that paths hit: R, G, B",
                   "lights sampled: R, G, B");
    for (std::size_t k = 0; k < r.depths.size(); ++k)
        text += format("%5zu %10llu ", k + 1, static_cast<unsigned long long>(r.depths[k].paths)) +
                rgb_text(r.depths[k].found) + " " + rgb_text(r.depths[k].direct) +
                share(r.depths[k].found, r.depths[k].direct);
    std::size_t width = 17;
    for (const PixelReport::Source& s : r.sources) width = std::max(width, s.name.size());
    text += "\nlight" + std::string(width - 5, ' ') +
            format("  %-35s  %-35s\n", "emission that paths hit: R, G, B", "lights sampled: R, G, B");
    for (const PixelReport::Source& s : r.sources)
        text += s.name + std::string(width - s.name.size(), ' ') + rgb_text(s.found) + " " +
                rgb_text(s.direct) + share(s.found, s.direct);
    text += "\nlargest samples\n";
    for (std::size_t i = 0; i < r.largest.size(); ++i) {
        const RecordedPath& path = r.largest[i];
        text += format("  sample %llu, half %u: %.5g %.5g %.5g, %.2f %% of the pixel, %.1f times its mean\n",
                       static_cast<unsigned long long>(path.sample), path.half, path.value.x, path.value.y,
                       path.value.z, 100 * r.share(i), r.share(i) * double(r.samples)) +
                path_text(path, scene, names);
    }
    return text;
}

}  // namespace triad
