#include "cli/bench_device.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel_for.h"
#include "base/progress.h"
#include "cli/board_run.h"
#include "cli/command_line.h"
#include "cli/option_kinds.h"
#include "report/board_json.h"
#include "report/board_page.h"
#include "report/board_table.h"

namespace triad {
namespace {

/// The promise of the manual, on two cores.
constexpr double whole_seconds = 600, quick_seconds = 60;

struct BenchDeviceOptions {
    std::string device, folder, json, kernels;
    std::string progress = "auto";
    unsigned threads = 0;
    bool is_quick = false;
    double time = 0;  ///< 0: by is_quick
    std::vector<std::string> against;
};

/// Selectors of Device::open, at least one.
std::vector<std::string> boards_named(const std::string& list) {
    std::vector<std::string> names;
    if (list == "all") {
        for (const DeviceInfo& device : list_devices().devices)
            if (device.usable) names.push_back(std::to_string(device.index));
    } else {
        std::istringstream words(list);
        for (std::string word; std::getline(words, word, ',');) names.push_back(word);
    }
    if (names.empty()) names.emplace_back();
    return names;
}

/// What came of all boards.
struct BoardsRun {
    std::vector<Board> boards;
    std::optional<DeviceInfo> device;  ///< the first
    bool is_interrupted = false, has_failed = false;
};

BoardsRun measure(const BenchDeviceOptions& o) {
    if (!o.kernels.empty()) kernel_source::set_folder(o.kernels);
    set_host_threads(o.threads);
    const InterruptGuard guard;
    ProgressDisplay display(progress_style(o.progress));
    constexpr double to_measure = 0.97;  // the rest is for plots
    const double limit = to_measure * (o.time > 0 ? o.time : o.is_quick ? quick_seconds : whole_seconds);
    const std::vector<std::string> names = boards_named(o.device);
    BoardsRun all;
    const TimePlan whole(limit);
    for (std::size_t i = 0; i < names.size() && !all.is_interrupted; ++i) {
        const double others = double(names.size() - i - 1);
        const double share = std::max(0.0, whole.left()) / (others + 1);
        const auto report = [&](const std::string& doing, double, double left) {
            const double after = std::max(0.0, left) + others * share, before = whole.elapsed();
            display.update({.done = before / std::max(before + after, 1e-9),
                            .seconds = before,
                            .seconds_left = after,
                            .doing = names.size() > 1 ? "device " + names[i] + ", " + doing : doing});
            return !guard.interrupted();
        };
        BoardRun run({o.device.empty() ? "" : names[i], o.threads, o.is_quick, share}, report);
        all.boards.push_back(run.run());
        if (!all.device) all.device = run.device();
        all.is_interrupted |= run.is_interrupted(), all.has_failed |= run.has_failed();
    }
    return all;
}

void write_boards(const BenchDeviceOptions& o, const BoardsRun& all) {
    if (o.json != "-") std::fputs(table_of(all.boards).c_str(), stdout);
    const auto write_json = [&](const std::string& path) {
        write_report(path, "bench-device", all.device ? &*all.device : nullptr, rows_of(all.boards),
                     {{"boards", boards_json(all.boards)}});
    };
    if (!o.json.empty()) write_json(o.json);
    if (o.folder.empty()) return;
    const std::filesystem::path folder = o.folder;
    write_json(folder / "board.json");
    write_file(folder / "index.html", board_page(all.boards, command_words()));
    inform("Page: " + (folder / "index.html").string() +
           "; to send with it: " + (folder / "board.json").string());
}

/// Throws Error for what was found wrong.
Exit verdict_on(const BoardsRun& all) {
    for (const Board& board : all.boards)
        for (const BoardRow& row : board.rows)
            if (!row.is_right)
                throw Error(row.part == BoardPart::check ? Exit::device : Exit::comparison,
                            board.device + " with driver " + board.driver + " is wrong: " + row.name +
                                (row.note.empty() ? "." : ": " + row.note));
    if (all.has_failed)
        throw Error(Exit::device, "A device or its driver failed; what it was doing is said above.");
    return all.is_interrupted ? Exit::interrupted : Exit::done;
}

Exit run(const BenchDeviceOptions& o) {
    std::vector<std::string> inputs = o.against;
    inputs.push_back(o.kernels);
    check_outputs({o.json}, inputs);
    check_output_folder(o.folder, {"index.html", "board.json"}, inputs);
    BoardsRun all;
    if (o.against.empty()) {
        all = measure(o);
    } else {
        for (const std::string& path : o.against)
            for (Board& board : read_boards(path)) all.boards.push_back(std::move(board));
    }
    write_boards(o, all);
    return o.against.empty() ? verdict_on(all) : Exit::done;
}

}  // namespace

void add_bench_device(CLI::App& bench, Exit& exit) {
    auto o = std::make_shared<BenchDeviceOptions>();
    CLI::App* command = bench.add_subcommand(
        "device",
        "All about a new board within ten minutes: known answers, peaks, rays, kernels, error against time");
    CLI::Option* against =
        command
            ->add_option(
                "--against", o->against,
                "Reports of other boards (board.json, or what --json wrote): one table and plot of all, "
                "the first is what speeds are compared with; nothing is measured")
            ->type_name("FILE");
    std::vector<CLI::Option*> measuring;
    measuring.push_back(
        command
            ->add_option("--device", o->device,
                         "Devices, one after the other: a number, cpu, gpu, or part of a name, with "
                         "commas between; all: every usable one")
            ->type_name("SEL"));
    measuring.push_back(add_threads(*command, o->threads));
    measuring.push_back(command->add_flag("--quick", o->is_quick, "What a minute is enough for"));
    measuring.push_back(
        command
            ->add_option("--time", o->time,
                         "Seconds at most for all devices together (default 600, --quick 60): what "
                         "there is no time for is left out")
            ->check(number_within(1, 1e6))
            ->type_name("S"));
    measuring.push_back(add_kernels(*command, o->kernels));
    measuring.push_back(add_progress(*command, o->progress));
    for (CLI::Option* option : measuring) option->excludes(against);
    command->add_option("-o,--output", o->folder, "Folder for a page, index.html, and board.json")
        ->type_name("DIR");
    add_json(*command, o->json);
    command->callback([o, &exit] { exit = run(*o); });
}

}  // namespace triad
