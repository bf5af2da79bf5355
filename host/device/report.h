#pragma once
/// The JSON files of --json: {"schema": "triad.COMMAND/1", "version", "machine", "device", "rows"}. Here, so
/// that triad-replay writes them without the rooms that write all else.
#include <nlohmann/json.hpp>
#include <string>

#include "device/device.h"

namespace triad {

using Json = nlohmann::ordered_json;

/// What a reader needs to know about a device.
Json to_json(const DeviceInfo& device);

/// Writes the report of `command` to `path`, aside and renamed ("-": standard output). Without a device:
/// null. `more` is an object whose members follow the rows.
void write_report(const std::string& path, const std::string& command, const DeviceInfo* device, Json rows,
                  const Json& more = Json::object());

/// The command of this process as typed, quoted where a shell would need it; the program's folder left out.
std::string command_words();

}  // namespace triad
