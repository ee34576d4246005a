// What the tests of `millwright send` share: a port, a file and the folder of the logs.
#pragma once

#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {

/// The last line of the logs in `folder`; null without any.
inline nlohmann::json last_record(const std::filesystem::path& folder) {
    nlohmann::json last;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".jsonl") {
            continue;
        }
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            last = nlohmann::json::parse(line);
        }
    }
    return last;
}

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
