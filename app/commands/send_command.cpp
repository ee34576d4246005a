#include "app/commands/send_command.h"

#include "app/interrupt.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/grbl/grbl_driver.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <memory>
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
};

/// A locked controller is unlocked only for who says so: its position may be lost.
void connect(machine::GrblDriver& driver, const Options& options) {
    driver.connect();
    if (driver.status().state == machine::DriverState::alarm) {
        if (!options.unlock) {
            throw Error(
                driver.status().message, {}, "look at the machine; --unlock goes on from where it stands");
        }
        driver.reset();
    }
    const machine::GrblReadout readout = driver.readout();
    fmt::print("Connected to Grbl {} at {}.\n", readout.version, options.port);
    std::fflush(stdout);
}

machine::JobOutcome send_job(const Options& options, const Interrupt& interrupt) {
    machine::Job job = machine::text_job(read_file(options.file), options.file);
    job.started_at = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
    machine::SteadyClock clock;
    machine::GrblDriver driver(machine::make_link(options.port), clock, {.one_by_one = options.one_by_one});
    driver.check(*job.listing, options.file);
    connect(driver, options);
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
        ->check(CLI::IsMember({"grbl"}));
    command.add_option("--port", options->port, "Serial port, or tcp:HOST:PORT")
        ->required()
        ->type_name("PORT");
    command.add_option("--log", options->log, "Folder of the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_flag("--one-by-one", options->one_by_one, "Wait for the answer to each line before the next");
    command.add_flag("--unlock", options->unlock, "Unlock a locked controller without homing");
    command.callback([&chosen, options] { chosen = [options] { return send(*options); }; });
}

} // namespace millwright::app
