#include "io/film_header.h"

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/whole_number.h"
#include "kernels/types.h"

namespace triad {
namespace {

using json = nlohmann::json;

json to_json(const SampleRange& range) { return {range.begin, range.end}; }
SampleRange range_of(const json& range) {
    return {whole_number<std::uint64_t>(range.at(0)), whole_number<std::uint64_t>(range.at(1))};
}

json to_json(const RoundRays& rays) {
    return {{"rays", rays.rays},
            {"samples", rays.samples},
            {"by_noise", rays.by_noise},
            {"everywhere", rays.everywhere},
            {"noisy", rays.noisy}};
}
RoundRays rays_of(const json& rays) {
    return {whole_number<std::uint64_t>(rays.at("rays")), whole_number<std::uint64_t>(rays.at("samples")),
            rays.at("by_noise").get<bool>(), rays.at("everywhere").get<double>(),
            rays.at("noisy").get<double>()};
}

json to_json(const FilmProgress& progress) {
    return {{"words", progress.words},
            {"kernels", progress.kernels},
            {"samples", to_json(progress.samples)},
            {"ended", progress.ended},
            {"wanted", progress.wanted.size()},
            {"estimates", progress.estimates},
            {"rays", to_json(progress.rays)},
            {"set_errors", progress.set_errors.size()}};
}

FilmProgress progress_of(const json& header, ProgressSizes& sizes,
                         const std::function<void(const std::string&)>& refuse) {
    FilmProgress progress;
    progress.words = header.at("words").get<std::vector<std::string>>();
    progress.kernels = header.value("kernels", std::string());
    progress.samples = range_of(header.at("samples"));
    if (progress.samples.begin >= progress.samples.end) refuse("the samples that it asks for are none");
    progress.ended = header.at("ended").get<bool>();
    progress.estimates = header.at("estimates").get<decltype(progress.estimates)>();
    if (header.contains("rays")) progress.rays = rays_of(header.at("rays"));
    sizes = {whole_number<std::uint64_t>(header.at("wanted")),
             whole_number<std::uint64_t>(header.at("set_errors"))};
    return progress;
}

template <class Refuse>
Film film_of(const json& header, ProgressSizes& sizes, const Refuse& refuse) {
    Film film;
    const auto numbers = [&](const char* key, std::initializer_list<unsigned*> to, unsigned limit) {
        if (header.at(key).size() != to.size()) refuse(std::string("its \"") + key + "\" is incomplete");
        std::size_t i = 0;
        for (unsigned* value : to) {
            const auto number = whole_number<std::int64_t>(header.at(key).at(i++));
            if (number < 0 || number > limit) refuse(std::string("its \"") + key + "\" is out of range");
            *value = unsigned(number);
        }
    };
    numbers("size", {&film.full_width, &film.full_height}, 1u << 20);
    numbers("crop", {&film.x, &film.y, &film.width, &film.height}, 1u << 20);
    numbers("bins", {&film.bins_x, &film.bins_y}, 64);
    if (film.width == 0 || film.height == 0 || film.x + film.width > film.full_width ||
        film.y + film.height > film.full_height)
        refuse("its crop is empty or outside its picture");
    if (film.bins() == 0) refuse("it has no bins");
    film.quanta_log2 = whole_number<int>(header.at("quanta_log2"));
    if (film.quanta_log2 < -126 || film.quanta_log2 > 126) refuse("its \"quanta_log2\" is out of range");
    for (const json& range : header.at("ranges")) {
        film.ranges.push_back(range_of(range));
        const std::size_t n = film.ranges.size();
        if (film.ranges[n - 1].begin >= film.ranges[n - 1].end ||
            (n > 1 && film.ranges[n - 2].end >= film.ranges[n - 1].begin))
            refuse("its sample ranges are empty or out of order");
    }
    if (film.sample_count() > 0xffffffffu) refuse("it has more than 2^32 - 1 samples per pixel");
    for (std::size_t i = 0; i < film.counters.size(); ++i)
        film.counters[i] = whole_number<std::uint64_t>(header.at("counters").at(i));
    film.scene = header.at("scene").get<std::string>();
    film.settings = header.at("settings").get<std::string>();
    film.settings_text = header.at("settings_text").get<std::string>();
    film.devices = header.at("devices").get<std::vector<std::string>>();
    if (header.contains("shares"))
        for (const json& number : header.at("shares"))
            film.shares.push_back(whole_number<std::uint32_t>(number));
    if (header.contains("guides")) {
        if (whole_number<unsigned>(header.at("guides")) != DENOISE_GUIDES)
            refuse("its guides are not those of this Triad");
        film.has_guides = true;
    }
    if (header.contains("progress")) film.progress = progress_of(header.at("progress"), sizes, refuse);
    return film;
}

}  // namespace

std::string film_header(const Film& film) {
    json ranges = json::array();
    for (const SampleRange& range : film.ranges) ranges.push_back(to_json(range));
    json header = {{"size", {film.full_width, film.full_height}},
                   {"crop", {film.x, film.y, film.width, film.height}},
                   {"bins", {film.bins_x, film.bins_y}},
                   {"quanta_log2", film.quanta_log2},
                   {"ranges", ranges},
                   {"counters", film.counters},
                   {"scene", film.scene},
                   {"settings", film.settings},
                   {"settings_text", film.settings_text},
                   {"devices", film.devices}};
    if (!film.shares.empty()) header["shares"] = film.shares;
    if (film.has_guides) header["guides"] = DENOISE_GUIDES;
    if (film.progress) header["progress"] = to_json(*film.progress);
    // Names of devices come from drivers: what is no UTF-8 is replaced.
    return header.dump(-1, ' ', false, json::error_handler_t::replace);
}

Film film_of_header(const std::string& header, ProgressSizes& sizes,
                    const std::function<void(const std::string&)>& refuse) {
    try {
        return film_of(json::parse(header), sizes, refuse);
    } catch (const json::exception& e) {
        refuse(std::string("its header is damaged (") + words_of_json(e) + ")");
    }
    return {};  // refuse throws
}

}  // namespace triad
