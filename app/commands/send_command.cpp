#include "app/commands/send_command.h"

#include "app/interrupt.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/grbl/grbl_driver.h"
#include "core/machine/drivers/linuxcnc/linuxcnc_driver.h"
#include "core/machine/run_from_line.h"
#include "core/machine/survey.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace millwright::app {

namespace {

struct Options {
    std::string file;
    std::string driver;
    std::string port;
    std::string log = "jobs";
    bool one_by_one = false;
    bool unlock = false;
    int from_line = 1;
    std::optional<double> clearance;
    std::string axes = "XYZ";
};

struct Controller {
    std::unique_ptr<machine::Driver> driver;
    std::function<std::string()> name; ///< once connected
};

/// Throws Error also for what this controller must not be sent.
Controller make_controller(const Options& options, const machine::Job& job, const machine::Clock& clock) {
    auto link = machine::make_link(options.port);
    if (options.driver == "linuxcnc") {
        machine::LinuxCncOptions wanted;
        wanted.axes = options.axes;
        return {std::make_unique<machine::LinuxCncDriver>(std::move(link), clock, wanted),
                [] { return std::string("LinuxCNC"); }};
    }
    auto driver = std::make_unique<machine::GrblDriver>(
        std::move(link), clock, machine::GrblOptions{.one_by_one = options.one_by_one});
    driver->check(*job.listing, options.file);
    const machine::GrblDriver& grbl = *driver;
    return {std::move(driver), [&grbl] { return "Grbl " + grbl.readout().version; }};
}

/// A locked controller is unlocked only for who says so: its position may be lost.
void connect(const Controller& controller, const Options& options) {
    machine::Driver& driver = *controller.driver;
    driver.connect();
    if (driver.status().state == machine::DriverState::alarm) {
        if (!options.unlock) {
            throw Error(
                driver.status().message, {}, "look at the machine; --unlock goes on from where it stands");
        }
        driver.reset();
    }
    fmt::print("Connected to {} at {}.\n", controller.name(), options.port);
    std::fflush(stdout);
}

machine::Job job_of(const Options& options) {
    machine::Job job = machine::text_job(read_file(options.file), options.file);
    if (options.from_line > 1) {
        machine::RunFromSettings settings;
        settings.dialect = options.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
        settings.clearance = options.clearance;
        job = machine::job_from_line(job, options.from_line, settings);
    }
    job.started_at = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
    return job;
}

/// What a person should know before the tool moves.
void show_warnings(const machine::Job& job, const machine::Driver& driver) {
    const machine::Capabilities able = driver.capabilities();
    const machine::Survey found =
        machine::survey(job.listing->text,
                        job.project,
                        {*able.dialect, able.axes, driver.status().position, driver.stored_offsets()});
    for (const Diagnostic& warning : machine::warnings_of(found, driver.limits(), job.project)) {
        fmt::print(stderr, "millwright: {}\n", to_text(warning));
    }
}

machine::JobOutcome send_job(const Options& options, const Interrupt& interrupt) {
    const machine::Job job = job_of(options);
    machine::SteadyClock clock;
    const Controller controller = make_controller(options, job, clock);
    machine::Driver& driver = *controller.driver;
    connect(controller, options);
    show_warnings(job, driver);
    machine::Dispatcher dispatcher(driver, clock, options.log);
    ProgressPrinter printer;
    const Progress progress([](const Progress::Report&) {}, interrupt.token());
    const machine::JobOutcome outcome = dispatcher.run(job, progress, [&](const machine::JobReport& report) {
        const auto& now = report.driver;
        printer.show(
            {static_cast<double>(now.executed_blocks) / report.blocks,
             fmt::format("Block {} of {}{}",
                         now.executed_blocks,
                         report.blocks,
                         now.state == machine::DriverState::holding ? ", holding: " + now.message : "")});
    });
    driver.close();
    return outcome;
}

int send(const Options& options) {
    const Interrupt interrupt;
    const machine::JobOutcome outcome = send_job(options, interrupt);
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
    command.add_option("--driver", options->driver, "Kind of controller")
        ->required()
        ->check(CLI::IsMember({"grbl", "linuxcnc"}));
    command.add_option("--port", options->port, "Serial port, or tcp:HOST:PORT")
        ->required()
        ->type_name("PORT");
    command.add_option("--log", options->log, "Folder of the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_flag("--one-by-one", options->one_by_one, "Wait for the answer to each line before the next");
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
    command.add_option("--axes", options->axes, "Axes of the machine, for linuxcnc")
        ->type_name("LETTERS")
        ->capture_default_str();
    command.add_flag("--unlock", options->unlock, "Unlock a locked controller without homing");
    command.callback([&chosen, options] { chosen = [options] { return send(*options); }; });
}

} // namespace millwright::app
