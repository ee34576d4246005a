#include "app/controller.h"

#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/clock.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/grbl/grbl_driver.h"
#include "core/machine/drivers/make_driver.h"
#include "core/machine/survey.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <utility>

namespace millwright::app {

namespace {

struct Controller {
    std::unique_ptr<machine::Driver> driver;
    std::function<std::string()> name; ///< once connected
};

/// Throws Error also for what this controller must not be sent.
Controller make_controller(const machine::Job& job, const ControllerChoice& choice, machine::Clock& clock) {
    machine::DriverChoice wanted;
    wanted.kind = machine::driver_kind(choice.driver);
    wanted.address = choice.port;
    wanted.axes = choice.axes;
    wanted.one_by_one = choice.one_by_one;
    auto driver = machine::make_driver(wanted, {}, clock);
    driver->check(*job.listing, job.project);
    if (const auto* grbl = dynamic_cast<const machine::GrblDriver*>(driver.get())) {
        return {std::move(driver), [grbl] { return "Grbl " + grbl->readout().version; }};
    }
    return {std::move(driver), [] { return std::string("LinuxCNC"); }};
}

/// A locked controller is unlocked only for who says so: its position may be lost.
void connect(const Controller& controller, const ControllerChoice& choice) {
    machine::Driver& driver = *controller.driver;
    driver.connect();
    if (driver.status().state == machine::DriverState::alarm) {
        if (!choice.unlock) {
            throw Error(
                driver.status().message, {}, "look at the machine; --unlock goes on from where it stands");
        }
        driver.reset();
    }
    fmt::print("Connected to {} at {}.\n", controller.name(), choice.port);
    std::fflush(stdout);
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

} // namespace

CLI::Option& add_controller_options(CLI::App& command, ControllerChoice& choice) {
    command.add_flag("--one-by-one", choice.one_by_one, "Wait for the answer to each line before the next");
    command.add_flag("--unlock", choice.unlock, "Unlock a locked controller without homing");
    return *command
                .add_option("--port",
                            choice.port,
                            "Serial port, or tcp:HOST:PORT; of a coordinate stream also file:PATH")
                ->type_name("PORT");
}

machine::JobOutcome run_on_controller(const machine::Job& job,
                                      const ControllerChoice& choice,
                                      const std::string& log_folder,
                                      const std::stop_token& stop) {
    machine::SteadyClock clock;
    const Controller controller = make_controller(job, choice, clock);
    machine::Driver& driver = *controller.driver;
    connect(controller, choice);
    show_warnings(job, driver);
    machine::Dispatcher dispatcher(driver, clock, log_folder);
    ProgressPrinter printer;
    const Progress progress([](const Progress::Report&) {}, stop);
    machine::JobOutcome outcome = dispatcher.run(job, progress, [&](const machine::JobReport& report) {
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

std::string now_for_people() {
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

} // namespace millwright::app
