#pragma once
/// Options by name, as the command line has them.
#include <map>
#include <string>

#include "triad/error.h"

namespace triad::api {

/// Names are those of docs/command-line.md without dashes, texts what would follow them: {"max-depth", "4"},
/// {"look-at", "2,1,3,0,0,0"}. A flag is "on" or "off". What the command line takes several times may be here
/// several times. Whoever takes options says which; another name, or a text that makes no sense, throws Error
/// with exit code 1.
using Options = std::multimap<std::string, std::string>;

}  // namespace triad::api
