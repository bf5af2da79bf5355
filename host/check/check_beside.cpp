#include "check/check_beside.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/child.h"
#include "base/log.h"
#include "base/restart.h"
#include "check/verdict.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

/// A driver that takes longer hangs.
constexpr double most_seconds = 600;

}  // namespace

bool can_check_beside(const Device& device) {
    if (!restarts_allowed()) return false;
    const std::filesystem::path folder = kept_path(device.info(), "checked").parent_path();
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return !folder.empty() && ::access(folder.c_str(), W_OK) == 0;
}

CheckBeside::CheckBeside(const Device& device, const std::string& selector, unsigned threads,
                         const std::string& kernels) {
    inform("First use of " + device.info().name +
           " with this driver: whether its answers are right is checked beside the picture, which is written "
           "if they are.");
    Child child{
        .arguments = {"/proc/self/exe", "check", "--first", "--quiet", "--format", name_of(format_of(device)),
                      "--driver", name_of(path_driver_of(device)), "--threads", std::to_string(threads)},
        .seconds = most_seconds};
    if (!selector.empty()) child.arguments.insert(child.arguments.end(), {"--device", selector});
    if (!kernels.empty()) child.arguments.insert(child.arguments.end(), {"--kernels", kernels});
    std::promise<void> end;
    ended_ = end.get_future();
    // Not waited for by a program that ends before: the verdict is for the next one, then.
    std::thread([child = std::move(child), end = std::move(end)]() mutable {
        run_child(child);
        end.set_value();
    }).detach();
}

bool CheckBeside::has_ended() const {
    return ended_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace triad
