#include "replay/tune_sizes.h"

#include <algorithm>
#include <map>
#include <variant>

#include "base/error.h"
#include "base/text.h"

namespace triad {
namespace {

constexpr double clearly_faster = 0.95;

/// That launches leave open.
std::vector<std::string> open_kernels(const Replayer& replayer) {
    std::vector<std::string> names;
    for (const Recording::Command& command : replayer.capture().work.commands) {
        const auto* launch = std::get_if<Recording::Launch>(&command);
        if (!launch || launch->local != 0) continue;
        const std::string& name = replayer.kernel_of(*launch);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

}  // namespace

std::vector<SizeTiming> tune_sizes(Replayer& replayer, const ReplayedFilm& film, unsigned runs) {
    const std::vector<std::string> names = open_kernels(replayer);
    const std::size_t most = std::max<std::size_t>(1, replayer.device().info().max_work_group);
    std::map<std::string, std::vector<SizeTiming>> by_kernel;
    for (const std::size_t local : {64u, 1u, 8u, 16u, 32u, 128u, 256u, 512u}) {
        if (local > most) continue;
        LocalSizes sizes;
        for (const std::string& name : names) sizes[name] = local;
        replayer.run(sizes);  // some drivers compile a kernel for each size
        std::map<std::string, double> least;
        for (unsigned i = 0; i < runs; ++i) {
            std::map<std::string, double> sums;
            for (const DeviceCommand& command : replayer.run(sizes).commands)
                sums[command.name] += 1e-9 * double(command.end - command.start);
            for (const auto& [name, sum] : sums) {
                const auto [found, is_first] = least.try_emplace(name, sum);
                if (!is_first) found->second = std::min(found->second, sum);
            }
        }
        if (replayer.film() != film)
            throw Error(Exit::comparison, "With groups of " + std::to_string(local) +
                                              " work-items the film has other bits: the driver is wrong, or "
                                              "kernels race with each other.");
        for (const std::string& name : names) by_kernel[name].push_back({name, local, least[name]});
    }
    std::vector<SizeTiming> all;
    for (const std::string& name : names) {
        auto& timings = by_kernel[name];
        const auto least = std::min_element(timings.begin(), timings.end(), [](const auto& a, const auto& b) {
            return a.seconds < b.seconds;
        });
        (least->seconds < clearly_faster * timings.front().seconds ? *least : timings.front()).best = true;
        all.insert(all.end(), timings.begin(), timings.end());
    }
    return all;
}

LocalSizes best_of(const std::vector<SizeTiming>& timings) {
    LocalSizes sizes;
    for (const SizeTiming& timing : timings)
        if (timing.best) sizes[timing.kernel] = timing.local;
    return sizes;
}

Json to_json(const std::vector<SizeTiming>& timings) {
    Json all = Json::array();
    for (const SizeTiming& t : timings)
        all.push_back(
            {{"kernel", t.kernel}, {"local", t.local}, {"ms_total", 1e3 * t.seconds}, {"best", t.best}});
    return all;
}

std::string table_text(const std::vector<SizeTiming>& timings) {
    std::string text;
    for (const SizeTiming& t : timings)
        text += format("%c %-24s groups of %4zu %11.3f ms\n", t.best ? '*' : ' ', t.kernel.c_str(), t.local,
                       1e3 * t.seconds);
    return text + "* the best; 64 unless another takes 5 % less time\n";
}

}  // namespace triad
