// resolve_display of films and of pictures.
#include <cmath>

#include "display/display_pipeline.h"

namespace triad {

std::vector<float> resolve_display(Device& device, const Film& film, const DisplaySettings& settings) {
    if (film.pixels() == 0) return {};
    BinSource source{
        .width = film.width,
        .height = film.height,
        .columns = film.width * film.bins_x,
        .rows = film.height * film.bins_y,
        .bins_x = film.bins_x,
        .bins_y = film.bins_y,
        .encoded = false,
        .unit = std::ldexp(1.0f, -film.quanta_log2),
        .rows_of_pixels = true,
        .row_bytes = film.width * film.bins() * 4 * sizeof(std::int64_t),
        .kernel = "map_film",
        .upload = [&film](Device& to, std::size_t first, std::size_t count) {
            const std::size_t bins = film.width * film.bins() * 4;
            return Arguments()
                .add(to.upload(std::span(film.sums).subspan(first * bins, count * bins)))
                .add(to.upload(std::span(film.samples).subspan(first * film.width, count * film.width)));
        }};
    std::optional<HalfMeans> means;
    if (film.bins() > 1 && settings.order == ToneOrder::noise_aware) {
        means = half_means(film);
        source.halves = [&](Device& to, std::size_t first, std::size_t count) {
            const auto rows = [&](const std::vector<float>& values, std::size_t each) {
                const std::size_t row = film.width * each;
                return to.upload(std::span(values).subspan(first * row, count * row));
            };
            if (!means) return Arguments().add(Buffer()).add(Buffer()).add(Buffer()).add(0u);
            return Arguments()
                .add(rows(means->first, 3))
                .add(rows(means->second, 3))
                .add(rows(means->weight, 1))
                .add(1u);
        };
    }
    return DisplayPipeline(device, source, settings).run();
}

std::vector<float> resolve_display(Device& device, const BinImage& image, const DisplaySettings& settings) {
    if (image.rgba.empty()) return {};
    const BinSource source{
        .width = image.width(),
        .height = image.height(),
        .columns = image.columns,
        .rows = image.rows,
        .bins_x = image.bins_x,
        .bins_y = image.bins_y,
        .encoded = image.encoded,
        .unit = 1.0f,
        .rows_of_pixels = false,
        .row_bytes = image.columns * 4 * sizeof(float),
        .kernel = "map_image",
        .upload = [&image](Device& to, std::size_t first, std::size_t count) {
            const std::size_t row = std::size_t(image.columns) * 4;
            return Arguments().add(to.upload(std::span(image.rgba).subspan(first * row, count * row)));
        }};
    return DisplayPipeline(device, source, settings).run();
}

}  // namespace triad
