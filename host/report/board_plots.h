#pragma once
/// The plots of boards, as gnuplot scripts with their data inside.
#include <string>
#include <vector>

#include "bench/board.h"
#include "bench/error_bench.h"

namespace triad {

/// Their errors as those of a bench (report/error_plots.h): of one board a setting for each way, of several
/// one for each board, by the way that is most efficient there.
ErrorBench error_bench_of(const std::vector<Board>& boards);

/// How many times as fast as the first the others are: a line for each measure, a point for each board. Empty
/// for a single board.
std::string speed_plot_script(const std::vector<Board>& boards);

}  // namespace triad
