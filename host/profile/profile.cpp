#include "profile/profile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "trace/node_format.h"

namespace triad {
namespace {

double milliseconds(const DeviceCommand& command) { return 1e-6 * double(command.end - command.start); }

/// The value that a share q of them does not exceed.
double percentile(std::vector<double> values, double q) {
    const auto place = values.begin() + std::ptrdiff_t(std::ceil(q * double(values.size()))) - 1;
    std::nth_element(values.begin(), std::max(place, values.begin()), values.end());
    return *std::max(place, values.begin());
}

using Commands = std::span<const DeviceCommand>;

/// Of the queue: between the end of a command and the start of the next.
double waiting_of(Commands commands) {
    double seconds = 0;
    for (std::size_t i = 1; i < commands.size(); ++i)
        seconds += 1e-9 * double(std::max<std::int64_t>(0, commands[i].start - commands[i - 1].end));
    return seconds;
}

/// Of these, before the next was queued: the host was at work.
double host_between(Commands commands) {
    double seconds = 0;
    for (std::size_t i = 1; i < commands.size(); ++i)
        seconds += 1e-9 * double(std::max<std::int64_t>(0, commands[i].queued - commands[i - 1].end));
    return seconds;
}

/// Enqueuing a kernel waits for nothing, so the shortest way from one clock to the other is nearly none.
std::int64_t clock_offset(Commands commands) {
    std::optional<std::int64_t> least;
    for (const DeviceCommand& c : commands)
        if (c.kind == CommandKind::kernel)
            least = std::min(least.value_or(c.enqueued - c.queued), c.enqueued - c.queued);
    return least.value_or(0);
}

std::vector<KernelRow> rows_of(const std::vector<std::vector<DeviceCommand>>& runs,
                               const std::vector<KernelFacts>& facts) {
    std::map<std::string, KernelRow> rows;
    std::map<std::string, std::vector<double>> times;
    for (std::size_t run = 0; run < runs.size(); ++run)
        for (const DeviceCommand& command : runs[run]) {
            KernelRow& row = rows[command.name];
            row.kernel = command.name, row.kind = command.kind;
            ++row.launches, row.items += command.items, row.bytes_moved += command.bytes;
            row.ms_of_runs.resize(runs.size());
            row.ms_of_runs[run] += milliseconds(command);
            times[command.name].push_back(milliseconds(command));
        }
    double all = 0;
    std::vector<KernelRow> sorted;
    for (auto& [name, row] : rows) {
        row.ms_median = median(times[name]), row.ms_p95 = percentile(times[name], 0.95);
        row.ms = median_estimate(row.ms_of_runs);
        const double seconds = 1e-3 * std::accumulate(times[name].begin(), times[name].end(), 0.0);
        row.items_per_s = double(row.items) / std::max(seconds, 1e-9);
        for (const KernelFacts& each : facts)
            if (each.name == name) row.facts = each, row.program = each.program;
        all += row.ms.value;
        sorted.push_back(std::move(row));
    }
    for (KernelRow& row : sorted) row.share = row.ms.value / std::max(all, 1e-9);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    return sorted;
}

}  // namespace

Floor floor_of(const KernelCost& cost, const DevicePeaks& peaks) {
    const MemoryPeak& memory = peaks.memory.front();
    Floor floor{cost.bytes / memory.read, "memory"};
    if (const double s = cost.flops / peaks.flops; s > floor.seconds) floor = {s, "arithmetic"};
    if (const double s = cost.gathers / memory.gathers; s > floor.seconds) floor = {s, "latency"};
    return floor;
}

double KernelRow::bytes_per_s() const {
    if (kind != CommandKind::kernel)
        return double(bytes_moved) / double(ms_of_runs.size()) / std::max(seconds(), 1e-9);
    return cost ? cost->bytes / seconds() : 0;
}

double KernelRow::flops_per_s() const { return cost ? cost->flops / seconds() : 0; }

double KernelRow::units_per_item(unsigned runs) const {
    return cost && items > 0 ? cost->units * runs / double(items) : 0;
}

std::optional<double> KernelRow::roofline_share() const {
    if (!floor || !(seconds() > 0)) return {};
    return floor->seconds / seconds();
}

void add_commands(Profile& p, const std::vector<std::vector<DeviceCommand>>& runs,
                  const std::vector<KernelFacts>& facts) {
    p.runs = unsigned(runs.size());
    p.commands = runs.back();
    p.clock_offset = clock_offset(p.commands);
    p.waiting = waiting_of(p.commands), p.host_between = host_between(p.commands);
    p.busy = 0;
    for (const DeviceCommand& command : p.commands) p.busy += 1e-3 * milliseconds(command);
    p.rows = rows_of(runs, facts);
}

void add_costs(Profile& p, const WorkCounts& counts, const DevicePeaks& peaks) {
    p.counts = counts, p.peaks = peaks;
    for (KernelRow& row : p.rows) {
        row.cost = cost_of(row.kernel, counts, *find_bvh_format(p.format), p.samples);
        if (row.cost) row.floor = floor_of(*row.cost, peaks);
    }
}

}  // namespace triad
