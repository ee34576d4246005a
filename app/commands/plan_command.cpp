#include "app/commands/plan_command.h"

#include "app/interrupt.h"
#include "app/outputs.h"
#include "app/posting.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/report.h"
#include "core/project/settings.h"
#include "ui/render/picture.h"
#include "ui/viewport/picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>

namespace millwright::app {

namespace {

struct Options {
    std::string project;
    std::string out;
    PostChoice post;
};

void print_figures(std::string_view name, const project::Evaluation& evaluation) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               name,
               fixed(evaluation.closest.max, 4),
               fixed(evaluation.closest.mean, 4),
               fixed(evaluation.closest.lmean, 4),
               fixed(to_degrees(evaluation.closest.axis_max), 2),
               fixed(evaluation.track_gap, 3));
}

void print_summary(const project::Plan& plan, const project::Project& project) {
    fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
               "grid",
               "max mm",
               "mean mm",
               "lmean mm",
               "axis deg",
               "gap mm");
    for (const project::GridMethod method : project::every_grid_method) {
        if (const auto& evaluation = plan.evaluation(method)) {
            print_figures(project::row_of(project::grid_methods(), method).id, *evaluation);
        }
    }
    const project::Evaluation& chosen = *plan.evaluation(project.grid.method);
    fmt::print("{} points, path {} mm, estimated time {}\n",
               chosen.toolpath.points.size(),
               fixed(chosen.path_length, 1),
               clock_time(plan.trajectory->duration()));
}

int plan(const Options& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    make_folder(options.out);
    const project::Plan plan = planned(opened, project::Scope::everything, interrupt.token());
    const PostedText text =
        posted(*plan.program, plan.workpiece->machine, options.post, opened.file.stem().string());
    constexpr render::PixelSize preview_size{1280, 800};
    const render::Picture preview = viewport::render_view(
        opened.project, plan, viewport::ViewKind::error, preview_size, render::Theme::dark);
    write_outputs(options.out,
                  {{"program." + text.format.extension, text.text.listing.text},
                   {"report.json", project::report_text(opened.project, plan)},
                   {"preview.png", render::to_png(preview)}},
                  opened.file);
    print_notes(text);
    print_summary(plan, opened.project);
    return 0;
}

} // namespace

void add_plan_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *app.add_subcommand("plan", "Make the program of a project, with a report and a picture");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for program, report.json and preview.png")
        ->required()
        ->type_name("DIR");
    add_post_options(command, options->post);
    command.callback([&chosen, options] { chosen = [options] { return plan(*options); }; });
}

} // namespace millwright::app
