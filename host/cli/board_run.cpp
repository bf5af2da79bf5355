#include "cli/board_run.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/machine.h"
#include "base/text.h"
#include "bench/ray_bench.h"
#include "check/check.h"
#include "check/verdict.h"
#include "cli/board_scenes.h"
#include "cli/suite.h"
#include "trace/node_format.h"
#include "trace/tune.h"

namespace triad {
namespace {

constexpr unsigned ray_size = 512;

BoardRow row_of(const CheckResult& result) {
    std::string note = result.what;
    for (const std::string& failure : result.failures) note += (note.empty() ? "" : "; ") + failure;
    return {.part = BoardPart::check,
            .name = result.name,
            .value = {result.value, result.value, result.value},
            .is_right = result.ok.value_or(true),
            .note = note};
}

}  // namespace

BoardRun::BoardRun(const Settings& settings, Report report)
    : settings_(settings),
      report_(std::move(report)),
      plan_(settings.seconds),
      device_(Device::open({.selector = settings.device, .threads = settings.threads, .profile = true})) {
    scenes_ = suite_scenes(scenes_folder());
    ensure_tuned(device_);
    ways_ = path_ways(device_);
    const DeviceInfo& info = device_.info();
    board_.device = info.name, board_.driver = info.driver, board_.platform = info.platform;
    board_.machine = machine_words(), board_.version = TRIAD_VERSION;
    add_steps();
    for (const Step& step : steps_) plan_.add(step.guess);
}

void BoardRun::add(const std::string& words, double guess, std::function<std::vector<BoardRow>()> measure) {
    steps_.push_back({words, guess, std::move(measure)});
}

/// By ways [first, end).
void BoardRun::add_paths(std::size_t first, std::size_t end) {
    for (std::size_t way = first; way < end; ++way)
        add("paths by " + ways_[way].text(), way == 0 ? 10 : 14,
            [this, way] { return measure_paths(device_, ways_[way], peaks_, counts_); });
}

void BoardRun::add_display() {
    add("display", 6, [this] { return measure_display(device_); });
}

void BoardRun::add_errors(std::size_t first_scene, std::size_t last_scene, std::size_t first,
                          std::size_t end) {
    const double guess = settings_.is_quick ? 3 : 8;
    for (std::size_t i = first_scene; i < last_scene; ++i)
        for (std::size_t way = first; way < end; ++way)
            add("error of " + scenes_[i].name + (way == 0 ? "" : ", way " + std::to_string(way + 1)), guess,
                [this, scene = scenes_[i], way] {
                    set_way(device_, ways_[way]);
                    const BoardErrorPlan plan{.repetitions = settings_.is_quick || way > 0 ? 1u : 3u};
                    return measure_errors(device_, board_scene(scene, scenes_folder()), plan,
                                          digests_[scene.name], within_step());
                });
}

/// What says most comes first: at the end time may be short.
void BoardRun::add_steps() {
    const double answers_guess = settings_.is_quick ? 8 : 14;
    add("known answers", answers_guess, [this] { return answers(); });
    add("peaks", 4, [this] { return rows_of(peaks_ = peaks_of(device_)); });
    const auto add_rays = [this](const std::string& scene, double guess) {
        add("rays in " + scene, guess,
            [this, scene] { return measure_rays(device_, scene, ray_size, [this] { return go_on(); }); });
    };
    add_rays("room", 4);
    if (settings_.is_quick) {
        add_paths(0, 1);
        add_errors(0, 3, 0, 1);
        add_display();
        add_errors(3, scenes_.size(), 0, 1);
        return add_paths(1, ways_.size());
    }
    add_rays("cornell", 2);
    add_rays("landscape", 12);
    add_paths(0, ways_.size());
    add_display();
    add_errors(0, scenes_.size(), 0, 1);
    add("functions alone", 45, [this] { return measure_functions(device_, [this] { return go_on(); }); });
    add_errors(0, scenes_.size(), 1, ways_.size());
}

bool BoardRun::tell() {
    is_interrupted_ |= !report_(doing_, plan_.elapsed(), plan_.estimate());
    return !is_interrupted_;
}

/// Compiling, before this is first asked, does not count: else there would be programs and no errors.
std::function<bool()> BoardRun::within_step() {
    return [this, end = std::optional<double>()]() mutable {
        if (!end) end = plan_.elapsed() + plan_.of_step();
        return tell() && plan_.elapsed() < *end && plan_.left() > 0;
    };
}

bool BoardRun::go_on() { return tell() && plan_.left_of_step() > 0; }

/// The cases of triad check --quick, or of a first render, by the device's own way.
std::vector<BoardRow> BoardRun::answers() {
    std::vector<BoardRow> rows;
    for (const CheckCase& each : settings_.is_quick ? first_cases() : cases_of(CheckLevel::quick)) {
        if (!each.run) continue;  // no kernel can answer it
        rows.push_back(row_of(run_case(device_, each, CheckLevel::quick)));
        if (!tell()) break;
    }
    return rows;
}

/// Once all ways were measured: the errors of scenes are found by the fastest.
void BoardRun::prefer_fastest() {
    const auto speeds = board_.of(BoardPart::paths);
    if (speeds.size() < ways_.size()) return;
    const auto speed_of = [&](const PathWay& way) {
        for (const BoardRow* row : speeds)
            if (row->format == name_of(way.format) && row->path_driver == name_of(way.driver))
                return row->value.value;
        return 0.0;
    };
    std::stable_sort(ways_.begin(), ways_.end(),
                     [&](const PathWay& a, const PathWay& b) { return speed_of(a) > speed_of(b); });
}

void BoardRun::take(const Step& step) {
    doing_ = step.words;
    tell();
    const double before = plan_.elapsed();
    try {
        std::vector<BoardRow> rows = step.measure();
        if (rows.empty()) late_.push_back(step.words);
        for (BoardRow& row : rows) board_.rows.push_back(std::move(row));
    } catch (const DeviceError& error) {
        has_failed_ = true;
        board_.left_out.push_back(step.words + ": " + error.what());
    } catch (const Error& error) {
        if (error.exit() == Exit::comparison)
            board_.rows.push_back(
                {.part = BoardPart::function, .name = step.words, .is_right = false, .note = error.what()});
        else
            board_.left_out.push_back(step.words + ": " + error.what());
    }
    detail(step.words + format(": %.1f s", plan_.elapsed() - before));
}

Board BoardRun::run() {
    for (const Step& step : steps_) {
        if (!plan_.begin() || is_interrupted_) {
            late_.push_back(step.words);
            continue;
        }
        take(step);
        if (&step == &steps_.front() && !board_.is_right()) {
            board_.left_out.push_back("The device gives wrong answers: its speed is of no interest.");
            break;
        }
        if (&step != &steps_.back() && step.words.starts_with("paths")) prefer_fastest();
    }
    std::string late;
    for (const std::string& words : late_) late += (late.empty() ? "" : "; ") + words;
    if (!late.empty())
        board_.left_out.push_back((is_interrupted_ ? "Stopped before: " : "There was no time for: ") + late +
                                  ".");
    if (settings_.is_quick)
        board_.left_out.push_back(
            "--quick leaves out rays of two scenes, functions alone, errors by other ways and most known "
            "answers.");
    board_.seconds = plan_.elapsed();
    return board_;
}

}  // namespace triad
