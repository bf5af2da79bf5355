#include "panel/simulate.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_for.h"
#include "panel/aperture.h"

namespace triad {
namespace {

/// The light of an emitter at full drive in one of the samples around its cell.
struct Spot {
    int x, y;  ///< samples from the corner of the cell
    unsigned emitter;
    dvec3 rgb;
};

/// R, G and B of XYZ in the panel's primaries.
dmat3 rgb_of_xyz(const Panel& panel) {
    const PanelLight light = panel_light(panel);
    return glm::inverse(dmat3(light.channel[0], light.channel[1], light.channel[2]));
}

std::vector<Spot> spots_of(const Panel& panel, unsigned samples) {
    std::vector<Spot> spots;
    const std::vector<dvec3> light = emitter_light(panel);
    const dmat3 to_rgb = rgb_of_xyz(panel);
    const double cell = double(panel.cell_x * samples) * (panel.cell_y * samples);  // samples
    for (unsigned i = 0; i < panel.emitters.size(); ++i) {
        const Emitter& e = panel.emitters[i];
        const double area = aperture_area(e.aperture);
        double reach = e.aperture.radius;
        for (const dvec2& corner : e.aperture.corners)
            reach = std::max({reach, std::abs(corner.x), std::abs(corner.y)});
        const auto sample = [&](double px) { return int(std::floor(px * samples)); };
        for (int y = sample(e.centre.y - reach); y <= sample(e.centre.y + reach); ++y)
            for (int x = sample(e.centre.x - reach); x <= sample(e.centre.x + reach); ++x) {
                const dvec2 lo = dvec2(x, y) / double(samples) - e.centre;
                const double share = aperture_overlap(e.aperture, lo, lo + 1.0 / samples) / area;
                if (share > 1e-12) spots.push_back({x, y, i, share * cell * (to_rgb * light[i])});
            }
    }
    return spots;
}

/// How bright each emitter is driven, by the drives of its pixel.
double level(const Emitter& e, const RgbImage& drives, unsigned x, unsigned y, bool has_white) {
    const float* rgb = drives.rgb.data() + 3 * (std::size_t(y) * drives.width + x);
    const auto drive = [rgb](unsigned c) { return rgb[c] > 0 ? std::min(double(rgb[c]), 1.0) : 0.0; };
    const double white = has_white ? std::min({drive(0), drive(1), drive(2)}) : 0;
    return e.feed == Feed::white ? white : drive(unsigned(e.feed)) - white;
}

}  // namespace

RgbImage simulate_panel(const Panel& panel, const RgbImage& drives, unsigned samples, bool repeats) {
    const std::vector<Spot> spots = spots_of(panel, samples);
    const bool has_white = std::any_of(panel.emitters.begin(), panel.emitters.end(),
                                       [](const Emitter& e) { return e.feed == Feed::white; });
    RgbImage image{drives.width * samples, drives.height * samples, {}};
    image.rgb.resize(std::size_t(image.width) * image.height * 3);
    std::vector<double> levels(panel.emitters.size());
    for (unsigned cy = 0; cy < drives.height; cy += panel.cell_y)
        for (unsigned cx = 0; cx < drives.width; cx += panel.cell_x) {
            for (std::size_t i = 0; i < levels.size(); ++i) {
                const unsigned x = cx + panel.emitters[i].pixel_x, y = cy + panel.emitters[i].pixel_y;
                const bool inside = x < drives.width && y < drives.height;
                levels[i] = inside ? level(panel.emitters[i], drives, x, y, has_white) : 0;
            }
            for (const Spot& spot : spots) {
                auto x = std::ptrdiff_t(cx * samples) + spot.x, y = std::ptrdiff_t(cy * samples) + spot.y;
                if (repeats) x = (x + image.width) % image.width, y = (y + image.height) % image.height;
                if (x < 0 || y < 0 || x >= std::ptrdiff_t(image.width) || y >= std::ptrdiff_t(image.height))
                    continue;
                float* rgb = image.rgb.data() + 3 * (std::size_t(y) * image.width + std::size_t(x));
                for (int c = 0; c < 3; ++c) rgb[c] += float(levels[spot.emitter] * spot.rgb[c]);
            }
        }
    return image;
}

}  // namespace triad
