#include "app/commands/workbench_command.h"

#include "app/workbench.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

int open_workbench(const std::string& file) {
    if (file.empty()) {
        run_workbench(std::nullopt);
        return 0;
    }
    (void)open_project(file); // what is wrong with the file is told here, before a window opens
    run_workbench(file);
    return 0;
}

} // namespace

void add_workbench_command(CLI::App& app, Command& chosen) {
    const auto file = std::make_shared<std::string>();
    app.add_option("PROJECT", *file, "Project file to open in the workbench");
    chosen = [file] { return open_workbench(*file); };
}

} // namespace millwright::app
