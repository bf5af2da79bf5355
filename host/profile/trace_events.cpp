// The time line of a profile for Perfetto.
#include <algorithm>

#include "profile/profile_report.h"

namespace triad {
namespace {

constexpr int host_process = 1, device_process = 2;

Json named(const char* what, int process, unsigned thread, const std::string& name) {
    return {{"name", what}, {"ph", "M"}, {"pid", process}, {"tid", thread}, {"args", {{"name", name}}}};
}

Json complete(const std::string& name, const char* category, int process, unsigned thread, std::int64_t start,
              std::int64_t end, std::int64_t zero, Json arguments) {
    return {{"name", name},
            {"cat", category},
            {"ph", "X"},
            {"pid", process},
            {"tid", thread},
            {"ts", 1e-3 * double(start - zero)},
            {"dur", 1e-3 * double(end - start)},
            {"args", std::move(arguments)}};
}

}  // namespace

Json trace_of(const Profile& profile, const std::vector<HostSpan>& spans) {
    std::int64_t zero = INT64_MAX;
    for (const HostSpan& span : spans) zero = std::min(zero, span.start);
    for (const DeviceCommand& c : profile.commands) zero = std::min(zero, c.start + profile.clock_offset);
    Json events = Json::array();
    events.push_back(named("process_name", host_process, 0, "host"));
    events.push_back(named("process_name", device_process, 0, profile.device.name));
    events.push_back(named("thread_name", device_process, 0, "queue"));
    unsigned threads = 0;
    for (const HostSpan& span : spans) {
        for (; threads <= span.thread; ++threads)
            events.push_back(named("thread_name", host_process, threads,
                                   threads == 0 ? "main" : "thread " + std::to_string(threads)));
        events.push_back(complete(span.name, "host", host_process, span.thread, span.start, span.end, zero,
                                  Json::object()));
    }
    for (const DeviceCommand& c : profile.commands) {
        Json arguments = c.kind == CommandKind::kernel ? Json{{"items", c.items}, {"local", c.local}}
                                                       : Json{{"bytes", c.bytes}};
        events.push_back(complete(c.name, c.kind == CommandKind::kernel ? "kernel" : "transfer",
                                  device_process, 0, c.start + profile.clock_offset,
                                  c.end + profile.clock_offset, zero, std::move(arguments)));
    }
    return {{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
}

}  // namespace triad
