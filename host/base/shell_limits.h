#pragma once
/// Limits that a shell sets for its programs (ulimit).
#include <string>

namespace triad {

/// Those on address space, threads and stacks that are in force, as ulimit takes them: "ulimit -v 600000 -u
/// 20"; empty where there are none. Ends neither in a full stop nor in a line break.
std::string shell_limits();

/// For the pre-initialisation of a program, which comes before the initialisers of its libraries: stacks get
/// the size that libraries expect, and where these cannot start within the limits, the process ends with a
/// sentence and the code of Exit::memory instead of an abort. Calls nothing that an initialiser must prepare.
void heed_shell_limits();

/// Main has begun: from here on exceptions are caught where they should be.
void libraries_have_started();

/// While it lives, libraries are loaded that start later than the program: within the shell's limits, or the
/// process ends in the same way. One at a time; where address space is limited it changes the process's
/// handlers of SIGSEGV and std::terminate for as long.
class LibrariesStart {
  public:
    LibrariesStart();
    ~LibrariesStart();
};

}  // namespace triad
