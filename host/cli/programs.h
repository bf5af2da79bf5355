#pragma once
/// The other program that manuals and completions are made of.
#include <CLI/CLI.hpp>

#include "cli/option_kinds.h"
#include "replay/command_line.h"

namespace triad {

/// triad-replay as its own main() declares it.
class ReplayProgram {
  public:
    ReplayProgram() {
        declare(app_, request_);
        hide_ranges(app_);
    }
    const CLI::App& app() const { return app_; }

  private:
    ReplayRequest request_;
    CLI::App app_;
};

}  // namespace triad
