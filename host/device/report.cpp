#include "device/report.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "base/machine.h"

namespace triad {
namespace {

Json machine() {
    const Machine m = this_machine();
    return {{"system", m.system},
            {"architecture", m.architecture},
            {"processor", m.processor},
            {"cores", m.cores},
            {"memory_bytes", m.memory_bytes}};
}

}  // namespace

Json to_json(const DeviceInfo& d) {
    return {{"index", d.index},
            {"name", d.name},
            {"vendor", d.vendor},
            {"platform", d.platform},
            {"type", d.type},
            {"version", d.version},
            {"c_version", d.c_version},
            {"driver", d.driver},
            {"memory_bytes", d.memory},
            {"max_allocation_bytes", d.max_allocation},
            {"local_memory_bytes", d.local_memory},
            {"compute_units", d.compute_units},
            {"clock_mhz", d.clock_mhz},
            {"max_work_group", d.max_work_group},
            {"fp64", d.fp64},
            {"images", d.images},
            {"correctly_rounded", d.correctly_rounded},
            {"denormals", d.denormals},
            {"int64_atomics", d.int64_atomics},
            {"usable", d.usable},
            {"preferred", d.preferred},
            {"why_unusable", d.why_unusable},
            {"settings", d.settings}};
}

void write_report(const std::string& path, const std::string& command, const DeviceInfo* device, Json rows,
                  const Json& more) {
    Json report = {{"schema", "triad." + command + "/1"},
                   {"version", TRIAD_VERSION},
                   {"machine", machine()},
                   {"device", device ? to_json(*device) : Json()},
                   {"rows", std::move(rows)}};
    report.update(more);
    // Names in files need not be valid UTF-8; they must not stop a report.
    const std::string text = report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (path != "-") return write_file(path, text);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw Error(Exit::scene, "Cannot write the report to standard output.");
}

std::string command_words() {
    std::ifstream file("/proc/self/cmdline");
    std::string words;
    for (std::string word; std::getline(file, word, '\0');) {
        if (words.empty()) word = std::filesystem::path(word).filename().string();
        const bool plain =
            !word.empty() && word.find_first_of(" '\"\\$`*?[](){}<>|&;#~") == std::string::npos;
        if (!plain)  // in single quotes, where only those themselves mean something
            for (std::size_t at = 0; (at = word.find('\'', at)) != std::string::npos; at += 4)
                word.replace(at, 1, "'\\''");
        words += (words.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
    }
    return words;
}

}  // namespace triad
