#include "app/plan/cutter_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/posting.h"
#include "app/command_line/watched_work.h"
#include "app/plan/gouges.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/project/tool_file.h"
#include "core/project/tool_settings.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct CutterOptions {
    std::string project;
    std::string tool;
    std::string out;
    std::optional<double> scallop; ///< mm that is wanted; nothing: as the tool says
    PostChoice post;
    bool allow_gouges = false;
};

void print_cutter_summary(const plan::Plan& plan, const project::Project& project) {
    const plan::Evaluation& chosen = *plan.program_path(project);
    const plan::CutStudy& study = *plan.cut;
    fmt::print("cutter error: at most {} mm, {} mm on average; tool axis at most {} deg off ({})\n",
               fixed(chosen.closest.max, 4),
               fixed(chosen.closest.mean, 4),
               fixed(to_degrees(chosen.closest.axis_max), 2),
               plan::checked_face_text(project));
    fmt::print("scallop height: {}\n", plan::left_text(project, plan));
    fmt::print("tracks: {}; a scallop height of {} mm allows {}\n",
               chosen.track_gap ? "at most " + fixed(*chosen.track_gap, 3) + " mm apart"
                                : "spaced as far apart as the scallop height allows",
               project.tool.scallop_mm,
               std::isfinite(study.step_over) ? fixed(study.step_over, 3) + " mm"
                                              : std::string("any spacing"));
    fmt::print("deepest cut below the surface: {} mm ({}); estimated time {}\n",
               fixed(study.deepest, 4),
               plan::checked_text(project),
               clock_time(plan.trajectory->duration()));
}

void print_why_higher(const project::Project& project, const plan::Plan& plan) {
    if (const std::string why = plan::why_higher(project, plan); !why.empty()) {
        fmt::print(stderr, "warning: {}\n", why);
    }
}

/// A few by name, the rest by their number: all of them are in cut.json.
void print_bites(const plan::CutStudy& study) {
    constexpr std::size_t named = 5;
    for (std::size_t n = 0; n < std::min(named, study.bites.size()); ++n) {
        const plan::BlockBite& bite = study.bites[n];
        fmt::print(stderr,
                   "warning: line {}: the {} is {} mm inside the part at {} {} {}\n",
                   bite.line,
                   bite.by_holder ? "holder" : "cutter",
                   fixed(bite.bite.depth, 4),
                   fixed(bite.bite.position.x(), 3),
                   fixed(bite.bite.position.y(), 3),
                   fixed(bite.bite.position.z(), 3));
    }
    if (study.bites.size() > named) {
        fmt::print(stderr,
                   "warning: {}, all listed in cut.json\n",
                   counted(study.bites.size() - named, "more such line"));
    }
    if (!study.local_gouges.empty()) {
        const plan::LocalGouge& first = study.local_gouges.front();
        fmt::print(stderr,
                   "warning: the cutter does not fit into the surface at {}, the first of them {},{}\n",
                   counted(study.local_gouges.size(), "node"),
                   first.origin.i,
                   first.origin.j);
    }
}

int cut(const CutterOptions& options) {
    const Interrupt interrupt;
    OpenedProject opened = open_project(options.project);
    project::Project& project = opened.project;
    if (!options.tool.empty()) {
        project.tool = project::read_tool(options.tool);
    }
    project.tool.scallop_mm = options.scallop.value_or(project.tool.scallop_mm);
    if (project.tool.cutter == toolpath::CutterKind::point) {
        throw Error("the project's tool is a point, which leaves no scallops and fits everywhere",
                    {},
                    "name a tool file with --tool");
    }
    const OutputFolder folder(options.out);
    plan::Plan plan = planned(opened, plan::Scope::program, interrupt.token());
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    plan::add_cut_study(plan, project, progress);
    printer.finish();
    const PostedText text =
        posted(*plan.program, plan.cutting_setup->machine, options.post, opened.file.stem().string());
    const std::string gouges = gouges_of(opened, plan);
    const bool writes = gouges.empty() || options.allow_gouges;
    const std::string program = "program." + text.format.extension;
    OutputSet set{{{"cut.json", plan::cut_report_text(project, plan)},
                   {"surface.csv", plan::surface_csv(*plan.cutting_setup, plan.cut->swept)}},
                  {},
                  std::string(program_kind)};
    if (writes) {
        set.files.push_back({program, text.text.listing.text});
    } else { // an older one would be taken for it
        set.absent.push_back(program);
    }
    write_outputs(options.out, set, opened.file);
    print_notes(text);
    fmt::print("tool: {}\n", project::tool_text(project.tool));
    fmt::print("tool length: {}\n", project::tool_length_text(project.tool, plan.cutting_setup->machine));
    print_cutter_summary(plan, project);
    print_why_higher(project, plan);
    if (const std::string why = plan::why_not_kept(project, *plan.program_path(project)); !why.empty()) {
        fmt::print(stderr, "warning: {}\n", why);
    }
    print_bites(*plan.cut);
    answer_for_gouges(opened, gouges, options.allow_gouges, program + " was not written");
    return 0;
}

} // namespace

void add_cutter_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<CutterOptions>();
    CLI::App& command = *app.add_subcommand(
        "cutter", "Simulate a project with the body of its tool: error, scallops, gouges");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--tool", options->tool, "Tool file to use instead of the project's tool")
        ->type_name("FILE");
    command.add_option("--out", options->out, "Folder for program, cut.json and surface.csv")
        ->required()
        ->type_name("DIR");
    command.add_option("--scallop", options->scallop, "Scallop height for which to find the step-over, mm")
        ->type_name("MM")
        ->check(above_zero());
    add_gouges_option(command, options->allow_gouges);
    add_post_options(command, options->post);
    command.callback([&chosen, options] { chosen = [options] { return cut(*options); }; });
}

} // namespace millwright::app
