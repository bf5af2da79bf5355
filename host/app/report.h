#pragma once
/// The JSON files of --json: {"schema": "triad.COMMAND/1", "version", "machine", "device", "rows"}.
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

/// "AMD EPYC, 2 cores, 24.9 GB, Linux 6.1.0 (x86_64)".
std::string machine_words();

/// The command of this process as typed, quoted where a shell would need it; the program's folder left out.
std::string command_words();

/// "2026-11-22 05:10 UTC".
std::string date_words();

/// 1234567 -> "1.2 MB".
std::string bytes_text(std::uint64_t bytes);

}  // namespace triad
