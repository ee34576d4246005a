#include "app/commands/send_command.h"

#include "app/controller.h"
#include "app/interrupt.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/machine/run_from_line.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

struct Options {
    std::string file;
    ControllerChoice controller;
    std::string log = "jobs";
    int from_line = 1;
    std::optional<double> clearance;
};

machine::Job job_of(const Options& options) {
    machine::Job job = machine::text_job(read_file(options.file), options.file);
    if (options.from_line > 1) {
        machine::RunFromSettings settings;
        settings.dialect =
            options.controller.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
        settings.clearance = options.clearance;
        job = machine::job_from_line(job, options.from_line, settings);
    }
    job.started_at = now_for_people();
    return job;
}

int send(const Options& options) {
    const Interrupt interrupt;
    const machine::JobOutcome outcome =
        run_on_controller(job_of(options), options.controller, options.log, interrupt.token());
    fmt::print("{}\n{} of {} blocks executed in {}; log: {}\n",
               outcome.sentence,
               outcome.executed_blocks,
               outcome.blocks,
               clock_time(outcome.elapsed),
               outcome.log_file.string());
    if (outcome.end == machine::JobEnd::cancelled) {
        throw Cancelled();
    }
    return outcome.end == machine::JobEnd::done ? 0 : 1;
}

} // namespace

void add_send_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("send", "Send a G-code file to a controller");
    command.add_option("FILE", options->file, "G-code file, for this controller")->required();
    command.add_option("--driver", options->controller.driver, "Kind of controller")
        ->required()
        ->check(CLI::IsMember({"grbl", "linuxcnc"}));
    add_controller_options(command, options->controller).required();
    command.add_option("--axes", options->controller.axes, "Axes of the machine, for linuxcnc")
        ->type_name("LETTERS")
        ->capture_default_str();
    command.add_option("--log", options->log, "Folder of the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    constexpr int greatest_line = 1'000'000'000;
    command
        .add_option(
            "--from-line", options->from_line, "Begin there, with everything before it brought into force")
        ->check(CLI::Range(1, greatest_line))
        ->type_name("N");
    command
        .add_option("--clearance",
                    options->clearance,
                    "Z of the work in which the tool can go anywhere, for --from-line")
        ->type_name("Z");
    command.callback([&chosen, options] { chosen = [options] { return send(*options); }; });
}

} // namespace millwright::app
