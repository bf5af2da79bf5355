// Waiting for a device that may never answer.
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "device/opencl.h"

namespace triad {
namespace {

std::atomic<bool> some_device_hangs = false;

}  // namespace

bool any_device_hangs() { return some_device_hangs; }

namespace opencl {
namespace {

/// What the driver's thread says when it comes to the end of the queue. Two own it: who waits, and the
/// callback, which may come late or never.
struct Answer {
    std::mutex mutex;
    std::condition_variable told;
    bool has_come = false;
    cl_int status = CL_SUCCESS;
};

void CL_CALLBACK on_answer(cl_event, cl_int status, void* data) {
    const std::unique_ptr<std::shared_ptr<Answer>> answer(static_cast<std::shared_ptr<Answer>*>(data));
    const std::lock_guard lock((*answer)->mutex);
    (*answer)->has_come = true, (*answer)->status = status;
    (*answer)->told.notify_one();
}

/// Of a wait: a process that was stopped for a while has waited no longer than one of these.
constexpr double slice = 0.25;

}  // namespace

void DeviceState::await() {
    if (patience <= 0) return;
    cl_event event = nullptr;
    core->check("clEnqueueMarkerWithWaitList", clEnqueueMarkerWithWaitList(commands(), 0, nullptr, &event));
    const std::shared_ptr<void> marker = own(event, clReleaseEvent, core);
    const auto answer = std::make_shared<Answer>();
    core->check("clSetEventCallback",
                clSetEventCallback(event, CL_COMPLETE, on_answer, new std::shared_ptr<Answer>(answer)));
    core->check("clFlush", clFlush(commands()));
    std::unique_lock lock(answer->mutex);
    for (double waited = 0; !answer->has_come; waited += slice) {
        if (waited >= patience) {
            core->lost = some_device_hangs = true;
            throw DeviceError(Exit::device, CL_DEVICE_NOT_AVAILABLE,
                              "The device " + core->info.name + " has not answered for " +
                                  std::to_string(int(waited)) + " s and is not used any more.");
        }
        answer->told.wait_for(lock, std::chrono::duration<double>(slice), [&] { return answer->has_come; });
    }
    if (answer->status < 0) core->check("A launch", answer->status);
}

}  // namespace opencl
}  // namespace triad
