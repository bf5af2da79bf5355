#include "session/film_layers.h"

#include <algorithm>
#include <limits>
#include <string>

namespace triad {
namespace {

/// Edges and the blur of the lens have noise; the planes have no other.
constexpr unsigned feature_samples = 16;

}  // namespace

void add_guides(Renderer& renderer, Film& film) {
    const FeaturePlanes planes = renderer.feature_planes(feature_samples);
    film.has_guides = true;
    film.guides.clear();
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        film.guides.insert(film.guides.end(), &planes.albedo[3 * p], &planes.albedo[3 * p] + 3);
        film.guides.insert(film.guides.end(), &planes.normal[3 * p], &planes.normal[3 * p] + 3);
        film.guides.push_back(planes.depth[p]);
    }
}

std::vector<Channel> layers_of(const RenderRequest& o, Renderer& renderer, const Film& film) {
    std::vector<Channel> layers;
    auto asked = [&](const char* name) {
        return std::find(o.aovs.begin(), o.aovs.end(), name) != o.aovs.end();
    };
    auto add = [&](const std::string& name, const char* parts, const auto& values) {
        const std::size_t n = std::char_traits<char>::length(parts);
        for (std::size_t c = 0; c < n; ++c) {
            Channel channel{name + "." + parts[c], std::vector<float>(film.pixels())};
            for (std::size_t i = 0; i < film.pixels(); ++i)
                channel.values[i] = static_cast<float>(values[i * n + c]);
            layers.push_back(std::move(channel));
        }
    };
    if (asked("albedo") || asked("normal") || asked("position") || asked("depth")) {
        const FeaturePlanes planes = renderer.feature_planes(feature_samples);
        if (asked("albedo")) add("albedo", "RGB", planes.albedo);
        if (asked("normal")) add("normal", "XYZ", planes.normal);
        if (asked("position")) add("position", "XYZ", planes.position);
        if (asked("depth")) add("depth", "Z", planes.depth);
    }
    if (asked("samples")) add("samplecount", "Y", film.samples);
    if (asked("variance")) {
        std::vector<float> variance = mean_variance(film);
        if (variance.empty()) variance.assign(film.pixels() * 3, std::numeric_limits<float>::quiet_NaN());
        add("variance", "RGB", variance);
    }
    if (asked("error")) {
        std::vector<float> errors = error_map(film);
        if (errors.empty()) errors.assign(film.pixels(), std::numeric_limits<float>::quiet_NaN());
        add("error", "Y", errors);
    }
    return layers;
}

}  // namespace triad
