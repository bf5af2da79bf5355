/// One call of triad-replay, in its order: read, check, verify, measure, tune.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <variant>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/text.h"
#include "capture/capture.h"
#include "check/check.h"
#include "profile/kernel_changes.h"
#include "profile/profile_page.h"
#include "profile/profile_report.h"
#include "replay/captured_shape.h"
#include "replay/command_line.h"
#include "replay/include_tree.h"
#include "replay/replay_profile.h"
#include "replay/replayer.h"
#include "replay/tune_sizes.h"

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

/// With a device of its own, whose shape is the check's.
Json check(const ReplayRequest& o, const Capture& capture, const Lines& lines) {
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    set_format(device, captured_format(capture.work));
    set_path_driver(device, captured_driver(capture.work));
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
    std::vector<std::int64_t> times;
    for (const DeviceCommand& command : replayer.run().commands)
        if (command.name == o.kernel) times.push_back(command.end - command.start);
    return places[std::size_t(std::max_element(times.begin(), times.end()) - times.begin())];
}

Profile measured_alone(Replayer& replayer, const ReplayRequest& o, const Lines& lines) {
    const std::size_t place = chosen_launch(replayer, o);
    const std::vector<std::size_t> places = replayer.launches_of(o.kernel);
    const auto number = std::find(places.begin(), places.end(), place) - places.begin() + 1;
    lines.say(
        format("Launch %zu of %zu of %s, alone\n", std::size_t(number), places.size(), o.kernel.c_str()));
    return profile_alone(replayer, place, o.repeat);
}

/// Of runs on one device.
void require_same(Replayer& replayer, const ReplayedFilm& film) {
    if (replayer.film() != film)
        throw Error(Exit::comparison,
                    "The last run ended with other bits than the first: the device does not repeat itself.");
}

/// What the JSON has of it.
Json tune(Replayer& replayer, const ReplayedFilm& film, unsigned runs, const Lines& lines) {
    const std::vector<SizeTiming> timings = tune_sizes(replayer, film, runs);
    lines.say(table_text(timings));
    const Profile tuned = profile_of(replayer, runs, best_of(timings));
    require_same(replayer, film);
    lines.say("With the best of them:\n" + kernels_table(tuned) + "\n");
    return {{"sizes", to_json(timings)}, {"tuned_rows", rows_of({tuned})}};
}

/// What a report of other work is told by: equal work makes an equal film.
Json workload_of(const Capture& capture, const ReplayRequest& o) {
    Hash film;
    for (const CapturedArray& array : capture.film) film.add(array.content->data(), array.content->size());
    Json work = {{"film", film.hex()}};
    if (!o.kernel.empty()) work["launch"] = o.kernel + " " + std::to_string(o.launch.value_or(0));
    return work;
}

/// The same as triad profile's. Whether a kernel became slower.
bool report(const Profile& p, const ReplayRequest& o, const Json& before, Json more, const Lines& lines) {
    lines.say(table_of({p}));
    more["devices"] = devices_of({p});
    if (!o.json.empty()) write_report(o.json, "replay", &p.device, rows_of({p}), more);
    if (!o.folder.empty()) {
        write_file(std::filesystem::path(o.folder) / "index.html", profile_page({p}, {}, command_words()));
        lines.say("Page: " + o.folder + "/index.html\n");
    }
    if (before.is_null()) return false;
    const std::vector<KernelChange> changes = changes_since(before, {p});
    lines.say("\n" + table_of(changes));
    return any_slower(changes);
}

/// Before anything is done.
void check_paths(const ReplayRequest& o) {
    const std::vector<std::string> inputs{o.capture, o.kernels, o.against};
    check_outputs({o.json}, inputs);
    check_output_folder(o.folder, {"index.html"}, inputs);
    if (o.repeat == 0 && !(o.folder.empty() && o.against.empty()))
        throw Error(Exit::usage, "--repeat 0 measures nothing that -o could show or --against compare.");
}

}  // namespace

Exit replay(const ReplayRequest& o) {
    check_paths(o);
    const Json before = o.against.empty() ? Json() : earlier_report(o.against, "replay");
    Capture capture = read_capture(o.capture);
    const std::optional<WorkCounts> counted = counted_work(capture);
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
                 {"workload", workload_of(capture, o)},
                 {"changed_programs", changed}};
    if (!before.is_null()) require_same_work(before, more.at("workload"));
    if (o.check) more["check"] = check(o, capture, lines);

    Device device = Device::open({.selector = o.device, .threads = o.threads, .profile = true});
    lines.say(format("Replayed on %s, %s, driver %s\n", device.info().name.c_str(),
                     device.info().platform.c_str(), device.info().driver.c_str()));
    if (!before.is_null()) require_comparable(before, device.info(), o.repeat);
    Replayer replayer(device, capture);
    replayer.run();
    const ReplayedFilm film = replayer.film();
    const Verification verification = judge(capture, device, film, o.rule);
    more["verification"] = to_json(verification);
    if (verification.ok) lines.say(verification.sentence + "\n");

    bool is_slower = false;
    if (o.repeat == 0) {
        if (!o.json.empty()) write_report(o.json, "replay", &device.info(), Json::array(), more);
    } else {
        Profile p = o.kernel.empty() ? profile_of(replayer, o.repeat) : measured_alone(replayer, o, lines);
        if (o.kernel.empty()) require_same(replayer, film);
        if (o.tune) more.update(tune(replayer, film, o.repeat, lines));
        if (counted) add_costs(p, *counted, peaks_of(device));
        is_slower = report(p, o, before, more, lines);
    }
    if (!verification.ok) throw Error(Exit::comparison, verification.sentence);
    return is_slower ? Exit::comparison : Exit::done;
}

}  // namespace triad
