#include "app/commands/send_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "app/series.h"
#include "core/base/files.h"
#include "core/machine/run_from_line.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

struct Options {
    SeriesChoice series;
    ControllerChoice controller;
    std::optional<double> clearance;
};

machine::Job job_of(const Options& options, const std::string& file, int from_line) {
    machine::Job job = machine::text_job(read_file(file), file);
    if (from_line > 1) {
        machine::RunFromSettings settings;
        settings.dialect =
            options.controller.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
        settings.clearance = options.clearance;
        job = machine::job_from_line(job, from_line, settings);
    }
    job.started_at = now_for_people();
    return job;
}

int send(const Options& options) {
    const Interrupt interrupt;
    Controller controller(options.controller);
    SeriesSteps steps;
    steps.make = [&](const std::string& file, int from_line) {
        machine::Job job = job_of(options, file, from_line);
        controller.check(job);
        return job;
    };
    steps.ready = [&] { controller.connect(); };
    steps.run = [&](const machine::Job& job) {
        return controller.run(job, options.series.log, interrupt.token());
    };
    return run_series(options.series, steps, interrupt.token());
}

} // namespace

void add_send_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("send", "Send G-code files to a controller");
    add_series_options(command, options->series, "G-code files, for this controller");
    command.add_option("--driver", options->controller.driver, "Kind of controller")
        ->required()
        ->check(CLI::IsMember({"grbl", "linuxcnc"}));
    add_controller_options(command, options->controller).required();
    command.add_option("--axes", options->controller.axes, "Axes of the machine, for linuxcnc")
        ->type_name("LETTERS")
        ->capture_default_str();
    add_clearance_option(command, options->clearance);
    command.callback([&chosen, options] { chosen = [options] { return send(*options); }; });
}

} // namespace millwright::app
