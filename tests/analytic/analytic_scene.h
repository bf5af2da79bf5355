#pragma once
/// The scenes of host/check/picture.h on the test device.
#include <gtest/gtest.h>

#include "check/picture.h"
#include "device/device_fixture.h"

namespace triad::analytic {

using namespace picture_case;

inline Measured measure(const Scene& scene, const Plan& plan) {
    return picture_case::measure(test_device(), scene, plan);
}

/// Expects the closed form within the statistical error and `bias`: what the test's own geometry or a table
/// leaves.
inline void expect_closed_form(const std::string& what, const Measured& m, double expected, double bias) {
    EXPECT_EQ(m.not_finite, 0u) << what;
    EXPECT_NEAR(m.mean, expected, t_limit * m.standard_error + bias * std::abs(expected)) << what;
    EXPECT_LT(m.standard_error, 0.01 * std::abs(expected)) << what << ": too noisy to prove anything";
}

}  // namespace triad::analytic
