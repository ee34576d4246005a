#include "tests/support/oracle.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace millwright {
namespace {

std::filesystem::path find_in_path(std::string_view program) {
    const char* path = std::getenv("PATH");
    std::string_view folders = path == nullptr ? "" : path;
    while (!folders.empty()) {
        const auto end = folders.find(':');
        const auto candidate = std::filesystem::path(folders.substr(0, end)) / program;
        if (access(candidate.c_str(), X_OK) == 0) {
            return candidate;
        }
        folders = end == std::string_view::npos ? std::string_view{} : folders.substr(end + 1);
    }
    return {};
}

std::string quoted_for_shell(std::string_view word) {
    std::string quoted = "'";
    for (const char c : word) {
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return quoted + "'";
}

} // namespace

OracleTest::OracleTest(std::string program, std::string package)
    : program_(std::move(program)), package_(std::move(package)), found_(find_in_path(program_)) {}

void OracleTest::SetUp() {
    if (!found_.empty()) {
        return;
    }
    const std::string message = program_ + " is not installed (Debian package " + package_ + ")";
    if (std::getenv("MILLWRIGHT_REQUIRE_ORACLES") != nullptr) {
        FAIL() << message << ", and MILLWRIGHT_REQUIRE_ORACLES is set";
    }
    GTEST_SKIP() << message << ": nothing to compare with";
}

ProgramRun OracleTest::run(const std::vector<std::string>& arguments) const {
    return run_other(found_.string(), arguments);
}

ProgramRun OracleTest::run_other(const std::string& program,
                                 const std::vector<std::string>& arguments) const {
    std::string command = "HOME=" + quoted_for_shell(home_.path().string()) + " " + quoted_for_shell(program);
    for (const auto& argument : arguments) {
        command += " " + quoted_for_shell(argument);
    }
    command += " 2>&1 </dev/null";

    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        throw std::runtime_error("cannot start " + command);
    }
    ProgramRun run;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
        run.output.append(buffer.data(), count);
    }
    const int status = pclose(pipe);
    if (!WIFEXITED(status)) {
        throw std::runtime_error(command + " did not exit normally:\n" + run.output);
    }
    run.exit_code = WEXITSTATUS(status);
    return run;
}

} // namespace millwright
