#pragma once
/// One log for the whole program, on standard error. Levels: 0 quiet (errors only), 1 normal, 2 verbose.
#include <functional>
#include <string>

namespace triad {

/// What is called before each line that is printed: whoever keeps a line of the terminal for itself clears
/// it. It must not log. Empty: nothing is.
void before_each_line(std::function<void()> clear);

void set_log_level(int level);
int log_level();
/// "triad: warning: ..." once per distinct text; printed at level 1 and above.
void warn(const std::string& sentence);
/// Printed at level 1 and above.
void inform(const std::string& sentence);
/// Printed at level 2.
void detail(const std::string& sentence);

}  // namespace triad
