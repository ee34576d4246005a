// Commands as documents show them, run by a shell.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {

/// The commands in the ```sh blocks of a document, without their comments; one that goes on behind a
/// backslash as one line.
[[nodiscard]] inline std::vector<std::string> commands_of(const std::string& document) {
    std::vector<std::string> commands;
    std::istringstream text(document);
    bool shell = false;
    std::string begun;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```")) {
            shell = line == "```sh";
        } else if (shell) {
            line = line.substr(0, line.find(" #"));
            line.erase(line.find_last_not_of(' ') + 1);
            if (!begun.empty()) {
                line.erase(0, line.find_first_not_of(' '));
            }
            if (line.ends_with(" \\")) {
                begun += line.substr(0, line.size() - 1);
            } else if (!line.empty()) {
                commands.push_back(begun + line);
                begun.clear();
            }
        }
    }
    return commands;
}

/// How a command of a shell ended.
struct ShellRun {
    int exit_code = -1;
    std::string output; ///< standard output and standard error
};

/// In `folder`, which is where the program keeps its state, too; nothing is typed.
[[nodiscard]] inline ShellRun shell(const std::filesystem::path& folder, const std::string& command) {
    const std::string there = "cd '" + folder.string() + "' && export XDG_STATE_HOME=\"$PWD\" || exit 1; ";
    FILE* pipe = popen((there + command + " 2>&1 </dev/null").c_str(), "r");
    EXPECT_NE(pipe, nullptr);
    ShellRun run;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
        run.output.append(buffer.data(), count);
    }
    const int status = pclose(pipe);
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return run;
}

} // namespace millwright::test
