#include "app/plan/export_command.h"

#include "app/command_line/watched_work.h"
#include "core/exchange/surface_file.h"
#include "core/project/export_note.h"
#include "core/project/surface.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct ExportOptions {
    std::string project;
    std::string out;
    double tolerance = 0.01;
};

int export_design(const ExportOptions& options) {
    const OpenedProject opened = open_project(options.project);
    WatchedWork work;
    exchange::write_surface(
        project::surface_of(opened.project.surface), options.out, options.tolerance, work.progress());
    work.finish();
    fmt::print("{}\n", options.out);
    if (const std::string note = project::left_out_text(opened.project.surface); !note.empty()) {
        fmt::print("{}\n", note);
    }
    return 0;
}

} // namespace

void add_export_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App& command = *app.add_subcommand("export", "Export the surface of a project");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Output file: FILE.step, .glb, .stl, .obj or .ply")
        ->required()
        ->type_name("FILE");
    command
        .add_option(
            "--tolerance", options->tolerance, "Largest deviation of the triangles from the surface, mm")
        ->check(CLI::Range(1e-6, 1e3))
        ->capture_default_str();
    command.callback([&chosen, options] { chosen = [options] { return export_design(*options); }; });
}

} // namespace millwright::app
