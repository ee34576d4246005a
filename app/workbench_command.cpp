#include "app/workbench_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/suggestion.h"
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
/// `hint`: for a word that may have been meant as a command; else empty.
void expect_readable(const std::filesystem::path& file, const std::string& hint) {
    std::error_code failure;
    if (!hint.empty() && !std::filesystem::exists(file, failure)) {
        throw UsageError("'" + file.string() + "' is neither a command nor a file", {}, hint);
    }
    if (std::filesystem::is_directory(file, failure)) {
        throw Error("is a folder", file);
    }
    if (!std::ifstream(file)) {
        throw Error(std::filesystem::exists(file, failure) ? "cannot be read" : "there is no such file",
                    file);
    }
}

int open_workbench(const std::string& file, const std::string& hint) {
    if (file.empty()) {
        run_workbench(std::nullopt);
        return 0;
    }
    if (std::filesystem::path(file).extension() == ".json") {
        (void)open_project(file); // what is wrong with it is reported here, before a window opens
    } else {
        expect_readable(file, hint);
    }
    run_workbench(file);
    return 0;
}

} // namespace

void add_workbench_command(CLI::App& app, Command& chosen) {
    const auto file = std::make_shared<std::string>();
    app.add_option(
        "FILE", *file, "Project (.json), plot, picture, path or G-code file to open in the workbench");
    chosen = [file, &app] {
        const bool is_word = file->find_first_of("./") == std::string::npos;
        const std::string meant = command_suggestion(app, *file);
        return open_workbench(*file,
                              is_word && meant.empty() ? "'millwright --help' lists the commands"
                              : is_word                ? meant
                                                       : std::string());
    };
}

} // namespace millwright::app
