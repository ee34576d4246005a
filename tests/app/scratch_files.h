// Files of one test for the program to read and write.
#pragma once

#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::test {

class ScratchFiles : public ::testing::Test {
protected:
    std::string written(const std::string& name, const std::string& text) const {
        const auto file = folder_.path() / name;
        write_content(file, text);
        return file.string();
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

private:
    ScratchFolder folder_;
};

} // namespace millwright::test
