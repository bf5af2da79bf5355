#include "api/kept_devices.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace triad::api {
namespace {

/// What open_devices() reads of a request.
using Choice = std::tuple<std::string, unsigned, std::optional<BvhFormat>, std::optional<PathDriverKind>,
                          std::string, bool, bool>;

Choice choice_of(const RenderRequest& o) {
    return {o.device, o.threads, o.format, o.path_driver, o.kernels_path, o.force, o.profile};
}

/// Programs alternate between a few at most; each holds what was compiled for it.
constexpr std::size_t most_kept = 4;

/// The oldest first. Lives on when the program ends: drivers may be gone by then.
std::vector<std::pair<Choice, OpenDevices>>& kept() {
    static auto& all = *new std::vector<std::pair<Choice, OpenDevices>>;
    return all;
}

}  // namespace

OpenDevices take_devices(const RenderRequest& request) {
    const auto found =
        std::find_if(kept().begin(), kept().end(),
                     [choice = choice_of(request)](const auto& k) { return k.first == choice; });
    if (found == kept().end()) return {};
    OpenDevices devices = std::move(found->second);
    kept().erase(found);
    return devices;
}

void keep_devices(const RenderRequest& request, OpenDevices devices) {
    if (kept().size() == most_kept) kept().erase(kept().begin());
    kept().emplace_back(choice_of(request), std::move(devices));
}

}  // namespace triad::api
