/// What a RenderSession tells of its pictures: their layers, and what is written into their files.
#include <ctime>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/machine.h"
#include "base/text.h"
#include "session/film_layers.h"
#include "session/render_session.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

/// What is said of every device, each word once.
template <class Say>
std::string joined(const std::vector<Device>& devices, const Say& say) {
    std::string text;
    std::set<std::string> said;
    for (const Device& device : devices)
        if (const std::string word = say(device); said.insert(word).second)
            text += (text.empty() ? "" : "; ") + word;
    return text;
}

/// As OpenEXR writes a date: "2026:11:26 17:04:05".
std::string universal_time() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &parts);
    return text;
}

}  // namespace

std::string RenderSession::scene_name() const {
    return request_.scene_path.empty() ? "built-in"
                                       : std::filesystem::path(request_.scene_path).filename().string();
}

std::vector<Channel> RenderSession::layers_of(const RenderOutcome& outcome) {
    return triad::layers_of(request_, *renderer_, outcome.film);
}

Metadata RenderSession::metadata_of(const RenderOutcome& outcome) const {
    Metadata metadata = facts_of(outcome);
    describe(request_.style.reconstruction, metadata);
    describe(request_.style.denoise, metadata);
    return metadata;
}

Metadata RenderSession::facts_of(const RenderOutcome& outcome) const {
    const RenderResult& result = outcome.result;
    Metadata metadata = triad::metadata_of(outcome.film);
    metadata["triad:driver"] = joined(*devices_, [](const Device& d) { return d.info().driver; });
    metadata["triad:format"] = joined(*devices_, [](const Device& d) { return name_of(format_of(d)); });
    metadata["triad:path_driver"] =
        joined(*devices_, [](const Device& d) { return name_of(path_driver_of(d)); });
    metadata["triad:stopped_by"] = to_string(result.stop);
    metadata["triad:seconds"] = metadata["renderTimeSeconds"] = format("%.3f", result.seconds);
    metadata["triad:scene_name"] = scene_name();
    metadata["capDate"] = universal_time();
    if (!request_.variant.empty()) metadata["triad:variant"] = request_.variant;
    if (!request_.animation.empty()) metadata["triad:animation"] = request_.animation;
    if (request_.pose_time != 0) metadata["triad:pose_time"] = format("%.9g", request_.pose_time);
    metadata["triad:machine"] = machine_words();
    if (const unsigned texels = loaded_.report.max_texture; texels > 0)
        metadata["triad:max_texture"] = std::to_string(texels);
    unsigned units = 0;
    for (const Device& device : *devices_) units += device.info().compute_units;
    metadata["triad:compute_units"] = std::to_string(units);
    std::string lost;
    for (const DeviceWork& work : result.devices)
        if (!work.failure.empty())
            lost += (lost.empty() ? "" : "; ") + work.device->name + ": " + work.failure;
    if (!lost.empty()) metadata["triad:failed_devices"] = lost;
    if (result.perceived_noise) metadata["triad:perceived_noise"] = format("%.4g", *result.perceived_noise);
    if (result.trend) metadata["triad:trend"] = format("%.3f", *result.trend);
    return metadata;
}

}  // namespace triad
