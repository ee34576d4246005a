// What the tests of `millwright send` share: a port, a file and the folder of the logs.
#pragma once

#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {

/// The last line of the logs in `folder`; null without any.
[[nodiscard]] nlohmann::json last_record(const std::filesystem::path& folder);

struct Send : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "grbl").string();
    std::string file = (scratch / "zigzag.ngc").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] std::vector<std::string> words() const {
        return {"send", file, "--driver", "grbl", "--port", port, "--log", logs};
    }
};

} // namespace millwright::test
