/// One call of triad-replay, in its order: read, check, verify, measure, tune.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include "base/log.h"
#include "base/text.h"
#include "capture/capture.h"
#include "check/check.h"
#include "replay/command_line.h"
#include "replay/include_tree.h"
#include "replay/kernel_rows.h"
#include "replay/replayer.h"
#include "replay/tune_sizes.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {
namespace {

/// Lines are for people; with --json - they would be in the way.
class Lines {
  public:
    explicit Lines(bool shown) : shown_(shown) {}
    void say(const std::string& text) const {
        if (!shown_) return;
        std::fputs(text.c_str(), stdout);
        std::fflush(stdout);
    }

  private:
    bool shown_;
};

std::map<std::string, std::uint64_t> items_of(const Replayer& replayer) {
    std::map<std::string, std::uint64_t> items;
    for (const Recording::Command& command : replayer.capture().work.commands)
        if (const auto* launch = std::get_if<Recording::Launch>(&command))
            items[replayer.kernel_of(*launch)] += launch->items;
    return items;
}

std::string words_of(const Capture& capture) {
    const CaptureOrigin& origin = capture.origin;
    return format(
        "%s\non %s, %s, driver %s, by Triad %s\n%llu x %llu pixels of %llu bins, %zu commands, %zu "
        "kernels, %zu buffers\n",
        origin.command.c_str(), origin.device.c_str(), origin.platform.c_str(), origin.driver.c_str(),
        origin.version.c_str(), static_cast<unsigned long long>(capture.width),
        static_cast<unsigned long long>(capture.height), static_cast<unsigned long long>(capture.bins),
        capture.work.commands.size(), capture.work.functions.size(), capture.work.memories.size());
}

/// As the capture has them.
void set_shape_of(Device& device, const Recording& work) {
    for (const Recording::Source& source : work.sources) {
        const auto format = source.options.find("TRIAD_BVH4");
        if (format != source.options.end())
            set_format(device, format->second == "1" ? BvhFormat::bvh4 : BvhFormat::bvh8);
        if (source.path.starts_with("path/wave_stages"))
            set_path_driver(device, PathDriverKind::wave_stages);
        else if (source.path.starts_with("path/wave"))
            set_path_driver(device, PathDriverKind::wave);
    }
}

/// With a device of its own, whose shape is the check's.
Json check(const ReplayRequest& o, const Capture& capture, const Lines& lines) {
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    set_shape_of(device, capture.work);
    Json rows = Json::array();
    std::size_t wrong = 0;
    run_cases(device, cases_of(CheckLevel::quick), CheckLevel::quick, [&](const CheckResult& r) {
        wrong += r.ok == false;
        rows.push_back({{"case", r.name},
                        {"value", r.ok && std::isfinite(r.value) ? Json(r.value) : Json()},
                        {"bound", r.ok ? Json(r.bound) : Json()},
                        {"ok", r.ok ? Json(*r.ok) : Json()}});
        lines.say(format("%-62s %s\n", r.name.c_str(), !r.ok ? "not applicable" : *r.ok ? "ok" : "WRONG"));
        for (const std::string& failure : r.failures) lines.say("    " + failure + "\n");
    });
    if (wrong > 0)
        throw Error(Exit::device, device.info().name + " with driver " + device.info().driver +
                                      " is wrong: " + std::to_string(wrong) + " cases.");
    return rows;
}

/// Of the launches of a kernel in one run.
std::size_t chosen_launch(Replayer& replayer, const ReplayRequest& o) {
    const std::vector<std::size_t> places = replayer.launches_of(o.kernel);
    if (places.empty()) {
        std::string names;
        for (const Recording::Function& function : replayer.capture().work.functions)
            names += (names.empty() ? "" : ", ") + function.name;
        throw Error(Exit::usage, "--single-kernel " + o.kernel + ": the capture has no such kernel; it has " +
                                     names + ".");
    }
    if (o.launch && *o.launch > places.size())
        throw Error(Exit::usage, "--launch " + std::to_string(*o.launch) + ": the capture has " +
                                     std::to_string(places.size()) + " launches of " + o.kernel + ".");
    if (o.launch) return places[*o.launch - 1];
    replayer.take_times();
    replayer.run();
    const std::vector<double> times = replayer.take_times()[o.kernel];
    return places[std::size_t(std::max_element(times.begin(), times.end()) - times.begin())];
}

std::vector<LaunchRow> measured_alone(Replayer& replayer, const ReplayRequest& o, const Lines& lines) {
    const std::size_t place = chosen_launch(replayer, o);
    const std::vector<std::size_t> places = replayer.launches_of(o.kernel);
    const auto number = std::find(places.begin(), places.end(), place) - places.begin() + 1;
    lines.say(
        format("Launch %zu of %zu of %s, alone\n", std::size_t(number), places.size(), o.kernel.c_str()));
    replayer.repeat(place, o.repeat);
    const auto& launch = std::get<Recording::Launch>(replayer.capture().work.commands[place]);
    return kernel_rows({{o.kernel, launch.items}}, replayer.take_times(), o.repeat);
}

/// Some drivers stamp the events of all launches with the same time.
constexpr double least_share_of_events = 0.01;

struct Measured {
    std::vector<LaunchRow> rows;
    double ms_of_run = 0;  ///< by the host's clock: the least
};

Measured measured(Replayer& replayer, unsigned runs, const LocalSizes& sizes = {}) {
    replayer.take_times();
    double least = INFINITY;
    for (unsigned i = 0; i < runs; ++i) least = std::min(least, replayer.run(sizes));
    Measured m{kernel_rows(items_of(replayer), replayer.take_times(), runs), 1e3 * least};
    double events = 0;
    for (const LaunchRow& row : m.rows) events += row.ms_total;
    if (events < least_share_of_events * m.ms_of_run)
        warn(format(
            "The driver's profiling events add up to %.3g of the %.3g ms that a run takes: it does not "
            "time launches, and the rows say nothing.",
            events, m.ms_of_run));
    return m;
}

std::string text_of(const Measured& m) {
    return table_text(m.rows) + format("A run takes %.3f ms by the host's clock\n", m.ms_of_run);
}

/// Of runs on one device.
void require_same(Replayer& replayer, const ReplayedFilm& film) {
    if (replayer.film() != film)
        throw Error(Exit::comparison,
                    "The last run ended with other bits than the first: the device does not repeat itself.");
}

}  // namespace

