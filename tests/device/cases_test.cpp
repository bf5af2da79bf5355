// The cases of triad check on single functions.
#include "check/ray_caster.h"
#include "check_cases.h"

namespace triad {

// On the format of nodes that the device would not walk by itself, too.
class OtherFormat : public testing::TestWithParam<CheckCase> {};

TEST_P(OtherFormat, is_right) {
    Device& device = test_device();
    const BvhFormat other = format_of(device) == BvhFormat::bvh8 ? BvhFormat::bvh4 : BvhFormat::bvh8;
    const traversal_case::WithFormat walks(device, other);
    expect_right(run_case(device, GetParam(), CheckLevel::full));
}

INSTANTIATE_TEST_SUITE_P(Traversal, OtherFormat, testing::ValuesIn(answerable(traversal_cases())), case_name);
INSTANTIATE_TEST_SUITE_P(Functions, Case, testing::ValuesIn(answerable(function_cases())), case_name);

}  // namespace triad
