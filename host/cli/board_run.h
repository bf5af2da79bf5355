#pragma once
/// The bench of one board, step by step within a time.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/board_bench.h"
#include "bench/board_errors.h"
#include "bench/time_plan.h"
#include "cli/experiment.h"

namespace triad {

class BoardRun {
  public:
    struct Settings {
        std::string device;    ///< Device::Settings::selector
        unsigned threads = 0;  ///< of a CPU
        bool is_quick = false;
        double seconds = 0;  ///< at most, in all
    };
    /// Called often, with what is being done and the seconds that are left; false: stop.
    using Report = std::function<bool(const std::string& doing, double elapsed, double left)>;

    /// Opens the device, which is tuned where it was not. Throws Error.
    BoardRun(const Settings& settings, Report report);

    /// Everything that there is time for. A device that gives wrong answers is measured no further; what a
    /// step threw is said in Board::left_out.
    Board run();

    bool is_interrupted() const { return is_interrupted_; }
    bool has_failed() const { return has_failed_; }  ///< the device or its driver, in some step
    const DeviceInfo& device() const { return device_.info(); }

  private:
    struct Step {
        std::string words;
        double guess;  ///< seconds on two cores, with compiling
        std::function<std::vector<BoardRow>()> measure;
    };

    Settings settings_;
    Report report_;
    TimePlan plan_;
    Device device_;
    std::vector<PathWay> ways_;  ///< the device's own first; when all were measured, the fastest first
    DevicePeaks peaks_;
    std::map<BvhFormat, WorkCounts> counts_;
    std::map<std::string, FilmDigests> digests_;
    std::vector<NamedOptions> scenes_;  ///< of the suite
    std::vector<Step> steps_;
    std::string doing_;
    std::vector<std::string> late_;  ///< steps that there was no time for
    Board board_;
    bool is_interrupted_ = false, has_failed_ = false;

    void add_steps();
    void add(const std::string& words, double guess, std::function<std::vector<BoardRow>()> measure);
    void add_paths(std::size_t first, std::size_t end);
    void add_display();
    /// Of scenes [first_scene, last_scene), by ways [first, end).
    void add_errors(std::size_t first_scene, std::size_t last_scene, std::size_t first, std::size_t end);
    void take(const Step& step);
    bool tell();   ///< false: interrupted
    bool go_on();  ///< and the step's time is not over
    std::function<bool()> within_step();
    std::vector<BoardRow> answers();
    void prefer_fastest();
};

}  // namespace triad