Exit replay(const ReplayRequest& o) {
    Capture capture = read_capture(o.capture);
    const Lines lines(o.json != "-");
    if (!o.extract.empty()) {
        extract(capture.work.sources, o.extract);
        lines.say("The programs are in " + o.extract + "; to run them from there: --kernels " + o.extract +
                  "\n");
        return Exit::done;
    }
    lines.say(words_of(capture));
    std::vector<std::string> changed;
    if (!o.kernels.empty()) {
        capture.work.sources = from_folder(capture.work.sources, o.kernels, changed);
        for (const std::string& path : changed) lines.say(path + " is not as captured\n");
        if (changed.empty()) lines.say("The programs are as captured\n");
    }
    Json more = {{"capture",
                  {{"file", o.capture},
                   {"command", capture.origin.command},
                   {"device", capture.origin.device},
                   {"driver", capture.origin.driver},
                   {"version", capture.origin.version}}},
                 {"changed_programs", changed}};
    if (o.check) more["check"] = check(o, capture, lines);

    Device device = Device::open({.selector = o.device, .threads = o.threads, .profile = true});
    lines.say(format("Replayed on %s, %s, driver %s\n", device.info().name.c_str(),
                     device.info().platform.c_str(), device.info().driver.c_str()));
    Replayer replayer(device, capture);
    replayer.run();
    const ReplayedFilm film = replayer.film();
    const Verification verification = judge(capture, device, film, o.rule);
    more["verification"] = to_json(verification);
    if (verification.ok) lines.say(verification.sentence + "\n");

    std::vector<LaunchRow> rows;
    if (o.repeat > 0 && !o.kernel.empty()) {
        rows = measured_alone(replayer, o, lines);
        lines.say(table_text(rows));
    } else if (o.repeat > 0) {
        const Measured all = measured(replayer, o.repeat);
        require_same(replayer, film);
        rows = all.rows;
        lines.say(text_of(all));
        more["run_ms"] = all.ms_of_run;
    }
    if (o.tune && o.repeat > 0) {
        const std::vector<SizeTiming> timings = tune_sizes(replayer, film, o.repeat);
        lines.say(table_text(timings));
        const Measured tuned = measured(replayer, o.repeat, best_of(timings));
        require_same(replayer, film);
        lines.say("With the best of them:\n" + text_of(tuned));
        more["sizes"] = to_json(timings);
        more["tuned_rows"] = to_json(tuned.rows);
    }
    if (!o.json.empty()) write_report(o.json, "replay", &device.info(), to_json(rows), more);
    if (!verification.ok) throw Error(Exit::comparison, verification.sentence);
    return Exit::done;
}

}  // namespace triad
