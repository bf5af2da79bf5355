#include "session/metadata.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "kernels/types.h"

namespace triad {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

/// The settings as the renderer wrote them; an empty object when the text is none (it is only for
/// information).
nlohmann::json settings_of(const Film& film) {
    nlohmann::json settings = nlohmann::json::parse(film.settings_text, nullptr, false);
    return settings.is_object() ? settings : nlohmann::json::object();
}

}  // namespace

Metadata metadata_of(const Film& film) {
    std::string devices;
    for (const std::string& device : film.devices) devices += (devices.empty() ? "" : "; ") + device;
    const SampleNumbers numbers = film.sample_numbers();
    Metadata metadata = {
        {"triad:version", TRIAD_VERSION},
        {"triad:spp",
         numbers.least == numbers.most ? std::to_string(numbers.least) : nlohmann::json(numbers.mean).dump()},
        {"triad:samples", std::to_string(numbers.total)},
        {"triad:scene", film.scene},
        {"triad:settings", film.settings},
        {"triad:settings_text", film.settings_text},
        {"triad:device", devices},
        {"triad:rays", std::to_string(film.counters[COUNTER_RAYS])},
        {"triad:not_finite", std::to_string(film.counters[COUNTER_NOT_FINITE])},
        {"triad:saturated", std::to_string(film.counters[COUNTER_SATURATED])},
        {"triad:truncated", std::to_string(film.counters[COUNTER_TRUNCATED])},
        {"triad:cut_energy", number(double(film.counters[COUNTER_CUT_ENERGY]) / CUT_ENERGY_ONE)},
        {"samplesPerPixel", std::to_string(std::llround(numbers.mean))},
        {"Software", "triad " TRIAD_VERSION}};
    const double relmse = estimated_relmse(film);
    if (relmse >= 0) metadata["triad:relmse"] = number(relmse);  // both halves have samples
    if (numbers.least != numbers.most) {
        metadata["triad:spp_min"] = std::to_string(numbers.least);
        metadata["triad:spp_max"] = std::to_string(numbers.most);
    }
    const nlohmann::json settings = settings_of(film);
    if (settings.contains("seed")) metadata["triad:seed"] = settings["seed"].dump();
    return metadata;
}

void describe(const Reconstruction& method, Metadata& metadata) {
    if (method.method.empty()) return;
    metadata["triad:reconstruct"] = method.method;
    if (!method.filter.empty()) metadata["triad:filter"] = method.filter;
    if (!method.panel) return;
    metadata["triad:panel"] = method.panel->panel.name;
    metadata["triad:panel_id"] = panel_id(method.panel->panel);
    metadata["triad:ppd"] = number(method.panel->ppd);
}

void describe(Denoiser denoiser, Metadata& metadata) {
    if (denoiser == Denoiser::off) return;
    metadata["triad:denoise"] = name_of(denoiser);
    for (const char* of_samples : {"triad:relmse", "triad:trend", "triad:perceived_noise"})
        metadata.erase(of_samples);
}

void refuse_for_panel(const std::string& path, const Metadata& metadata, const std::string& purpose) {
    const auto panel = metadata.find("triad:panel");
    if (panel == metadata.end()) return;
    throw Error(Exit::usage, path + " was made for the panel " + panel->second +
                                 ": its values drive that panel's emitters and are no colours of pixels, so "
                                 "that Triad does not " +
                                 purpose + " it. Give the picture without --panel, or its film.");
}

std::uint64_t film_bytes(const Film& film) {
    return film.sums.size() * sizeof film.sums[0] + film.half_sums.size() * sizeof film.half_sums[0] +
           film.samples.size() * sizeof film.samples[0] + film.guides.size() * sizeof(float);
}

bool has_filtered_rays(const Film& film) {
    return settings_of(film).value("ray_start", "jitter") == std::string(name_of(RayStart::filter));
}

bool has_alpha(const Film& film) { return settings_of(film).value("transparent", 0.0) != 0; }

}  // namespace triad
