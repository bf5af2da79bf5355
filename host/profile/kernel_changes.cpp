#include "profile/kernel_changes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "page/aligned.h"

namespace triad {
namespace {

/// Of a kernel that takes less than this share of the time no change matters.
constexpr double least_share = 0.01;
/// Of two processes on a quiet machine: the clock's and the caches' moods.
constexpr double between_processes = 1.03;

std::vector<double> logarithms(const std::vector<double>& values) {
    std::vector<double> logs;
    for (const double v : values)
        if (v > 0) logs.push_back(std::log(v));
    return logs;
}

std::vector<double> runs_of(const Json& row) { return row.value("ms_of_runs", std::vector<double>()); }

bool is_row(const Json& row) {
    if (!row.is_object()) return false;
    for (const char* name : {"kernel", "device", "driver"})
        if (row.contains(name) && !row[name].is_string()) return false;
    const Json runs = row.value("ms_of_runs", Json::array());
    return runs.is_array() &&
           std::all_of(runs.begin(), runs.end(), [](const Json& ms) { return ms.is_number(); });
}

bool is_report(const Json& json, const std::string& command) {
    return json.is_object() && json.value("schema", Json()) == "triad." + command + "/1" &&
           json.contains("rows") && json["rows"].is_array() &&
           std::all_of(json["rows"].begin(), json["rows"].end(), is_row);
}

/// Several runs of a kernel on this device.
bool is_comparable(const Json& row, const DeviceInfo& device) {
    return row.value("device", "") == device.name && row.value("driver", "") == device.driver &&
           logarithms(runs_of(row)).size() > 1;
}

[[noreturn]] void refuse_for_lack_of_rows() {
    throw Error(Exit::usage,
                "--against: that report has no kernel of this device and driver, or of a "
                "single run; both need two or more.");
}

}  // namespace

Json earlier_report(const std::string& path, const std::string& command) {
    const std::vector<std::uint8_t> file = read_file(path, 1u << 28);
    Json json = Json::parse(file.begin(), file.end(), nullptr, false);
    if (json.is_discarded()) throw Error(Exit::scene, "--against " + path + ": that is no JSON.");
    if (!is_report(json, command)) throw Error(Exit::scene, "--against: that is no --json of this command.");
    return json;
}

void require_same_work(const Json& before, const Json& workload) {
    if (before.value("workload", Json()) != workload)
        throw Error(Exit::usage,
                    "--against: that report is of other work: " + before.value("workload", Json()).dump() +
                        ", here " + workload.dump() + ".");
}

void require_comparable(const Json& before, const DeviceInfo& device, unsigned runs) {
    const Json& rows = before["rows"];
    if (runs < 2 ||
        std::none_of(rows.begin(), rows.end(), [&](const Json& row) { return is_comparable(row, device); }))
        refuse_for_lack_of_rows();
}

std::vector<KernelChange> changes_since(const Json& before, const std::vector<Profile>& profiles) {
    std::vector<KernelChange> changes;
    for (const Profile& p : profiles)
        for (const KernelRow& r : p.rows)
            for (const Json& old : before["rows"]) {
                if (old.value("kernel", "") != r.kernel || !is_comparable(old, p.device)) continue;
                if (logarithms(r.ms_of_runs).size() < 2) continue;
                const std::vector<double> then = runs_of(old);
                KernelChange c{r.kernel,
                               p.device.name,
                               median(then),
                               r.ms.value,
                               ratio_estimate(logarithms(then), logarithms(r.ms_of_runs)),
                               false};
                c.is_slower = r.share >= least_share && c.ratio.low > between_processes;
                changes.push_back(c);
            }
    if (changes.empty()) refuse_for_lack_of_rows();
    return changes;
}

std::string table_of(const std::vector<KernelChange>& changes) {
    std::vector<std::vector<std::string>> lines{
        {"kernel", "device", "ms before", "ms now", "ratio", "95 %", ""}};
    for (const KernelChange& c : changes)
        lines.push_back({c.kernel, c.device, format("%.1f", c.before_ms), format("%.1f", c.now_ms),
                         format("%.3f", c.ratio.value), format("%.3f to %.3f", c.ratio.low, c.ratio.high),
                         c.is_slower ? "slower" : ""});
    return aligned(lines, 2);
}

bool any_slower(const std::vector<KernelChange>& changes) {
    return std::any_of(changes.begin(), changes.end(), [](const KernelChange& c) { return c.is_slower; });
}

}  // namespace triad
