// triad bench: measurements of speed and error. One file for each kind.
#include "cli/bench_device.h"
#include "cli/bench_error.h"
#include "cli/bench_features.h"
#include "cli/bench_kernels.h"
#include "cli/bench_subpixel.h"
#include "cli/command_line.h"
#include "cli/suite.h"

namespace triad {

void add_bench(CLI::App& app, Exit& exit) {
    CLI::App* bench =
        app.add_subcommand("bench", "Measure speed and error; without a further word a suite of ten scenes");
    add_bench_suite(*bench, exit);
    add_bench_error(*bench, exit);
    add_bench_device(*bench, exit);
    add_bench_features(*bench, exit);
    add_bench_kernels(*bench, exit);
    add_bench_subpixel(*bench, exit);
    bench->require_subcommand(0, 1);
}

}  // namespace triad
