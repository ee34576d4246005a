// `millwright emulate` beside a test.
#pragma once

#include "tests/app/program.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace millwright::test {

/// An emulated controller as a program of its own.
class Emulator {
public:
    explicit Emulator(const std::filesystem::path& link,
                      std::vector<std::string> more = {},
                      const std::string& kind = "grbl")
        : program_(words(kind, link, more)) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!std::filesystem::exists(link) && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    Ended stop() {
        program_.send(SIGINT);
        return program_.end();
    }

private:
    Program program_;

    static std::vector<std::string>
    words(const std::string& kind, const std::filesystem::path& link, const std::vector<std::string>& more) {
        std::vector<std::string> all = {"emulate", kind, "--pty", link.string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

} // namespace millwright::test
