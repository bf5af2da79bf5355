#pragma once
/// The sentence of the Error that an action ends with.
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

/// A test failure where the action ends without an Error, or with one of another exit code.
template <class Action>
std::string sentence_of(triad::Exit exit, Action action) {
    try {
        action();
    } catch (const triad::Error& error) {
        EXPECT_EQ(error.exit(), exit) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}
