#include "trace/tune.h"

#include <algorithm>

#include "base/log.h"
#include "trace/node_format.h"
#include "trace/tune_rays.h"

namespace triad {
namespace {

constexpr double clearly_faster = 0.95;

std::vector<std::string> formats_for(const Device& device) {
    const BvhFormat first = default_format(device.info());
    std::vector<std::string> names{name_of(first)};
    for (const BvhFormat format : all_bvh_formats)
        if (format != first) names.push_back(name_of(format));
    return names;
}

std::vector<std::string> locals_for(const Device& device) {
    std::vector<std::string> sizes;
    for (const std::size_t local : {std::size_t(64), std::size_t(8), std::size_t(1)})
        if (local <= std::max<std::size_t>(1, device.info().max_work_group))
            sizes.push_back(std::to_string(local));
    return sizes;
}

void set_all(Device& device, const Tuning& tuning) {
    for (const TuneSearch& search : tune_searches())
        for (const TuneAxis& axis : search.axes)
            if (const auto found = tuning.find(axis.name); found != tuning.end())
                axis.set(device, found->second);
}

/// Every combination of values from axis `next` on, the preferred ones first.
void time_all(Device& device, const TuneSearch& search, Workload& workload, std::size_t next, Tuning& values,
              std::vector<TuneTiming>& timings) {
    if (next == search.axes.size()) {
        timings.push_back({search.name, values, workload.seconds()});
        detail("tuning " + std::string(search.name) + ": " + text_of(values) + ": " +
               std::to_string(1e3 * timings.back().seconds) + " ms");
        return;
    }
    const TuneAxis& axis = search.axes[next];
    for (const std::string& value : axis.values(device)) {
        axis.set(device, value);
        values[axis.name] = value;
        time_all(device, search, workload, next + 1, values, timings);
    }
}

bool grants(const Tuning& values, const Tuning& wishes) {
    return std::all_of(values.begin(), values.end(), [&](const auto& v) {
        const auto wish = wishes.find(v.first);
        return wish == wishes.end() || wish->second == v.second;
    });
}

}  // namespace

const std::vector<TuneSearch>& tune_searches() {
    static const std::vector<TuneSearch> searches{
        {"rays",
         {{"format", formats_for,
           [](Device& device, const std::string& name) { set_format(device, *find_bvh_format(name)); }},
          {"local", locals_for,
           [](Device& device, const std::string& size) { device.set_preferred_local(std::stoul(size)); }}},
         make_ray_workload}};
    return searches;
}

std::vector<TuneTiming> tune(Device& device) {
    std::vector<TuneTiming> timings;
    for (const TuneSearch& search : tune_searches()) {
        const auto workload = search.make(device);
        Tuning values;
        time_all(device, search, *workload, 0, values, timings);
    }
    keep_timings(device.info(), timings);
    set_all(device, best_of(timings));
    return timings;
}

Tuning best_of(const std::vector<TuneTiming>& timings, const Tuning& wishes) {
    std::map<std::string, TuneTiming> best;
    for (const TuneTiming& timing : timings) {
        if (!grants(timing.values, wishes)) continue;
        const auto [found, is_first] = best.try_emplace(timing.search, timing);
        if (is_first) continue;
        const auto preferred = std::find_if(timings.begin(), timings.end(), [&](const TuneTiming& t) {
            return t.search == timing.search && grants(t.values, wishes);
        });
        if (timing.seconds < found->second.seconds && timing.seconds < clearly_faster * preferred->seconds)
            found->second = timing;
    }
    Tuning all;
    for (const auto& [search, timing] : best) all.insert(timing.values.begin(), timing.values.end());
    return all;
}

Tuning ensure_tuned(Device& device, const Tuning& wishes) {
    const auto kept = load_timings(device.info());
    const Tuning best = best_of(kept ? *kept : tune(device), wishes);
    for (const auto& [name, value] : wishes)
        if (const auto found = best.find(name); found == best.end() || found->second != value)
            throw Error(Exit::usage, name + " " + value + ": the device cannot be set so.");
    set_all(device, best);
    return best;
}

std::string text_of(const Tuning& tuning) {
    std::string text;
    for (const auto& [name, value] : tuning) text += (text.empty() ? "" : ", ") + name + " " + value;
    return text;
}

}  // namespace triad
