#include "display/perceived_noise.h"

#include <utility>

#include "panel/perceived.h"

namespace triad {

PerceivedNoise::PerceivedNoise(CurrentDevice device, const Panel& panel, double ppd,
                               const DisplaySettings& display)
    : device_(std::move(device)), panel_(panel), ppd_(ppd), display_(display) {
    display_.alpha = false;
    display_.taps.reset();
    display_.refine.reset();
}

std::optional<double> PerceivedNoise::of(const Film& film) const {
    const std::optional<HalfMeans> halves = half_means(film);
    if (!halves) return std::nullopt;
    const auto shown = [&](const std::vector<float>& rgb) {
        BinImage image{film.width, film.height, 1, 1, std::vector<float>(film.pixels() * 4, 1.0f)};
        for (std::size_t p = 0; p < film.pixels(); ++p)
            for (std::size_t c = 0; c < 3; ++c) image.rgba[p * 4 + c] = rgb[p * 3 + c];
        return resolve_display(device_(), image, display_);
    };
    const std::vector<float> first = shown(halves->first), second = shown(halves->second);
    RgbImage noise{film.width, film.height, std::vector<float>(film.pixels() * 3)};
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::size_t c = 0; c < 3; ++c)
            noise.rgb[p * 3 + c] = halves->weight[p] * (first[p * 4 + c] - second[p * 4 + c]);
    return perceived_difference(panel_, noise, {.ppd = ppd_, .border = 0});
}

}  // namespace triad
