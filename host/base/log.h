#pragma once
/// One log for the whole program, on standard error. Levels: 0 quiet (errors only), 1 normal, 2 verbose.
#include <string>

namespace triad {

void set_log_level(int level);
int log_level();
/// "triad: warning: ..." once per distinct text; printed at level 1 and above.
void warn(const std::string& sentence);
/// Printed at level 1 and above.
void inform(const std::string& sentence);
/// Printed at level 2.
void detail(const std::string& sentence);

}  // namespace triad
