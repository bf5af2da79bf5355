#pragma once
/// What surrounds the work of a program: the only place that catches and tells.
#include <functional>
#include <string>

namespace triad {

/// The first lines of main(): standard streams that are closed are filled, limits on files and readers that
/// go away become failed writes, freed memory is given back, and memory is limited to half of the machine's.
void prepare_process();

/// Does the work, and returns what the process is to exit with: what the work returns, or the code of what it
/// threw, which is told in a sentence that begins with the program's name. All that was printed is out
/// afterwards; where it could not be written, what was done is not.
int exit_code_of(const std::string& program, const std::function<int()>& work);

/// What a program ends with, and says, for want of anything better.
struct Failure {
    int exit;
    std::string sentence;
};
/// Of the exception that is being handled.
Failure failure_at_hand();

/// "NAME: SENTENCE" on standard error. Returns `exit`.
int complain(const std::string& program, int exit, const std::string& sentence);

}  // namespace triad
