#include "cli/info_film.h"

#include <cstdio>

#include "base/progress.h"
#include "base/text.h"
#include "io/io.h"
#include "kernels/types.h"
#include "report/report.h"
#include "scene/film_sets.h"
#include "scene/sample_shares.h"

namespace triad {
namespace {

std::string text_of(const std::vector<SampleRange>& ranges) {
    std::string text;
    for (const SampleRange& range : ranges)
        text += (text.empty() ? "" : " ") + std::to_string(range.begin) + ":" + std::to_string(range.end);
    return text.empty() ? "none in every pixel" : text;
}

/// Every device of the film, and which share of its samples it took; negative: not known.
std::vector<std::pair<std::string, double>> device_shares(const Film& film) {
    std::vector<std::pair<std::string, double>> shares;
    for (const std::string& device : film.devices)
        shares.emplace_back(device, film.devices.size() > 1 ? -1 : 1);
    if (film.shares.empty()) return shares;
    const std::vector<std::uint32_t> pixels = set_pixels(film.width, film.height);
    const SampleShares taken = SampleShares::unpacked(film.shares, pixels.size());
    std::vector<double> samples(shares.size());
    double all = 0;
    for (std::size_t set = 0; set < pixels.size(); ++set)
        for (const auto& [device, n] : taken.of(set)) {
            all += double(n) * pixels[set];
            if (device < samples.size()) samples[device] += double(n) * pixels[set];
        }
    for (std::size_t i = 0; i < shares.size() && all > 0; ++i) shares[i].second = samples[i] / all;
    return shares;
}

/// complete, ended (by --time) or stopped (before its goal, or damaged).
std::string state_of(const Film& film) {
    return !film.progress ? "complete" : film.progress->ended ? "ended" : "stopped";
}

std::string words_of(const Film& film) {
    std::string text;
    for (const std::string& word : film.progress->words) text += (text.empty() ? "" : " ") + word;
    return text;
}

void print(const std::string& path, const SalvagedFilm& found, const SampleNumbers& numbers, double relmse) {
    const Film& film = found.film;
    std::printf("picture     %ux%u", film.full_width, film.full_height);
    if (film.width != film.full_width || film.height != film.full_height)
        std::printf(", of it %ux%u pixels from (%u, %u) on", film.width, film.height, film.x, film.y);
    std::printf(", %ux%u bins per pixel\n", film.bins_x, film.bins_y);
    std::printf("samples     %s per pixel", spp_text(numbers.mean).c_str());
    if (numbers.least != numbers.most) std::printf(" (%u to %u)", numbers.least, numbers.most);
    std::printf(", ranges %s\n", text_of(film.ranges).c_str());
    std::printf("relMSE      %s\n", relmse < 0 ? "not known" : format("%.3g", relmse).c_str());
    std::printf("rays        %llu\n", static_cast<unsigned long long>(film.counters[COUNTER_RAYS]));
    std::printf("not finite  %llu samples, %llu cut by the film's range, %llu paths cut at the depth\n",
                static_cast<unsigned long long>(film.counters[COUNTER_NOT_FINITE]),
                static_cast<unsigned long long>(film.counters[COUNTER_SATURATED]),
                static_cast<unsigned long long>(film.counters[COUNTER_TRUNCATED]));
    for (const auto& [device, share] : device_shares(film))
        std::printf("device      %s%s\n", device.c_str(),
                    share < 0 ? "" : format(", %.1f %% of the samples", 100 * share).c_str());
    std::printf("scene       %s\n", film.scene.c_str());
    std::printf("settings    %s %s\n", film.settings.c_str(), film.settings_text.c_str());
    std::printf("state       %s", state_of(film).c_str());
    if (film.progress && !film.progress->words.empty())
        std::printf("; begun as: triad render %s", words_of(film).c_str());
    std::printf("\n");
    if (film.progress)
        std::printf(
            "            triad render --resume %s%s goes on%s\n", path.c_str(),
            film.progress->ended ? " --time S (or --spp N, or --error E)" : "",
            film.progress->words.empty() ? ", with the scene and the options that it was rendered with" : "");
    std::printf("damage      %s\n", found.damage().empty() ? "none" : found.damage().c_str());
}

Json row_of(const std::string& path, const SalvagedFilm& found, const SampleNumbers& numbers, double relmse) {
    const Film& film = found.film;
    Json ranges = Json::array(), lost = Json::array(), shares = Json::array();
    for (const auto& [device, share] : device_shares(film))
        shares.push_back(share < 0 ? Json() : Json(share));
    for (const SampleRange& range : film.ranges) ranges.push_back({range.begin, range.end});
    for (const auto& [begin, end] : found.lost) lost.push_back({begin, end});
    return {{"film", path},
            {"width", film.full_width},
            {"height", film.full_height},
            {"crop", {film.x, film.y, film.width, film.height}},
            {"bins", {film.bins_x, film.bins_y}},
            {"spp", spp_json(numbers)},
            {"spp_min", numbers.least},
            {"spp_max", numbers.most},
            {"samples", numbers.total},
            {"ranges", ranges},
            {"relmse", relmse < 0 ? Json() : Json(relmse)},
            {"rays", film.counters[COUNTER_RAYS]},
            {"not_finite", film.counters[COUNTER_NOT_FINITE]},
            {"saturated", film.counters[COUNTER_SATURATED]},
            {"truncated", film.counters[COUNTER_TRUNCATED]},
            {"devices", film.devices},
            {"device_shares", shares},
            {"scene_hash", film.scene},
            {"settings_hash", film.settings},
            {"settings", Json::parse(film.settings_text, nullptr, false)},
            {"state", state_of(film)},
            {"words", film.progress ? Json(film.progress->words) : Json()},
            {"lost_rows", lost}};
}

}  // namespace

Exit info_film(const std::string& path, const std::string& json) {
    const SalvagedFilm found = salvage_film(path);
    const SampleNumbers numbers = found.film.sample_numbers();
    const double relmse = estimated_relmse(found.film);
    if (json != "-") print(path, found, numbers, relmse);
    if (!json.empty())
        write_report(json, "info", nullptr, Json::array({row_of(path, found, numbers, relmse)}));
    return Exit::done;
}

}  // namespace triad
