// The cases of triad check on single functions.
#include "check_cases.h"

namespace triad {

INSTANTIATE_TEST_SUITE_P(Functions, Case, testing::ValuesIn(answerable(function_cases())), case_name);

}  // namespace triad
