#include "app/commands/workbench_command.h"

#include "app/workbench.h"
#include "core/base/error.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

/// Throws Error if there is nothing to read. The file may be large: it is read once the window is there.
void expect_readable(const std::filesystem::path& file) {
    std::error_code failure;
    if (std::filesystem::is_directory(file, failure)) {
        throw Error("is a folder", file);
    }
    if (!std::ifstream(file)) {
        throw Error(std::filesystem::exists(file, failure) ? "cannot be read" : "there is no such file",
                    file);
    }
}

int open_workbench(const std::string& file) {
    if (file.empty()) {
        run_workbench(std::nullopt);
        return 0;
    }
    if (std::filesystem::path(file).extension() == ".json") {
        (void)open_project(file); // what is wrong with it is told here, before a window opens
    } else {
        expect_readable(file);
    }
    run_workbench(file);
    return 0;
}

} // namespace

void add_workbench_command(CLI::App& app, Command& chosen) {
    const auto file = std::make_shared<std::string>();
    app.add_option(
        "FILE", *file, "Project (.json), plot, picture, path or G-code file to open in the workbench");
    chosen = [file] { return open_workbench(*file); };
}

} // namespace millwright::app
