// The cases of triad check on whole pictures.
#include "check_cases.h"

namespace triad {

INSTANTIATE_TEST_SUITE_P(Pictures, Case, testing::ValuesIn(answerable(picture_cases())), case_name);

}  // namespace triad
