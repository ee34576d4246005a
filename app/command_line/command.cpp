#include "app/command_line/command.h"

#include "app/command_line/progress_printer.h"
#include "core/base/error.h"
#include "core/project/assets.h"
#include "core/project/project_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace millwright::app {

namespace fs = std::filesystem;

OpenedProject open_project(const fs::path& file) {
    return {file, project::read_project(file), {file.parent_path(), project::assets_folder()}};
}

plan::Plan planned(const OpenedProject& opened, const plan::Scope& scope, const std::stop_token& stop) {
    for (const std::string& sentence : plan::memory_sentences(opened.project, scope)) {
        fmt::print(stderr, "{}\n", sentence);
    }
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
    try {
        return plan::make_plan(opened.project, opened.folders, progress, scope);
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        if (found.place.file.empty()) {
            found.place.file = opened.file;
        }
        throw Error(std::move(found));
    }
}

} // namespace millwright::app
