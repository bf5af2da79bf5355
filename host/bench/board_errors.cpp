#include "bench/board_errors.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "bench/reference_error.h"
#include "metric/mean_test.h"
#include "render/renderer.h"
#include "trace/node_format.h"

namespace triad {
namespace {

/// A run that is shorter goes on beyond the plan's samples: clocks and launches want more of a fast device.
constexpr double shortest_error_run = 0.5;
/// Where the reference's own noise would be seen.
constexpr double least_reference_samples = 8;

/// Its halves are one: what its noise adds to an error is known in the mean, and subtracted.
Reference reference_of(const KnownPicture& known) {
    return {known.mean, known.mean.rgb, known.mean.rgb, known.spp, known.relmse};
}

std::string digest_of(const Film& film) {
    return Hash()
        .add(film.sums.data(), film.sums.size() * sizeof film.sums[0])
        .add(film.half_sums.data(), film.half_sums.size() * sizeof film.half_sums[0])
        .hex();
}

/// One run read at one of its budgets.
struct ErrorReading {
    double spp, seconds, relmse;
};

class ErrorRunner {
  public:
    ErrorRunner(Device& device, const BoardScene& scene, const BoardErrorPlan& plan, FilmDigests& digests,
                const std::function<bool()>& go_on)
        : scene_(scene),
          plan_(plan),
          reference_(reference_of(scene.known)),
          digests_(digests),
          go_on_(go_on),
          renderer_(device, scene.scene, scene.settings) {
        renderer_.render({0, 1}, [](const Progress&) { return true; });  // finds the size of launches
    }

    void run() {
        for (unsigned repetition = 0; repetition < plan_.repetitions && (repetition == 0 || go_on_());
             ++repetition)
            if (!run(repetition)) break;
    }

    std::vector<BoardRow> rows(const PathWay& way) const {
        std::vector<BoardRow> rows;
        const auto of_this_way = [&](BoardPart part, const std::vector<double>& values,
                                     const std::string& unit) {
            return BoardRow{.part = part,
                            .name = scene_.name,
                            .format = name_of(way.format),
                            .path_driver = name_of(way.driver),
                            .value = median_estimate(values),
                            .unit = unit};
        };
        for (std::size_t budget = 0; budget < budgets_; ++budget) {
            std::vector<double> errors, seconds;
            for (const std::vector<ErrorReading>& run : runs_)
                errors.push_back(run[budget].relmse), seconds.push_back(run[budget].seconds);
            rows.push_back(of_this_way(BoardPart::error, errors, "relMSE"));
            rows.back().spp = runs_[0][budget].spp, rows.back().seconds = median(seconds);
        }
        if (budgets_ == 0) return rows;
        // Errors fall faster than samples rise, and few runs have other errors than many: that of one seed at
        // one number of samples is nearly the same everywhere, so that boards differ by their times alone.
        std::size_t budget = 0;
        while (budget + 1 < budgets_ && runs_[0][budget].spp < double(plan_.spp)) ++budget;
        std::vector<double> efficiencies;
        for (const std::vector<ErrorReading>& run : runs_)
            efficiencies.push_back(1 / (runs_[0][budget].relmse * run[budget].seconds));
        rows.push_back(of_this_way(BoardPart::efficiency, efficiencies, "1/s"));
        rows.back().spp = runs_[0][budget].spp;
        judge(rows.back());
        return rows;
    }

  private:
    const BoardScene& scene_;
    const BoardErrorPlan& plan_;
    const Reference reference_;
    FilmDigests& digests_;
    const std::function<bool()>& go_on_;
    Renderer renderer_;
    std::vector<std::vector<ErrorReading>> runs_;  ///< each to its end
    std::size_t budgets_ = 0;                      ///< that every run has; the first decides
    bool has_other_bits_ = false;
    TileMeans tiles_;

    bool is_last(std::size_t budget, double spp, double seconds, unsigned repetition) const {
        if (repetition > 0) return budget + 1 == budgets_;
        return (spp >= double(plan_.spp) && seconds >= shortest_error_run) ||
               2 * least_reference_samples * spp > scene_.known.spp;
    }

    /// False: time was up before its end. The first run counts as far as it came.
    bool run(unsigned repetition) {
        renderer_.restart(1 + repetition);
        std::vector<ErrorReading> readings;
        double seconds = 0;
        std::uint64_t have = 0;
        std::optional<Film> last;
        for (std::size_t budget = 0;; ++budget) {
            const std::uint64_t spp = std::uint64_t(1) << budget;
            const RenderResult result = renderer_.render_until({.samples = {have, spp}, .follow = false},
                                                               [&](const Progress&) { return go_on_(); });
            const bool is_cut = result.stop == Stop::interrupt;
            if (is_cut && (repetition > 0 || readings.empty())) return false;
            if (is_cut) break;
            have = spp, seconds += result.seconds;
            last = renderer_.film();
            readings.push_back(reading(*last, double(spp), seconds, repetition));
            if (is_last(budget, double(spp), seconds, repetition)) break;
        }
        if (repetition == 0) budgets_ = readings.size();
        if (last->sample_count() >= plan_.spp) tiles_.add(*last);  // with less, hardly any light is found
        runs_.push_back(std::move(readings));
        return true;
    }

    ErrorReading reading(const Film& film, double spp, double seconds, unsigned repetition) {
        const std::size_t budget = std::size_t(std::lround(std::log2(spp)));
        if (repetition == 0) {
            const std::string digest = digest_of(film);
            if (budget < digests_.size())
                has_other_bits_ |= digests_[budget] != digest;
            else
                digests_.push_back(digest);
        }
        return {spp, seconds, picture_error(picture_of(film).rgb, reference_).relmse - reference_.relmse};
    }

    void judge(BoardRow& row) const {
        if (has_other_bits_) row.note = "The films have other bits than those of the first way.";
        if (tiles_.films > 0) {
            const MeanTest test = test_means(
                tiles_, tiles_of_picture(scene_.known.mean, scene_.known.relmse, scene_.known.spp));
            if (!test.same) row.note += (row.note.empty() ? "" : " ") + test.sentence + ".";
        }
        row.is_right = row.note.empty();
    }
};

}  // namespace

std::vector<BoardRow> measure_errors(Device& device, const BoardScene& scene, const BoardErrorPlan& plan,
                                     FilmDigests& digests, const std::function<bool()>& go_on) {
    ErrorRunner runner(device, scene, plan, digests, go_on);
    runner.run();
    return runner.rows({format_of(device), path_driver_of(device)});
}

}  // namespace triad
