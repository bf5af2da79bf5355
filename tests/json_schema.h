#pragma once
/// What is written as JSON against docs/schema.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "program.h"

/// Whether docs/schema/NAME.schema.json describes the file; with `lines` each of its lines that is an object.
/// Skips the test where there is no validator.
inline void expect_schema(const std::string& name, const std::filesystem::path& file, bool lines = false) {
    const Outcome outcome =
        run_program("/usr/bin/python3", "-W ignore '" TRIAD_SOURCE_DIR "/tests/validate_json.py' " + name +
                                            " '" + file.string() + "'" + (lines ? " --lines" : ""));
    if (outcome.exit == 77) GTEST_SKIP() << "python3-jsonschema is not installed";
    EXPECT_EQ(outcome.exit, 0) << name << ": " << file << "\n" << outcome.output;
}
