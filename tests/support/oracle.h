// Tests that compare with another program. One that lacks its program is skipped with a message; where
// MILLWRIGHT_REQUIRE_ORACLES is set, as in .ci/run, it fails instead.
#pragma once

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright {

struct ProgramRun {
    int exit_code = 0;
    std::string output; ///< standard output and standard error, as they came
};

/// A fixture for tests that need `program`, looked up in PATH; `package` is what a person installs to get it.
class OracleTest : public ::testing::Test {
protected:
    OracleTest(std::string program, std::string package);
    void SetUp() override;

    /// Runs the program to its end without any input, in a home folder of its own: rs274 keeps its tool table
    /// there, and several run at a time. Throws std::runtime_error if it cannot be started or
    /// dies of a signal.
    [[nodiscard]] ProgramRun run(const std::vector<std::string>& arguments) const;
    /// The same with another program of the package.
    [[nodiscard]] ProgramRun run_other(const std::string& program,
                                       const std::vector<std::string>& arguments) const;

private:
    std::string program_;
    std::string package_;
    std::filesystem::path found_;
    test::ScratchFolder home_;
};

} // namespace millwright
