#include "check/check_beside.h"

#include <unistd.h>

#include <filesystem>

#include "base/files.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "base/parallel_for.h"
#include "base/restart.h"
#include "base/spans.h"
#include "check/verdict.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

Child check_of(const Device& device, const std::string& kernels) {
    Child child{
        .arguments = {"/proc/self/exe", "check", "--first", "--quiet", "--device",
                      std::to_string(device.info().index), "--format", name_of(format_of(device)), "--driver",
                      name_of(path_driver_of(device)), "--max-memory", std::to_string(memory_limit())},
        .environment = bound_to_this_process(),
        .own_group = true};  // an interrupted render waits for the verdict, and saves
    if (!kernels.empty()) child.arguments.insert(child.arguments.end(), {"--kernels", kernels});
    return child;
}

}  // namespace

bool CheckBeside::is_due(const Device& device) {
    if (load_verdict(device.info(), format_of(device), path_driver_of(device))) return false;
    // Another process tells its verdict by that folder.
    if (!restarts_allowed() || host_threads() < 2 || !keeps_cache()) return false;
    const std::filesystem::path folder =
        verdict_path(device.info(), format_of(device), path_driver_of(device)).parent_path();
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    return !folder.empty() && ::access(folder.c_str(), W_OK) == 0;
}

CheckBeside::CheckBeside(const Device& device, const std::string& kernels)
    : device_(device.info().name), check_(check_of(device, kernels)) {
    inform("First use of " + device_ +
           " with this driver: whether its answers are right is checked beside the picture.");
}

void CheckBeside::wait() {
    std::optional<Span> span;
    if (!check_.has_ended()) {
        span.emplace("wait for the check", "device");
        inform("Waiting for the check of " + device_ + ".");
    }
    const std::optional<ChildEnd> end = check_.wait();
    detail("The check beside the picture " +
           (!end          ? "could not be started"
            : end->signal ? "was ended by signal " + std::to_string(end->signal)
                          : "ended with exit code " + std::to_string(end->exit)) +
           ".");
}

}  // namespace triad
