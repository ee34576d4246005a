#include "app/command_line/posting.h"
#include "app/command_line/watched_work.h"
#include "app/drivers/connected_controller.h"
#include "app/drivers/driver_commands.h"
#include "app/drivers/driver_options.h"
#include "app/drivers/job_series.h"
#include "app/drivers/planned_machine.h"
#include "app/plan/gouges.h"
#include "core/base/error.h"
#include "core/jobs/run_from_line.h"
#include "core/machine/drivers_by_name.h"
#include "core/plan/cut_study.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

struct RunOptions {
    JobSeriesChoice series;
    PlannedMachineChoice machine; ///< its controller also for grbl
    PostChoice post{.post = ""};  ///< empty: that of the driver
    std::optional<double> clearance;
    bool allow_gouges = false;
};

std::string post_of_driver(const std::string& driver, const kinematics::MachineModel& machine) {
    const bool turns = std::ranges::any_of(machine.axes(), [](const kinematics::MachineAxis& axis) {
        return axis.kind == kinematics::AxisKind::rotary;
    });
    return driver != "grbl" ? "linuxcnc" : turns ? "grbl-rotary" : "grbl";
}

/// In the words of the driver's control, or of the one that was chosen.
jobs::Job job_of(const OpenedProject& opened, const plan::Plan& plan, const RunOptions& options) {
    PostChoice choice = options.post;
    if (choice.post.empty()) {
        choice.post = post_of_driver(options.machine.driver, plan.cutting_setup->machine);
    }
    jobs::Job job;
    job.name = opened.file.stem().string();
    job.project = opened.file.string();
    job.started_at = now_for_people();
    job.machine = std::make_shared<const kinematics::MachineModel>(plan.cutting_setup->machine);
    program::Program program = *plan.program;
    if (options.machine.driver == "cordic") { // which does not wait for a tool change
        program.tool.reset();
    }
    PostedText text = posted(program, *job.machine, choice, job.name);
    print_notes(text);
    job.program = std::make_shared<const program::Program>(std::move(text.text.program));
    job.listing = std::make_shared<const program::Listing>(std::move(text.text.listing));
    return job;
}

jobs::Job begun_at(jobs::Job job, int line, const RunOptions& options) {
    jobs::RunFromSettings settings;
    settings.clearance = options.clearance;
    if (options.machine.driver == "grbl") { // which executes the text
        settings.dialect = gcode::Dialect::grbl;
        job.program = nullptr;
    }
    return jobs::job_from_line(job, line, settings);
}

/// With what its tool cuts. Throws GougeError.
plan::Plan fit_plan(const OpenedProject& opened, const RunOptions& options, const std::stop_token& stop) {
    plan::Plan plan = planned(opened, plan::Scope::program, stop);
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
    plan::add_cut_study(plan, opened.project, progress);
    printer.finish();
    answer_for_gouges(opened, gouges_of(opened, plan), options.allow_gouges, "nothing was run");
    return plan;
}

int run_plan(const RunOptions& options) {
    check(options.machine);
    const Interrupt interrupt(Suspending::refused);
    std::optional<ConnectedController> controller;
    if (options.machine.driver == "grbl") {
        controller.emplace(options.machine.controller, options.series.log);
    }
    PlannedMachine planned_machine(options.machine);
    JobSeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        const OpenedProject opened = open_project(file);
        jobs::Job job = job_of(opened, fit_plan(opened, options, interrupt.token()), options);
        check_from_line(options.machine, from_line);
        if (from_line > 1) {
            job = begun_at(job, from_line, options);
        }
        if (controller) {
            controller->check(job);
        }
        return job;
    };
    steps.ready = [&] {
        if (controller) {
            controller->connect(options.series.from_line > 1, interrupt.token());
        }
    };
    steps.run = [&](const jobs::Job& job) {
        return controller ? controller->run(job, interrupt)
                          : planned_machine.run(job, options.series.log, interrupt);
    };
    if (controller && options.machine.controller.check_only) {
        steps.instead = [&](const jobs::Job& job) { controller->check_there(job, interrupt.token()); };
    }
    return run_job_series(options.series, steps, interrupt.token());
}

} // namespace

void add_run_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<RunOptions>();
    CLI::App& command = *app.add_subcommand("run", "Run the programs of projects on a machine");
    add_job_series_options(command, options->series, "Project files");
    add_clearance_option(command, options->clearance);
    command.add_option("--driver", options->machine.driver, "Machine to run on")
        ->required()
        ->check(CLI::IsMember(
            machine::driver_names([](const machine::DriverRow& row) { return row.runs_projects; })));
    add_controller_options(command, options->machine.controller);
    add_planned_machine_options(command, options->machine);
    add_gouges_option(command, options->allow_gouges);
    add_post_options(command, options->post);
    command.callback([&chosen, &command, options] {
        options->series.options = options_to_go_on(command);
        chosen = [&command, options] {
            expect_options_of_driver(command, options->machine.driver);
            expect_one_way(options->machine.controller, options->series.from_line);
            return run_plan(*options);
        };
    });
}

} // namespace millwright::app
