#include "trace/tune.h"

#include <algorithm>
#include <exception>
#include <functional>

#include "base/log.h"
#include "base/without_details.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"
#include "trace/tune_paths.h"
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

std::vector<std::string> path_drivers_for(const Device& device) {
    const PathDriverKind preferred = default_path_driver(device.info());
    std::vector<std::string> names{name_of(preferred)};
    for (const PathDriverKind kind : all_path_drivers)
        if (kind != preferred && (kind != PathDriverKind::wave || device.info().type == "cpu"))
            names.push_back(name_of(kind));
    return names;
}

/// Of wave_stages alone; the others have none.
std::vector<std::string> batches_for(const Device& device) {
    if (path_driver_of(device) != PathDriverKind::wave_stages) return {"0"};
    const std::uint32_t units = std::max(1u, device.info().compute_units);
    std::vector<std::string> sizes;
    for (const std::uint32_t each : {paths_per_unit, paths_per_unit / 4, paths_per_unit * 4})
        sizes.push_back(std::to_string(units * each));
    return sizes;
}

/// Of 32 bits.
bool is_number(const std::string& text) {
    return !text.empty() && text.size() < 10 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// What is best by the timings; of axes without any, what is wished for if there is such a value, or the
/// preferred one.
Tuning set_best(Device& device, const std::vector<TuneTiming>& timings, const Tuning& wishes = {}) {
    Tuning best = best_of(timings, wishes);
    for (const TuneSearch& search : tune_searches())
        for (const TuneAxis& axis : search.axes) {
            if (!best.contains(axis.name)) {
                const std::vector<std::string> values = axis.values(device);
                const auto wish = wishes.find(axis.name);
                const bool granted =
                    wish != wishes.end() && std::count(values.begin(), values.end(), wish->second) > 0;
                best[axis.name] = granted ? wish->second : values.front();
            }
            axis.set(device, best.at(axis.name));
        }
    return best;
}

std::vector<TuneTiming> run_searches(Device& device, const std::function<bool(const TuneSearch&)>& wanted) {
    std::vector<TuneTiming> timings;
    for (const TuneSearch& search : tune_searches()) {
        if (!wanted(search)) continue;
        set_best(device, timings);
        const std::vector<TuneTiming> more = time_search(device, search);
        timings.insert(timings.end(), more.begin(), more.end());
    }
    keep_timings(device.info(), timings);
    return timings;
}

/// Every combination of values from axis `next` on, the preferred ones first.
void time_all(Device& device, const TuneSearch& search, std::size_t next, Tuning& values,
              const std::function<void()>& time) {
    if (next == search.axes.size()) return time();
    const TuneAxis& axis = search.axes[next];
    for (const std::string& value : axis.values(device)) {
        axis.set(device, value);
        values[axis.name] = value;
        time_all(device, search, next + 1, values, time);
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
         TuneWhen::first_use,
         {{"format", formats_for, [](const std::string& name) { return find_bvh_format(name).has_value(); },
           [](Device& device, const std::string& name) { set_format(device, *find_bvh_format(name)); }},
          {"local", locals_for, is_number,
           [](Device& device, const std::string& size) { device.set_preferred_local(std::stoul(size)); }}},
         make_ray_workload},
        {"paths",
         TuneWhen::asked,
         {{"path_driver", path_drivers_for,
           [](const std::string& name) { return find_path_driver(name).has_value(); },
           [](Device& device, const std::string& name) { set_path_driver(device, *find_path_driver(name)); }},
          {"batch", batches_for, is_number,
           [](Device& device, const std::string& paths) {
               set_batch(device, std::uint32_t(std::stoul(paths)));
           }}},
         make_path_workload}};
    return searches;
}

std::vector<TuneTiming> time_search(Device& device, const TuneSearch& search) {
    for (const TuneAxis& axis : search.axes) axis.set(device, axis.values(device).front());
    const auto workload = [&] {
        const WithoutDetails quiet;
        return search.make(device);
    }();
    std::vector<TuneTiming> timings;
    std::exception_ptr refused;
    Tuning values;
    time_all(device, search, 0, values, [&] {
        const std::string words = "tuning " + std::string(search.name) + ": " + text_of(values) + ": ";
        try {
            timings.push_back({search.name, values, workload->seconds()});
            detail(words + std::to_string(1e3 * timings.back().seconds) + " ms");
        } catch (const DeviceError& error) {
            refused = std::current_exception();
            warn(words + "not measured, and not used. " + error.what());
        }
    });
    if (timings.empty() && refused) std::rethrow_exception(refused);
    return timings;
}

std::vector<TuneTiming> tune(Device& device) {
    const auto timings = run_searches(device, [](const TuneSearch&) { return true; });
    set_best(device, timings);
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
    auto timings = load_timings(device.info());
    if (!timings)
        timings =
            run_searches(device, [](const TuneSearch& search) { return search.when == TuneWhen::first_use; });
    const Tuning best = set_best(device, *timings, wishes);
    for (const auto& [name, value] : wishes)
        if (const auto found = best.find(name); found == best.end() || found->second != value)
            throw Error(Exit::usage, name + " " + value + ": the device cannot be set so.");
    return best;
}

std::string text_of(const Tuning& tuning) {
    std::string text;
    for (const auto& [name, value] : tuning) text += (text.empty() ? "" : ", ") + name + " " + value;
    return text;
}

}  // namespace triad
