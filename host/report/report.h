#pragma once
/// The JSON files of --json: {"schema": "triad.COMMAND/1", "version", "machine", "device", "rows"}.
#include <nlohmann/json.hpp>
#include <string>

#include "device/device.h"
#include "scene/film.h"

namespace triad {

using Json = nlohmann::ordered_json;

/// What a reader needs to know about a device.
Json to_json(const DeviceInfo& device);

/// Samples per pixel: a whole number where all have the same, else their mean.
Json spp_json(const SampleNumbers& numbers);

/// Writes the report of `command` to `path`, aside and renamed ("-": standard output). Without a device:
/// null. `more` is an object whose members follow the rows.
void write_report(const std::string& path, const std::string& command, const DeviceInfo* device, Json rows,
                  const Json& more = Json::object());

/// The command of this process as typed, quoted where a shell would need it; the program's folder left out.
std::string command_words();

/// "2026-11-22 05:10 UTC".
std::string date_words();

}  // namespace triad
