#pragma once
/// The exit code of a command, and a part of what it says.
#include <gtest/gtest.h>

#include <string>

#include "program.h"

inline void expect_exit(int exit, const std::string& arguments, const std::string& says = "") {
    const Outcome outcome = run_triad(arguments);
    EXPECT_EQ(outcome.exit, exit) << arguments << "\n" << outcome.output;
    EXPECT_NE(outcome.output.find(says), std::string::npos) << arguments << "\n" << outcome.output;
}
