#include "report/subpixel_sights.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "page/html.h"
#include "panel/perceived.h"
#include "panel/simulate.h"
#include "report/error_pictures.h"
#include "report/panel_report.h"

namespace triad {
namespace {

constexpr unsigned crop_width = 24, crop_height = 16, zoom = 12;  // px

struct Part {
    unsigned x, y;
};

RgbImage cut_out(const RgbImage& image, const Part& part, unsigned samples) {
    RgbImage crop{crop_width * samples, crop_height * samples, {}};
    for (unsigned y = 0; y < crop.height; ++y) {
        const auto row =
            image.rgb.begin() +
            std::ptrdiff_t(((part.y * samples + y) * std::size_t(image.width) + part.x * samples) * 3);
        crop.rgb.insert(crop.rgb.end(), row, row + crop.width * 3);
    }
    return crop;
}

/// Whole cells of any panel from the corner, where the reference varies most.
Part most_contrast(const RgbImage& reference, unsigned samples) {
    const unsigned w = reference.width / samples, h = reference.height / samples;
    Part best{0, 0};
    double most = -1;
    for (unsigned y = 0; y + crop_height <= h; y += 8)
        for (unsigned x = 0; x + crop_width <= w; x += 8) {
            double sum = 0, squares = 0;
            const RgbImage crop = cut_out(reference, {x, y}, samples);
            for (const float v : crop.rgb) sum += v, squares += double(v) * v;
            const double n = double(crop.rgb.size()), variance = squares / n - sum / n * (sum / n);
            if (variance > most) most = variance, best = {x, y};
        }
    return best;
}

/// S-CIELAB's narrow Gaussian of lightness, which is what is seen of an edge.
RgbImage from_afar(const RgbImage& light, double spread) {
    const int reach = int(std::ceil(2.5 * spread)), w = int(light.width), h = int(light.height);
    std::vector<double> weights;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
        weights.push_back(std::exp(-(i / spread) * (i / spread))), sum += weights.back();
    RgbImage across = light, result = light;
    const auto blur = [&](const RgbImage& from, RgbImage& to, bool rows) {
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < 3; ++c) {
                    double value = 0;
                    for (int i = -reach; i <= reach; ++i) {
                        const unsigned u = rows ? mirrored_index(x + i, light.width) : unsigned(x);
                        const unsigned v = rows ? unsigned(y) : mirrored_index(y + i, light.height);
                        value += weights[std::size_t(i + reach)] *
                                 from.rgb[(std::size_t(v) * light.width + u) * 3 + unsigned(c)];
                    }
                    to.rgb[(std::size_t(y) * light.width + unsigned(x)) * 3 + unsigned(c)] =
                        float(std::clamp(value / sum, 0.0, 1.0));
                }
    };
    blur(light, across, true);
    blur(across, result, false);
    return result;
}

std::string figure(const std::vector<std::uint8_t>& png, const std::string& caption) {
    return "<figure><img style=\"image-rendering:pixelated\" alt=\"" + html_escape(caption) + "\" src=\"" +
           data_uri("image/png", png) + "\"><figcaption>" + html_escape(caption) + "</figcaption></figure>\n";
}

std::vector<float> sizes(const RgbImage& map) {
    std::vector<float> all;
    for (std::size_t i = 0; i < map.rgb.size(); i += 3)
        all.push_back(std::hypot(map.rgb[i], map.rgb[i + 1], map.rgb[i + 2]));
    return all;
}

}  // namespace

std::string sights_of(const SubpixelSight& sight, const PanelView& view) {
    const unsigned s = sight.samples;
    if (sight.drives.empty() || sight.reference.width < crop_width * s ||
        sight.reference.height < crop_height * s)
        return "";
    const Part part = most_contrast(sight.reference, s);
    const double spread = 0.0283 * view.ppd * s;
    const PerceivedMetric metric(view.panel, sight.reference, s, {.ppd = view.ppd});
    std::vector<std::vector<float>> maps;
    std::vector<const std::vector<float>*> all;
    for (const auto& [method, drives] : sight.drives)
        maps.push_back(sizes(cut_out(metric.of(drives).map, part, s)));
    for (const auto& map : maps) all.push_back(&map);
    const ColourScale scale{0, round_limit(all)};
    std::string html =
        format("<h3>%u x %u pixels at %u, %u, by %u rays per pixel</h3>\n<div class=\"pictures\">\n",
               crop_width, crop_height, part.x, part.y, sight.rays);
    html += "<figure class=\"first\"><img alt=\"\" src=\"" +
            data_uri("image/png", png_of(cut_out(from_afar(sight.reference, spread), part, s))) +
            "\"><figcaption>what should be seen from afar</figcaption></figure>\n</div>\n";
    for (std::size_t i = 0; i < sight.drives.size(); ++i) {
        const auto& [method, drives] = sight.drives[i];
        html +=
            "<div class=\"pictures\">\n" +
            figure(png_of(magnified(view.panel, cut_out(drives, part, 1), zoom)), method + ", on the panel") +
            figure(png_of(cut_out(from_afar(simulate_panel(view.panel, drives, s), spread), part, s)),
                   method + ", from afar") +
            figure(false_colour_png(maps[i], crop_width * s, crop_height * s, scale),
                   method + format(", error from 0 (dark) to %g (pale)", scale.high)) +
            "</div>\n";
    }
    return html;
}

}  // namespace triad
