#include "app/command_line/watched_work.h"
#include "app/drivers/driver_commands.h"
#include "app/drivers/job_series.h"
#include "core/base/error.h"
#include "core/drivers/driver.h"
#include "core/drivers/grbl/grbl_driver.h"
#include "core/jobs/position_memory.h"
#include "core/machine/drivers_by_name.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <stop_token>
#include <string>

namespace millwright::app {

namespace {

struct StopOptions {
    machine::DriverChoice machine;
    std::string log = JobSeriesChoice().log;
    bool emergency = false;
};

std::string sentence(const drivers::DriverStatus& now) {
    std::string text(to_text(now.state));
    return now.message.empty() ? text : text + ": " + now.message;
}

/// Its state once it is at rest and was asked what it is; before that it looks as if it were not connected.
/// It brakes also if this is not waited for.
drivers::DriverStatus at_rest(const drivers::Driver& driver, Clock& clock, const std::stop_token& stop) {
    constexpr double glance = 0.02; // s
    drivers::DriverStatus now = driver.status();
    while (drivers::is_at_work(now.state) ||
           (now.state == drivers::DriverState::disconnected && !now.link_lost)) {
        if (stop.stop_requested()) {
            throw Cancelled();
        }
        clock.wait(glance);
        now = driver.status();
    }
    return now;
}

/// Boards that reset when their port is opened stop dead, and know no longer where they are.
void refuse_reset_by_opening(drivers::Driver& driver, jobs::PositionMemory& memory) {
    const auto* const grbl = dynamic_cast<const drivers::GrblDriver*>(&driver);
    if (grbl == nullptr || !grbl->readout().began_anew) {
        return;
    }
    // Whoever stops a machine says that it moves: every later job asks first.
    constexpr bool lost = true;
    driver.doubt_position("opening the port to stop it reset the controller, possibly in motion", lost);
    memory.keep(driver.status());
    throw Error("opening the port reset the controller: if the machine was moving, it stopped abruptly and "
                "its position is lost",
                {},
                "inspect the machine, then home it or set its zero again");
}

int stop_machine(const StopOptions& options) {
    const Interrupt interrupt(Suspending::refused);
    SteadyClock clock;
    jobs::PositionMemory memory(options.log, options.machine.driver + " " + options.machine.address);
    const auto driver = machine::make_driver(options.machine, {}, clock);
    driver->connect();
    memory.remind(*driver);
    refuse_reset_by_opening(*driver, memory);
    if (const drivers::DriverStatus found = driver->status();
        !drivers::is_at_work(found.state) && !options.emergency) {
        fmt::print("The machine is not moving ({}).\n", sentence(found));
        return 0;
    }
    if (options.emergency) {
        driver->emergency_stop();
    } else {
        driver->stop();
    }
    const drivers::DriverStatus now = at_rest(*driver, clock, interrupt.token());
    memory.keep(now);
    if (now.link_lost) {
        throw Error(now.message, {}, "stop it with the switch at the machine");
    }
    fmt::print("The machine was stopped ({}).\n", sentence(now));
    if (!now.position_doubt.empty()) {
        fmt::print("{}\n", drivers::doubt_sentence(now.position_doubt));
    }
    return 0;
}

} // namespace

void add_stop_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<StopOptions>();
    options->machine.driver.clear(); // there is no usual one
    CLI::App& command = *app.add_subcommand("stop", "Stop a machine that no running Millwright controls");
    command.add_option("--driver", options->machine.driver, "Controller type")
        ->required()
        ->check(CLI::IsMember(machine::driver_names(
            [](const machine::DriverRow& row) { return row.kind == machine::MachineKind::controlled; })));
    command.add_option("--port", options->machine.address, "Serial port, or tcp:HOST:PORT")
        ->type_name("PORT")
        ->required();
    command.add_option("--axes", options->machine.axes, "Axes of the machine, for linuxcnc")
        ->type_name("LETTERS")
        ->capture_default_str();
    command.add_option("--log", options->log, "Folder for the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_flag("--emergency", options->emergency, "Stop immediately, even if the position is lost");
    command.callback([&chosen, options] { chosen = [options] { return stop_machine(*options); }; });
}

} // namespace millwright::app
