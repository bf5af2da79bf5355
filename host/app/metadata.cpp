#include "app/metadata.h"

#include <cstdio>

#include "app/report.h"
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
Json settings_of(const Film& film) {
    Json settings = Json::parse(film.settings_text, nullptr, false);
    return settings.is_object() ? settings : Json::object();
}

}  // namespace

Metadata metadata_of(const Film& film) {
    std::string devices;
    for (const std::string& device : film.devices) devices += (devices.empty() ? "" : "; ") + device;
    const std::string spp = std::to_string(film.sample_count());
    Metadata metadata = {{"triad:version", TRIAD_VERSION},
                         {"triad:spp", spp},
                         {"triad:relmse", number(estimated_relmse(film))},
                         {"triad:scene", film.scene},
                         {"triad:settings", film.settings},
                         {"triad:device", devices},
                         {"triad:not_finite", std::to_string(film.counters[COUNTER_NOT_FINITE])},
                         {"triad:saturated", std::to_string(film.counters[COUNTER_SATURATED])},
                         {"triad:truncated", std::to_string(film.counters[COUNTER_TRUNCATED])},
                         {"triad:cut_energy", number(double(film.counters[COUNTER_CUT_ENERGY]) / 65536)},
                         {"samplesPerPixel", spp},
                         {"Software", "triad " TRIAD_VERSION}};
    const Json settings = settings_of(film);
    if (settings.contains("seed")) metadata["triad:seed"] = settings["seed"].dump();
    return metadata;
}

bool has_alpha(const Film& film) { return settings_of(film).value("transparent", 0.0) != 0; }

}  // namespace triad
