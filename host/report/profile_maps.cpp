#include "report/profile_maps.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/text.h"
#include "kernels/types.h"
#include "page/html.h"
#include "report/error_pictures.h"

namespace triad {
namespace {

constexpr const char* maps_style = R"css(
.maps { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr)); gap: 1rem; }
.maps img { image-rendering: pixelated; }
)css";

std::string legend(const ColourScale& scale, const std::string& low, const std::string& high) {
    return "<div class=\"scale\"><i style=\"background:" + css_gradient(scale) + "\"></i><span>" +
           html_escape(low) + "</span><span>" + html_escape(high) + "</span></div>";
}

std::string map_html(const std::vector<float>& values, unsigned width, unsigned height,
                     const std::string& words, const char* pattern) {
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double high = std::max<double>(1e-12, sorted[std::size_t(0.995 * double(sorted.size() - 1))]);
    const ColourScale scale{0, high, false};
    return "<figure><img alt=\"" + html_escape(words) + "\" src=\"" +
           data_uri("image/png", false_colour_png(values, width, height, scale)) + "\"><figcaption>" +
           html_escape(words) + "</figcaption>" + legend(scale, "0", format(pattern, high)) + "</figure>\n";
}

std::string maps_of(const Profile& p) {
    const WorkCounts& c = p.counts;
    std::vector<float> visits(c.visits.size());
    for (std::size_t i = 0; i < visits.size(); ++i) visits[i] = float(double(c.visits[i]) / c.samples);
    std::string html =
        "<h3>Where in the picture</h3>\n<div class=\"maps\">\n" +
        map_html(visits, c.width, c.height, "Nodes and leaves that the paths of a sample visit", "%.0f");
    if (p.tile_seconds.empty())
        return html +
               "</div>\n<p>How long each tile takes was not measured: one after the other they take "
               "too long on this device.</p>\n";
    std::vector<float> seconds(c.visits.size());
    const unsigned across = (c.width + FILM_TILE - 1) / FILM_TILE;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const std::size_t x = i % c.width, y = i / c.width, tile = y / FILM_TILE * across + x / FILM_TILE;
        seconds[i] = float(1e6 * p.tile_seconds[tile] / c.samples);
    }
    return html +
           map_html(seconds, c.width, c.height, "Microseconds of a sample of each tile, launched alone",
                    "%.3g us") +
           "</div>\n";
}

}  // namespace

ProfileMaps profile_maps() { return {maps_style, maps_of}; }

}  // namespace triad
