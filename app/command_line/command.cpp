#include "app/command_line/command.h"

#include "app/command_line/watched_work.h"
#include "core/base/error.h"
#include "core/project/assets.h"
#include "core/project/project_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

namespace millwright::app {

namespace {

constexpr std::size_t most_printed = 20;

} // namespace

void print_first(const std::vector<Diagnostic>& found) {
    for (std::size_t n = 0; n < std::min(found.size(), most_printed); ++n) {
        fmt::print(stderr, "millwright: {}\n", to_text(found[n]));
    }
}

void print_warnings(const std::vector<Diagnostic>& warnings) {
    print_first(warnings);
    if (warnings.size() > most_printed) {
        fmt::print(stderr, "millwright: {} warnings\n", warnings.size());
    }
}

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
